// Pearson's test with pooling, and its power by the normal approximation of the noncentral distribution.
#include "util/chi_square.h"

#include "util/statistics.h"

#include <cmath>
#include <numeric>

namespace etendue
{
namespace
{
constexpr double LEAST_EXPECTED = 5.0;
// A bias at the smallest that a test may miss is found with this quantile's probability, 99 %.
constexpr double POWER_QUANTILE = 2.33;

// The least x >= low at which a rising function is not negative.
template<typename Function>
double find_root(double low, Function rising)
{
    double high = low + 1.0;
    while (rising(high) < 0.0) high *= 2.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (rising(middle) < 0.0 ? low : high) = middle;
    }
    return high;
}

// Noncentrality that pushes the statistic beyond its critical value in 99 of 100 runs: mean degrees + x, variance
// 2 (degrees + 2 x).
double visible_noncentrality(double degrees, double level)
{
    const double critical = find_root(degrees, [&](double x) { return level - chi_square_p_value(x, degrees); });
    return find_root(
        0.0, [&](double x) { return degrees + x - POWER_QUANTILE * std::sqrt(2.0 * (degrees + 2.0 * x)) - critical; });
}
} // namespace

void Histogram::add(double x, double y)
{
    if (!(x >= 0.0 && x <= 1.0 && y >= 0.0 && y <= 1.0)) {
        ++outside_;
        return;
    }
    const auto bin = [](double t, std::size_t bins) {
        return std::min(bins - 1, static_cast<std::size_t>(t * static_cast<double>(bins)));
    };
    ++counts_[bin(y, rows_) * columns_ + bin(x, columns_)];
}

double Histogram::total() const
{
    return std::accumulate(counts_.begin(), counts_.end(), outside_);
}

ChiSquare chi_square(const std::vector<double>& counts, const std::vector<double>& expected, double level)
{
    // Pool neighbouring bins until enough is expected; what is left at the end joins the last pool.
    std::vector<double> pooled_counts, pooled_expected;
    double count = 0.0, mean = 0.0, samples = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        samples += counts[i];
        count += counts[i];
        mean += expected[i];
        if (mean < LEAST_EXPECTED) continue;
        pooled_counts.push_back(count);
        pooled_expected.push_back(mean);
        count = mean = 0.0;
    }
    if (pooled_counts.size() < 2) return {};
    pooled_counts.back() += count;
    pooled_expected.back() += mean;

    double statistic = 0.0;
    for (std::size_t i = 0; i < pooled_counts.size(); ++i)
        statistic += std::pow(pooled_counts[i] - pooled_expected[i], 2.0) / pooled_expected[i];
    const double degrees = static_cast<double>(pooled_counts.size() - 1);
    return {chi_square_p_value(statistic, degrees), degrees,
            std::sqrt(visible_noncentrality(degrees, level) / samples)};
}
} // namespace etendue
