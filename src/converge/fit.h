// Curves through errors: a line in log-log, a power law with a floor, and where a curve reaches a target.
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

// y = a x^-p + b.
struct FloorFit {
    double a = 0.0, p = 1.0, b = 0.0;
};

// Least squares of the relative deviations, p within [FLATTEST, STEEPEST]. NaN of fewer than FLOOR_FIT_POINTS.
constexpr double FLATTEST = 0.25, STEEPEST = 4.0;
constexpr std::size_t FLOOR_FIT_POINTS = 4;
FloorFit fit_floor(const std::vector<double>& x, const std::vector<double>& y);

// Where a falling curve first reaches a target, between its points straight in log-log.
struct Crossing {
    enum class Kind { before_first, at, not_reached } kind = Kind::not_reached;
    double x = 0.0; // at; before_first: the first point
};
Crossing find_crossing(const std::vector<double>& x, const std::vector<double>& y, double target);
} // namespace etendue
