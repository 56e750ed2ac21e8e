// Paired samples in float and in double.
#include "check/twin_checks.h"

#include "check/findings.h"
#include "scene/scene_loader.h"
#include "util/statistics.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
// Cornell's box: two metres wide, open in front, two turned boxes and a small light below the ceiling.
const char* const CORNELL = R"({
    "camera": {"position": [0, 1, 6.8], "look_at": [0, 1, 0], "vertical_fov": 19.5},
    "film": {"size": [128, 128]},
    "integrator": {"type": "path", "max_depth": 8, "roulette": "off"},
    "materials": [{"name": "white", "type": "diffuse", "albedo": [0.725, 0.71, 0.68]},
                  {"name": "green", "type": "diffuse", "albedo": [0.14, 0.45, 0.091]},
                  {"name": "red", "type": "diffuse", "albedo": [0.63, 0.065, 0.05]}],
    "shapes": [
        {"type": "rectangle", "size": [2, 2], "material": "white",
         "transform": {"rotate": {"axis": [1, 0, 0], "angle": -90}}},
        {"type": "rectangle", "size": [2, 2], "material": "white",
         "transform": [{"rotate": {"axis": [1, 0, 0], "angle": 90}}, {"translate": [0, 2, 0]}]},
        {"type": "rectangle", "size": [2, 2], "material": "white", "transform": {"translate": [0, 1, -1]}},
        {"type": "rectangle", "size": [2, 2], "material": "red",
         "transform": [{"rotate": {"axis": [0, 1, 0], "angle": 90}}, {"translate": [-1, 1, 0]}]},
        {"type": "rectangle", "size": [2, 2], "material": "green",
         "transform": [{"rotate": {"axis": [0, 1, 0], "angle": -90}}, {"translate": [1, 1, 0]}]},
        {"type": "box", "size": [0.6, 0.6, 0.6], "material": "white",
         "transform": [{"rotate": {"axis": [0, 1, 0], "angle": -17}}, {"translate": [0.33, 0.3, 0.35]}]},
        {"type": "box", "size": [0.6, 1.2, 0.6], "material": "white",
         "transform": [{"rotate": {"axis": [0, 1, 0], "angle": 18}}, {"translate": [-0.33, 0.6, -0.3]}]}],
    "lights": [{"type": "rectangle", "size": [0.5, 0.5], "radiance": [17, 12, 5],
                "transform": [{"rotate": {"axis": [1, 0, 0], "angle": 90}}, {"translate": [0, 1.98, 0]}]}]
})";

constexpr std::uint32_t FILM_SIZE = 128;
constexpr double SAMPLES_PER_PIXEL = 4.0;
constexpr std::uint32_t MAX_VERTICES = 10; // max_depth, the last hit and one more

// The largest share of paths that may part at one vertex.
constexpr double MAX_DIVERGENCE = 1e-3;
// Shares of fewer pairs than these say too little.
constexpr std::uint64_t MIN_PAIRS = 10000;

// What float's own roundings may shift the mean by, relatively: some 2^8 of them on a path, all to one side.
constexpr double ROUNDING_BIAS = 0x1p-16;

// P(Z <= z) of the power that detectable biases are told for.
constexpr double POWER = 0.99;

// Pairs of samples and what became of them.
struct Pairs {
    RunningStatistics difference, twin; // means over the three channels
    double largest = 0.0, sum = 0.0;    // of |difference|
    PathDivergence divergence;
};

double mean_of(const Vec3& radiance)
{
    return (radiance.x + radiance.y + radiance.z) / 3.0;
}

Pairs trace_pairs(const CheckContext& context)
{
    Scene scene = parse_scene(CORNELL, "cornell.json").scene;
    scene.sampler.seed += context.seed;
    const Geometry geometry = make_geometry(scene);
    Replayer single(*context.device, scene, geometry, Precision::single, {true, context.cache});
    Replayer twin(*context.device, scene, geometry, Precision::fp64, {true, context.cache});
    const auto samples_per_pixel = static_cast<std::uint64_t>(std::ceil(SAMPLES_PER_PIXEL * context.effort));
    Pairs pairs;
    std::vector<ReplaySample> samples(FILM_SIZE * FILM_SIZE);
    for (std::uint64_t s = 0; s < samples_per_pixel && !context.stop(); ++s) {
        for (std::uint32_t i = 0; i < samples.size(); ++i) samples[i] = {i % FILM_SIZE, i / FILM_SIZE, s};
        const auto a = single.replay(samples, MAX_VERTICES), b = twin.replay(samples, MAX_VERTICES);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double d = mean_of(a[i].radiance - b[i].radiance);
            pairs.difference.add(d);
            pairs.twin.add(mean_of(b[i].radiance));
            pairs.largest = std::max(pairs.largest, std::abs(d));
            pairs.sum += std::abs(d);
        }
        add_divergence(pairs.divergence, a, b);
    }
    return pairs;
}

