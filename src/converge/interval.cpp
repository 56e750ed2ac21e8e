// Student's interval and the bootstrap.
#include "converge/interval.h"

#include "util/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace etendue
{
namespace
{
constexpr double UNBOUNDED = std::numeric_limits<double>::infinity();
} // namespace

Draw everyone(std::size_t replicates)
{
    Draw all(replicates);
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

double mean_of(const std::vector<double>& values)
{
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Interval mean_interval(const std::vector<double>& values, double level)
{
    RunningStatistics statistics;
    for (const double value : values) statistics.add(value);
    if (statistics.count() == 0) return {};
    if (statistics.count() == 1) return {statistics.mean(), -UNBOUNDED, UNBOUNDED};
    const double degrees = static_cast<double>(statistics.count() - 1);
    const double half = student_t_quantile(0.5 + level / 2, degrees) * statistics.standard_error();
    return {statistics.mean(), statistics.mean() - half, statistics.mean() + half};
}

std::vector<Draw> bootstrap_draws(std::size_t replicates, std::size_t count, std::uint64_t seed)
{
    std::mt19937_64 random(seed);
    std::vector<Draw> draws(count, Draw(replicates));
    // The standard's distributions differ between libraries; this does not.
    for (Draw& draw : draws)
        for (std::size_t& index : draw) index = static_cast<std::size_t>((random() >> 32) * replicates >> 32);
    return draws;
}

Interval bootstrap_t_interval(double estimate, const std::vector<double>& values, std::size_t replicates, double level,
                              double further_error)
{
    if (!std::isfinite(estimate)) return {};
    if (replicates < 2) return {estimate, -UNBOUNDED, UNBOUNDED};
    RunningStatistics spread;
    for (const double value : values) spread.add(value);
    const double count = static_cast<double>(replicates);
    const double error = std::sqrt(spread.variance() * count / (count - 1) + further_error * further_error);
    if (!std::isfinite(error)) return {estimate, -UNBOUNDED, UNBOUNDED};
    const double half = student_t_quantile(0.5 + level / 2, count - 1) * error;
    return {estimate, estimate - half, estimate + half};
}

Interval bootstrap_ratio_interval(const Statistic& statistic, const std::vector<Draw>& draws, double level)
{
    if (draws.empty() || draws.front().empty()) return {};
    const std::size_t replicates = draws.front().size();
    const double estimate = statistic(everyone(replicates));
    if (!(estimate > 0.0 && std::isfinite(estimate))) return {estimate, -UNBOUNDED, UNBOUNDED};
    std::vector<double> logarithms;
    std::size_t unknown = 0;
    for (const Draw& draw : draws) {
        const double value = statistic(draw);
        if (value > 0.0 && std::isfinite(value))
            logarithms.push_back(std::log(value));
        else
            ++unknown;
    }
    // What is unknown could be anywhere.
    if (static_cast<double>(unknown) > (1.0 - level) / 2 * static_cast<double>(draws.size()))
        return {estimate, -UNBOUNDED, UNBOUNDED};
    const Interval interval = bootstrap_t_interval(std::log(estimate), logarithms, replicates, level);
    return {estimate, std::exp(interval.low), std::exp(interval.high)};
}

double quantile(std::vector<double> values, double share)
{
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::sort(values.begin(), values.end());
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    if (below + 1 >= values.size()) return values.back();
    return values[below] + (place - static_cast<double>(below)) * (values[below + 1] - values[below]);
}
} // namespace etendue
