// Curves through errors: a line in log-log, the floor under the last of them, and where a curve reaches a target.
#pragma once

#include <cstddef>
#include <vector>

namespace etendue
{
struct LineFit {
    double slope = 0.0, intercept = 0.0;
};

// Least squares of y on x; NaN of fewer than two different x.
LineFit fit_line(const std::vector<double>& x, const std::vector<double>& y);

// The slope of log2 y on log2 x over the points where both are positive.
double log_log_slope(const std::vector<double>& x, const std::vector<double>& y);

// y = a / x + b.
struct FloorFit {
    double a = 0.0, b = 0.0;
};

// Least squares of the relative deviations over the points from 1 / FLOOR_FIT_SPAN of the last x on; x rises, y > 0.
// NaN of fewer than FLOOR_FIT_POINTS. The errors of unbiased samples fall at least as 1 / x, whatever the sampler: then
// b is not above 0. A fitted exponent would take the bend of a sampler that first gains and then no longer for a floor.
constexpr double FLOOR_FIT_SPAN = 16.0;
constexpr std::size_t FLOOR_FIT_POINTS = 3;
FloorFit fit_floor(const std::vector<double>& x, const std::vector<double>& y);

// Where a falling curve first reaches a target, between its points straight in log-log.
struct Crossing {
    enum class Kind { before_first, at, not_reached, unknown } kind = Kind::not_reached; // unknown: no error is known
    double x = 0.0; // at; before_first: the first point
};
Crossing find_crossing(const std::vector<double>& x, const std::vector<double>& y, double target);
} // namespace etendue