// Student's t of the mean difference, what float's roundings shift it by left out.
CheckResult mean_result(const Pairs& pairs, const CheckContext& context)
{
    const double n = static_cast<double>(pairs.difference.count());
    const double difference = pairs.difference.mean(), error = pairs.difference.standard_error();
    const double mean = pairs.twin.mean();
    const double beyond = std::max(std::abs(difference) - ROUNDING_BIAS * mean, 0.0);
    CheckResult result;
    result.name = "D2-mean-difference";
    result.rule = Rule::stat;
    result.expected = "0";
    result.found = fmt::format("{:.2g} of {:.4g}", difference, mean);
    result.unit = "z";
    result.statistic = beyond == 0.0 ? 0.0 : beyond / error;
    result.critical = student_t_quantile(1.0 - context.test_alpha / 2.0, n - 1.0);
    result.detectable_bias = (result.critical + normal_quantile(POWER)) * error / mean;
    result.largest_share = pairs.sum > 0.0 ? pairs.largest / pairs.sum : 0.0;
    result.note = fmt::format("{:.0f} samples in float and double, standard error {:.2g}", n, error);
    result.verdict = Verdict::passed;
    if (!(result.detectable_bias <= context.delta)) result.verdict = Verdict::underpowered;
    if (!(result.statistic <= result.critical)) result.verdict = Verdict::failed;
    return result;
}

// The largest share of paths that part at a vertex, and every share in the note.
CheckResult divergence_result(const PathDivergence& divergence)
{
    CheckResult result;
    result.name = "D2-path-divergence";
    result.rule = Rule::bound;
    result.expected = fmt::format("at most {:g} of the paths at each vertex", MAX_DIVERGENCE);
    result.unit = "x limit";
    result.critical = 1.0;
    result.note = "share that parts at vertex";
    double worst = 0.0;
    bool judged = false;
    for (std::size_t i = 0; i < divergence.pairs.size() && divergence.pairs[i] > 0; ++i) {
        const double share = static_cast<double>(divergence.parted[i]) / static_cast<double>(divergence.pairs[i]);
        result.note += fmt::format("{} {}: {:.2g}", i == 0 ? "" : ",", i, share);
        if (divergence.pairs[i] < MIN_PAIRS) continue;
        judged = true;
        worst = std::max(worst, share);
    }
    result.found = fmt::format("{:.2g}", worst);
    result.statistic = worst / MAX_DIVERGENCE;
    result.verdict = judged && worst <= MAX_DIVERGENCE ? Verdict::passed : Verdict::failed;
    return result;
}

std::vector<CheckResult> run_twin_check(const CheckContext& context)
{
    const DeviceInfo& device = context.device->info();
    if (!device.has_double)
        return {needs_double("D2-mean-difference", Rule::stat, device),
                needs_double("D2-path-divergence", Rule::bound, device)};
    const Pairs pairs = trace_pairs(context);
    if (pairs.difference.count() < 2) return {}; // stopped
    return {mean_result(pairs, context), divergence_result(pairs.divergence)};
}
} // namespace

void add_divergence(PathDivergence& total, const std::vector<PathRecord>& a, const std::vector<PathRecord>& b)
{
    for (std::size_t path = 0; path < a.size(); ++path) {
        const auto &va = a[path].vertices, &vb = b[path].vertices;
        const std::size_t length = std::max(va.size(), vb.size());
        if (total.pairs.size() < length) {
            total.pairs.resize(length);
            total.parted.resize(length);
        }
        for (std::size_t i = 0; i < length; ++i) {
            const bool parts = i >= va.size() || i >= vb.size() || va[i].primitive != vb[i].primitive;
            ++total.pairs[i];
            total.parted[i] += parts;
            if (parts) break;
        }
    }
}

std::vector<Check> twin_checks()
{
    return {make_check("device", "D2", run_twin_check, 1)};
}
} // namespace etendue
