// Ratios with paired bootstraps.
#include "converge/ratios.h"

#include <algorithm>
#include <cmath>

namespace etendue
{
namespace
{
double seconds_to(const RunCurve& curve, const Draw& draw, const Target& target)
{
    const Crossing crossing = find_crossing(curve.mean_seconds(draw), curve.mean(draw, target.metric), target.value);
    return crossing.kind == Crossing::Kind::at ? crossing.x : std::nan("");
}

bool reaches(const ConfigurationAnalysis& configuration, std::size_t target)
{
    return target < configuration.targets.size() && configuration.targets[target].render.kind == Crossing::Kind::at;
}

// The hardest target that both reach between their checkpoints.
std::optional<Target> common_target(const ConfigurationAnalysis& a, const ConfigurationAnalysis& b,
                                    const std::vector<Target>& targets)
{
    std::optional<Target> hardest;
    for (std::size_t i = 0; i < targets.size(); ++i)
        if (reaches(a, i) && reaches(b, i) && (!hardest || targets[i].value < hardest->value)) hardest = targets[i];
    return hardest;
}

Ratio ratio_of(const ConfigurationAnalysis& a, const ConfigurationAnalysis& b, const RunCurve& curve_a,
               const RunCurve& curve_b, const StudyOptions& options)
{
    Ratio ratio;
    const std::size_t seeds = std::min(curve_a.runs(), curve_b.runs());
    if (seeds == 0) return ratio;
    const std::vector<Draw> draws = bootstrap_draws(seeds, options.draws);
    if (!slopes_differ(a.slope_samples, b.slope_samples)) {
        ratio.value = bootstrap_ratio_interval(
            [&](const Draw& draw) { return curve_a.efficiency(draw) / curve_b.efficiency(draw); }, draws);
        return ratio;
    }
    ratio.target = common_target(a, b, options.targets);
    if (!ratio.target) return ratio;
    const auto times = [&](const Draw& draw) {
        return seconds_to(curve_b, draw, *ratio.target) / seconds_to(curve_a, draw, *ratio.target);
    };
    ratio.value = bootstrap_ratio_interval(times, draws);
    return ratio;
}
} // namespace

bool slopes_differ(const Interval& a, const Interval& b)
{
    return a.known() && b.known() && !a.overlaps(b) && std::abs(a.estimate - b.estimate) > SLOPE_TOLERANCE;
}

std::vector<std::vector<Ratio>> ratio_matrix(const std::vector<ConfigurationAnalysis>& configurations,
                                             const std::vector<RunCurve>& curves, const StudyOptions& options)
{
    const std::size_t count = configurations.size();
    std::vector<std::vector<Ratio>> matrix(count, std::vector<Ratio>(count));
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j)
            matrix[i][j] = i == j ? Ratio{{1.0, 1.0, 1.0}, {}}
                                  : ratio_of(configurations[i], configurations[j], curves[i], curves[j], options);
    return matrix;
}
} // namespace etendue
