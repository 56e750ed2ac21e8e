// Least squares, with the exponent of the power law by search.
#include "converge/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace etendue
{
namespace
{
constexpr double UNKNOWN_VALUE = std::numeric_limits<double>::quiet_NaN();
constexpr int COARSE_STEPS = 60, FINE_STEPS = 40;

struct FloorAt {
    FloorFit fit;
    double residual = std::numeric_limits<double>::infinity();
};

// a and b for one exponent: (a x^-p + b) / y = 1 in the sense of least squares.
FloorAt floor_at(const std::vector<double>& x, const std::vector<double>& y, double p)
{
    double uu = 0.0, uv = 0.0, vv = 0.0, u1 = 0.0, v1 = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        // Relative to the first point, so that no power overflows.
        const double u = std::pow(x[i] / x[0], -p) / y[i], v = 1.0 / y[i];
        uu += u * u;
        uv += u * v;
        vv += v * v;
        u1 += u;
        v1 += v;
    }
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 0.0)) return {};
    const double a = (u1 * vv - v1 * uv) / determinant, b = (v1 * uu - u1 * uv) / determinant;
    double residual = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double deviation = (a * std::pow(x[i] / x[0], -p) + b) / y[i] - 1.0;
        residual += deviation * deviation;
    }
    return {{a * std::pow(x[0], p), p, b}, residual};
}
} // namespace

LineFit fit_line(const std::vector<double>& x, const std::vector<double>& y)
{
    const double n = static_cast<double>(x.size());
    double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += x[i] / n;
        mean_y += y[i] / n;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    if (!(xx > 0.0)) return {UNKNOWN_VALUE, UNKNOWN_VALUE};
    return {xy / xx, mean_y - xy / xx * mean_x};
}

double log_log_slope(const std::vector<double>& x, const std::vector<double>& y)
{
    std::vector<double> log_x, log_y;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(x[i] > 0.0 && y[i] > 0.0)) continue;
        log_x.push_back(std::log2(x[i]));
        log_y.push_back(std::log2(y[i]));
    }
    return fit_line(log_x, log_y).slope;
}

FloorFit fit_floor(const std::vector<double>& x, const std::vector<double>& y)
{
    const FloorFit unknown{UNKNOWN_VALUE, UNKNOWN_VALUE, UNKNOWN_VALUE};
    if (x.size() < FLOOR_FIT_POINTS) return unknown;
    // Find the neighbourhood of the best exponent, then narrow it by the golden section.
    const double step = std::log(STEEPEST / FLATTEST) / COARSE_STEPS;
    FloorAt best;
    int best_index = 0;
    for (int i = 0; i <= COARSE_STEPS; ++i) {
        const FloorAt found = floor_at(x, y, FLATTEST * std::exp(i * step));
        if (found.residual >= best.residual) continue;
        best = found;
        best_index = i;
    }
    if (!std::isfinite(best.residual)) return unknown;
    const double golden = (std::sqrt(5.0) - 1.0) / 2;
    double low = std::log(FLATTEST) + std::max(best_index - 1, 0) * step;
    double high = std::log(FLATTEST) + std::min(best_index + 1, COARSE_STEPS) * step;
    for (int i = 0; i < FINE_STEPS; ++i) {
        const double left = high - golden * (high - low), right = low + golden * (high - low);
        const FloorAt at_left = floor_at(x, y, std::exp(left)), at_right = floor_at(x, y, std::exp(right));
        if (at_left.residual < best.residual) best = at_left;
        if (at_right.residual < best.residual) best = at_right;
        (at_left.residual < at_right.residual ? high : low) = at_left.residual < at_right.residual ? right : left;
    }
    return best.fit;
}

Crossing find_crossing(const std::vector<double>& x, const std::vector<double>& y, double target)
{
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(y[i] <= target)) continue;
        if (i == 0) return {Crossing::Kind::before_first, x[0]};
        if (!(x[i] > 0.0 && x[i - 1] > 0.0 && y[i] > 0.0)) return {Crossing::Kind::at, x[i]};
        const double share = std::log(y[i - 1] / target) / std::log(y[i - 1] / y[i]);
        return {Crossing::Kind::at, x[i - 1] * std::pow(x[i] / x[i - 1], share)};
    }
    return {};
}
} // namespace etendue
