// Least squares.
#include "converge/fit.h"

#include <cmath>
#include <limits>

namespace etendue
{
namespace
{
constexpr double UNKNOWN_VALUE = std::numeric_limits<double>::quiet_NaN();
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
    double uu = 0.0, uv = 0.0, vv = 0.0, u1 = 0.0, v1 = 0.0;
    std::size_t points = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (x[i] * FLOOR_FIT_SPAN < x.back()) continue;
        ++points;
        // (a / x + b) / y = 1, relative to the last x.
        const double u = x.back() / (x[i] * y[i]), v = 1.0 / y[i];
        uu += u * u;
        uv += u * v;
        vv += v * v;
        u1 += u;
        v1 += v;
    }
    const double determinant = uu * vv - uv * uv;
    if (points < FLOOR_FIT_POINTS || !(determinant > 0.0)) return {UNKNOWN_VALUE, UNKNOWN_VALUE};
    return {(u1 * vv - v1 * uv) / determinant * x.back(), (v1 * uu - u1 * uv) / determinant};
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
