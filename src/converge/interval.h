// Estimates with intervals, from a handful of independent replicates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace etendue
{
struct Interval {
    double estimate = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();

    bool known() const { return low <= high; }
    bool contains(double x) const { return low <= x && x <= high; }
    bool overlaps(const Interval& other) const { return low <= other.high && other.low <= high; }
};

double mean_of(const std::vector<double>& values);

// The mean with Student's interval. Of one value the interval reaches everywhere.
Interval mean_interval(const std::vector<double>& values, double level = 0.95);

// Numbers of replicates drawn with replacement, `count` times; the same for equal arguments.
using Draw = std::vector<std::size_t>;
std::vector<Draw> bootstrap_draws(std::size_t replicates, std::size_t count, std::uint64_t seed = 1);

// A statistic of replicates, given by their numbers.
using Statistic = std::function<double(const Draw&)>;

// A statistic above 0 of all replicates, with an interval by Student's quantile times the spread of its logarithm over
// draws (as bootstrap_t_interval): percentiles of a few seeds are too narrow. It reaches everywhere when more draws
// than one end may miss have no such value.
Interval bootstrap_ratio_interval(const Statistic& statistic, const std::vector<Draw>& draws, double level = 0.95);

// An interval from a statistic of all replicates and its values for draws, by Student's quantile times the standard
// deviation of the values, widened by sqrt(R / (R - 1)): of few replicates percentiles are too narrow, and far levels
// are out of their reach. `further_error` is a standard deviation that all replicates share.
Interval bootstrap_t_interval(double estimate, const std::vector<double>& values, std::size_t replicates, double level,
                              double further_error = 0.0);

// Every replicate once.
Draw everyone(std::size_t replicates);

// The value below which a share of the values lies, by linear interpolation; NaN of none.
double quantile(std::vector<double> values, double share);
} // namespace etendue
