// Paired samples in float and in double.
#include "check/twin_checks.h"

#include "check/findings.h"
#include "check/scene_source.h"
#include "math/rounding.h"
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

constexpr double SAMPLES_PER_PIXEL = 4.0;
constexpr std::uint32_t MAX_VERTICES = 10; // max_depth, the last hit and one more

// Of each scene so many samples, fewer where paths are long.
constexpr double SCENE_SAMPLES = 16384;
constexpr double SCENE_VERTICES = 1 << 20;

// The largest share of paths that may part at one vertex.
constexpr double MAX_DIVERGENCE = 1e-3;
// Shares of fewer pairs than these say too little.
constexpr std::uint64_t MIN_PAIRS = 10000;

// As long as a path without a limit is taken to be.
constexpr std::uint32_t UNLIMITED_DEPTH = 64;

// What float's own roundings may shift the mean by, relatively: some of them on a path and two at each vertex, all to
// one side.
double rounding_bias(const Scene& scene)
{
    return FLOAT_ROUNDING * (240.0 + 2.0 * scene.integrator.max_depth.value_or(UNLIMITED_DEPTH));
}

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

// Samples of a scene in both precisions, spread evenly over its pixels; by its own kernels or the general ones.
Pairs trace_pairs(const CheckContext& context, const Scene& scene, const Geometry& geometry, double sample_count,
                  std::uint32_t max_vertices, bool specialize)
{
    const ReplayOptions options{specialize, context.cache};
    Replayer single(*context.device, scene, geometry, Precision::single, options);
    Replayer twin(*context.device, scene, geometry, Precision::fp64, options);
    constexpr std::uint64_t BATCH = 16384;
    const auto width = static_cast<std::uint64_t>(scene.film.width);
    const std::uint64_t pixels = width * static_cast<std::uint64_t>(scene.film.height);
    const auto count = static_cast<std::uint64_t>(std::ceil(sample_count * context.effort));
    Pairs pairs;
    for (std::uint64_t first = 0; first < count && !context.stop(); first += BATCH) {
        std::vector<ReplaySample> samples;
        for (std::uint64_t i = first; i < std::min(first + BATCH, count); ++i) {
            // Pixel after pixel, or some of them.
            const std::uint64_t pixel = count < pixels ? i * pixels / count : i % pixels;
            samples.push_back({static_cast<std::uint32_t>(pixel % width), static_cast<std::uint32_t>(pixel / width),
                               count < pixels ? 0 : i / pixels});
        }
        const auto a = single.replay(samples, max_vertices), b = twin.replay(samples, max_vertices);
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
CheckResult mean_result(const std::string& name, const Pairs& pairs, double bias, const CheckContext& context)
{
    const double n = static_cast<double>(pairs.difference.count());
    const double difference = pairs.difference.mean(), error = pairs.difference.standard_error();
    const double mean = pairs.twin.mean();
    const double beyond = std::max(std::abs(difference) - bias * mean, 0.0);
    CheckResult result;
    result.name = name;
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
    // Where nothing differs in black there is nothing to miss.
    const bool is_black = mean == 0.0 && error == 0.0;
    if (!(result.detectable_bias <= context.delta) && !is_black) result.verdict = Verdict::underpowered;
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
    Scene scene = parse_scene(CORNELL, "cornell.json").scene;
    scene.sampler.seed += context.seed;
    const double samples = SAMPLES_PER_PIXEL * scene.film.width * scene.film.height;
    const Pairs pairs = trace_pairs(context, scene, make_geometry(scene), samples, MAX_VERTICES, true);
    if (pairs.difference.count() < 2) return {}; // stopped
    return {mean_result("D2-mean-difference", pairs, rounding_bias(scene), context),
            divergence_result(pairs.divergence)};
}

std::vector<CheckResult> run_scene(const std::string& name, const SceneSource& source, const CheckContext& context)
{
    if (!context.device->info().has_double) return {needs_double(name, Rule::stat, context.device->info())};
    Scene scene = source.load().scene;
    scene.sampler.seed += context.seed;
    const bool lenient = scene.expectation && scene.expectation->lenient;
    const double length = scene.integrator.max_depth.value_or(UNLIMITED_DEPTH) + 1.0;
    const double samples = std::min(SCENE_SAMPLES, std::max(64.0, SCENE_VERTICES / length));
    const Pairs pairs = trace_pairs(context, scene, make_geometry(scene, {lenient}), samples, 1, context.specialize);
    if (pairs.difference.count() < 2) return {}; // stopped
    return {mean_result(name, pairs, rounding_bias(scene), context)};
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
    std::vector<Check> checks{make_check("device", "D2", run_twin_check, 1)};
    for (const SceneSource& source : stiff_scenes()) {
        // All the light there is here comes of roundings.
        if (source.name.starts_with("L9-edge-on")) continue;
        const std::string name = "D2-" + source.name;
        const auto run = [name, source](const CheckContext& context) { return run_scene(name, source, context); };
        checks.push_back(make_check("device", name, run, 1, true));
    }
    return checks;
}
} // namespace etendue
