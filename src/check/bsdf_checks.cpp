// Each check of each BSDF is one line of the table: over all its cases of parameters and the standard directions, with
// sums and integrals in double precision.
#include "check/bsdf_checks.h"

#include "check/bsdf_suite.h"
#include "check/equal_mass_bins.h"
#include "check/findings.h"
#include "math/rounding.h"
#include "scene/material_parser.h"
#include "util/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr double PI = std::numbers::pi;
constexpr uint LAST = 0xffffffffu;
// Of the histograms.
constexpr std::size_t BINS = 64 * 128;
constexpr std::size_t HISTOGRAM_SAMPLES = std::size_t{1} << 22;
constexpr std::size_t PILOT_SAMPLES = 32 * BINS;

using Results = std::vector<CheckResult>;

std::string from(const BsdfCase& bsdf, const Direction& wo)
{
    return fmt::format("{} from cosine {:.4g}", bsdf.name, wo[2]);
}

std::array<double, 3> cross(const Direction& a, const Direction& b)
{
    return {double{a[1]} * b[2] - double{a[2]} * b[1], double{a[2]} * b[0] - double{a[0]} * b[2],
            double{a[0]} * b[1] - double{a[1]} * b[0]};
}

Direction minus(const Direction& a, const Direction& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double length(const Direction& a)
{
    return std::sqrt(double{a[0]} * a[0] + double{a[1]} * a[1] + double{a[2]} * a[2]);
}

bool relatively_equal(double a, double b, double tolerance)
{
    return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

bool is_finite(const std::array<float, 3>& a)
{
    return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

std::vector<Direction> directions_of(const std::vector<DeviceBsdf::Sample>& samples)
{
    std::vector<Direction> wi;
    for (const auto& s : samples) wi.push_back(s.wi);
    return wi;
}

// Whether a direction was sampled, and can be counted.
bool has_direction(const DeviceBsdf::Sample& s)
{
    return s.pdf > 0 && is_finite(s.wi);
}

// A sample's weight is f |cos| / pdf, its density is pdf(), and it takes no energy from nowhere.
Results check_weights(const CheckContext& context, const std::string& name, const std::vector<BsdfCase>& cases)
{
    const auto count = static_cast<std::size_t>(4096 * context.effort);
    const std::vector<RandomWords> random = random_words(count, context.seed + 11);
    Violations violations;
    for (const BsdfCase& bsdf : cases) {
        const DeviceBsdf on_device(*context.device, bsdf, context.lanes);
        for (const Direction& wo : standard_directions()) {
            violations.set_subject(from(bsdf, wo));
            const std::vector<DeviceBsdf::Sample> samples = on_device.sample({wo}, random);
            const std::vector<Direction> wi = directions_of(samples);
            const DeviceBsdf::Evaluation evaluation = on_device.evaluate({wo}, wi);
            for (std::size_t i = 0; i < samples.size(); ++i) {
                const double pdf = evaluation.pdf[i], cosine = std::abs(wi[i][2]);
                violations.expect(pdf > 0, "without density");
                violations.expect(relatively_equal(samples[i].pdf, pdf, 64 * FLOAT_ROUNDING), "density of the sample");
                violations.expect(std::abs(length(wi[i]) - 1) <= 8 * FLOAT_ROUNDING, "not of unit length");
                for (std::size_t k = 0; k < 3; ++k) {
                    const double weight = evaluation.f[i][k] * cosine / pdf;
                    violations.expect(relatively_equal(samples[i].weight[k], weight, 64 * FLOAT_ROUNDING), "weight");
                    violations.expect(samples[i].weight[k] >= 0 && samples[i].weight[k] <= 1 + 64 * FLOAT_ROUNDING,
                                      "weight out of [0, 1]");
                }
            }
        }
    }
    return {violations.result(name, Rule::bound)};
}

// What the random numbers would have to be for the direction that single precision makes of them, by the inverse in
// double precision: themselves, but for some roundings and what the direction's own roundings do to the inverse.
Results check_inversion(const CheckContext& context, const std::string& name, const std::vector<BsdfCase>& cases)
{
    constexpr double ROUNDINGS = 4;
    const DeviceInfo& device = context.device->info();
    if (!device.has_double) return {needs_double(name, Rule::bound, device)};
    const auto count = static_cast<std::size_t>(4096 * context.effort);
    const std::vector<RandomWords> random = random_words(count, context.seed + 23);
    WorstError worst;
    Violations violations;
    for (const BsdfCase& bsdf : cases) {
        const DeviceBsdf on_device(*context.device, bsdf, context.lanes);
        for (const Direction& wo : standard_directions()) {
            worst.set_subject(from(bsdf, wo));
            violations.set_subject(from(bsdf, wo));
            const std::vector<Direction> wi = directions_of(on_device.sample({wo}, random));
            const auto numbers = on_device.invert_in_double(wo, wi);
            // Round each component of the directions once more.
            std::vector<std::array<double, 2>> conditions(count);
            for (std::size_t k = 0; k < 3; ++k) {
                std::vector<Direction> rounded = wi;
                for (Direction& w : rounded) w[k] = std::nextafter(w[k], 2.0f);
                const auto moved = on_device.invert_in_double(wo, rounded);
                for (std::size_t i = 0; i < count; ++i)
                    for (std::size_t j = 0; j < 2; ++j)
                        conditions[i][j] += std::abs(std::remainder(moved[i][j] - numbers[i][j], 1.0));
            }
            for (std::size_t i = 0; i < count; ++i) {
                violations.expect(numbers[i][0] >= 0 && numbers[i][1] >= 0, "no inverse");
                for (std::size_t j = 0; j < 2; ++j) {
                    const double given = (random[i][j] >> 8) * FLOAT_ROUNDING;
                    const double error = std::abs(std::remainder(numbers[i][j] - given, 1.0));
                    worst.add(error / (ROUNDINGS * (FLOAT_ROUNDING + conditions[i][j])));
                }
            }
        }
    }
    return {worst.result(name, 1.0, "of what 4 roundings do"), violations.result(name + "-exists")};
}

// Squares of the random numbers' plane become patches of the sphere: their size is the square's over the density. Asked
// of samples whose direction takes no choice of a lobe.
Results check_jacobian(const CheckContext& context, const std::string& name, const std::vector<BsdfCase>& cases)
{
    constexpr uint HALF = 1u << 22; // half the side of a square, of 2^32
    constexpr double AREA = 0x1p-18;
    Violations violations;
    for (const BsdfCase& bsdf : cases) {
        std::mt19937_64 generator(context.seed + 3);
        const DeviceBsdf on_device(*context.device, bsdf, context.lanes);
        for (const Direction& wo : standard_directions()) {
            violations.set_subject(from(bsdf, wo));
            std::vector<RandomWords> corners;
            for (int i = 0; i < 512; ++i) {
                // Stay away from the border of the plane, where maps may have edges.
                const auto inner = [&] {
                    return (1u << 27) + static_cast<uint>(generator() % ((1u << 31) + (7u << 28)));
                };
                const uint u = inner(), v = inner();
                for (const uint lobe : {0u, LAST}) {
                    corners.push_back({u - HALF, v, lobe, 0});
                    corners.push_back({u + HALF, v, lobe, 0});
                    corners.push_back({u, v - HALF, lobe, 0});
                    corners.push_back({u, v + HALF, lobe, 0});
                    corners.push_back({u, v, lobe, 0});
                }
            }
            const std::vector<DeviceBsdf::Sample> samples = on_device.sample({wo}, corners);
            for (std::size_t i = 0; i < samples.size(); i += 10) {
                if (samples[i + 4].wi != samples[i + 9].wi) continue;
                const auto patch =
                    cross(minus(samples[i + 1].wi, samples[i].wi), minus(samples[i + 3].wi, samples[i + 2].wi));
                const double size = std::hypot(patch[0], patch[1], patch[2]);
                violations.expect(relatively_equal(size * samples[i + 4].pdf, AREA, 0.01), "area of a patch");
            }
        }
    }
    return {violations.result(name, Rule::bound)};
}

// f(a, b) = f(b, a) on each side: the light that passes is scaled by indices of refraction.
Results check_reciprocity(const CheckContext& context, const std::string& name, const std::vector<BsdfCase>& cases)
{
    const auto count = static_cast<std::size_t>((1 << 14) * context.effort);
    Violations violations;
    for (const BsdfCase& bsdf : cases) {
        violations.set_subject(bsdf.name);
        std::mt19937_64 random(context.seed + 5);
        std::uniform_real_distribution<double> uniform(-1, 1);
        std::vector<Direction> a, b;
        for (std::size_t i = 0; i < count; ++i) {
            const double side = i % 2 ? 1 : -1;
            a.push_back(direction(side * std::abs(uniform(random)), PI * uniform(random)));
            b.push_back(direction(side * std::abs(uniform(random)), PI * uniform(random)));
        }
        const DeviceBsdf on_device(*context.device, bsdf, context.lanes);
        const auto there = on_device.evaluate(a, b).f, back = on_device.evaluate(b, a).f;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                violations.expect(relatively_equal(there[i][k], back[i][k], 1e-5), "f there and back");
    }
    return {violations.result(name, Rule::bound)};
}

// Over all directions the density integrates to the share of samples that have a direction, and f |cos| to their mean
// weight, which is at most 1.
Results check_integrals(const CheckContext& context, const std::string& name, const std::vector<BsdfCase>& cases)
{
    const auto count = static_cast<std::size_t>((1 << 16) * context.effort);
    const std::vector<Direction> grid = sphere_grid(512, 128);
    const std::vector<RandomWords> random = random_words(count, context.seed + 19);
    const double solid_angle = 4 * PI / static_cast<double>(grid.size());
    ExpectedMeans density(context), albedo(context);
    WorstError energy;
    for (const BsdfCase& bsdf : cases) {
        const DeviceBsdf on_device(*context.device, bsdf, context.lanes);
        for (const Direction& wo : standard_directions()) {
            const DeviceBsdf::Evaluation evaluation = on_device.evaluate({wo}, grid);
            const std::vector<DeviceBsdf::Sample> samples = on_device.sample({wo}, random);
            double integral = 0;
            for (const float pdf : evaluation.pdf) integral += pdf * solid_angle;
            RunningStatistics directions;
            for (const auto& s : samples) directions.add(s.pdf > 0);
            density.add(from(bsdf, wo), directions.mean(), directions.standard_error(), integral, 1e-4);
            energy.set_subject(from(bsdf, wo));
            for (std::size_t k = 0; k < 3; ++k) {
                double reflected = 0;
                for (std::size_t i = 0; i < grid.size(); ++i)
                    reflected += evaluation.f[i][k] * std::abs(grid[i][2]) * solid_angle;
                RunningStatistics weights;
                for (const auto& s : samples) weights.add(s.pdf > 0 ? s.weight[k] : 0.0);
                albedo.add(from(bsdf, wo), weights.mean(), weights.standard_error(), reflected, 1e-4);
                energy.add(reflected);
            }
        }
    }
    return {density.result(name + "-density"), albedo.result(name + "-albedo"),
            energy.result(name + "-energy", 1 + 1e-4, "of what arrives")};
}

// Samples are distributed as the density says, in bins that other samples have cut. The cases take turns in what they
// are seen from: steeply from above, at a slant from below.
Results check_distribution(const CheckContext& context, const std::string& name, const std::vector<BsdfCase>& cases)
{
    constexpr std::size_t BATCH = std::size_t{1} << 16; // what a cache holds
    const auto batches = static_cast<std::size_t>(std::ceil(HISTOGRAM_SAMPLES * context.effort / BATCH));
    const Direction directions[] = {direction(0.9, 1), direction(-0.2, 4)};
    DistributionTests tests(context);
    for (std::size_t i = 0; i < cases.size() && !context.stop(); ++i) {
        const DeviceBsdf on_device(*context.device, cases[i], context.lanes);
        const Direction& wo = directions[i % 2];
        // Cut bins by some samples.
        std::vector<DeviceBsdf::Sample> some =
            on_device.sample({wo}, random_words(PILOT_SAMPLES, context.seed + 31 + i));
        std::erase_if(some, [](const auto& s) { return !has_direction(s); });
        const EqualMassBins bins(directions_of(some), BINS);
        std::vector<double> probabilities =
            bins.integrate([&](const std::vector<Direction>& wi) { return on_device.evaluate({wo}, wi).pdf; });
        // Count others. Those that end the path are a bin of their own; what is not finite is in none.
        std::vector<double> counts(bins.count());
        double ended = 0, outside = 0;
        for (std::size_t batch = 0; batch < batches; ++batch)
            for (const auto& s : on_device.sample({wo}, random_words(BATCH, context.seed + 1000 + i * batches + batch)))
                ++(has_direction(s) ? counts[bins.bin_of(s.wi)] : s.pdf == 0 ? ended : outside);
        if (ended > 0) {
            counts.push_back(ended);
            probabilities.push_back(
                std::max(0.0, 1 - std::accumulate(probabilities.begin(), probabilities.end(), 0.0)));
        }
        tests.add(from(cases[i], wo), counts, outside, probabilities);
    }
    return {tests.result(name)};
}

// Along the surface, at the normal, at the ends of the random numbers: finite, not negative, dark along the surface.
Results check_edges(const CheckContext& context, const std::string& name, const std::vector<BsdfCase>& cases)
{
    std::vector<Direction> directions{{1, 0, 0}, {0, -1, -0.0f}, {0, 0, 1}, {0, 0, -1}};
    for (const float z : {1e-45f, 0x1p-126f, 0x1p-60f, 0x1p-30f, 0x1p-24f, 1e-3f})
        for (const float side : {z, -z}) {
            directions.push_back({1, 0, side});
            directions.push_back({-0.6f, 0.8f, side});
        }
    std::vector<RandomWords> corners;
    for (const uint u : {0u, 1u << 8, 1u << 31, LAST})
        for (const uint v : {0u, 1u << 8, 1u << 31, LAST})
            for (const uint lobe : {0u, 1u << 31, LAST}) corners.push_back({u, v, lobe, 0});
    Violations violations;
    for (const BsdfCase& bsdf : cases) {
        const DeviceBsdf on_device(*context.device, bsdf, context.lanes);
        for (const Direction& wo : directions) {
            violations.set_subject(from(bsdf, wo));
            for (const auto& s : on_device.sample({wo}, corners)) {
                violations.expect(is_finite(s.wi) && std::isfinite(s.pdf) && std::isfinite(s.radiance_scale),
                                  "sample not finite");
                violations.expect(wo[2] != 0 || s.pdf == 0, "sample from along the surface");
                violations.expect(s.pdf >= 0, "negative density of a sample");
                if (!(s.pdf > 0)) continue;
                for (const float w : s.weight) {
                    violations.expect(std::isfinite(w) && w >= 0, "weight not finite or negative");
                    violations.expect(w <= s.radiance_scale * (1 + 64 * FLOAT_ROUNDING), "weight above 1");
                }
            }
            const DeviceBsdf::Evaluation evaluation = on_device.evaluate({wo}, directions);
            for (std::size_t i = 0; i < directions.size(); ++i) {
                const auto& f = evaluation.f[i];
                violations.expect(is_finite(f) && std::isfinite(evaluation.pdf[i]), "value not finite");
                violations.expect(f[0] >= 0 && f[1] >= 0 && f[2] >= 0 && evaluation.pdf[i] >= 0, "negative value");
                violations.expect((wo[2] != 0 && directions[i][2] != 0) || evaluation.pdf[i] == 0,
                                  "density along the surface");
            }
        }
    }
    return {violations.result(name, Rule::bound)};
}

// A delta lobe is sampled only, keeps its energy and can be followed back.
Results check_delta(const CheckContext& context, const std::string& name, const std::vector<BsdfCase>& cases)
{
    // The lobe is chosen evenly, so that a mean over it is an integral.
    constexpr uint LOBES = 4096;
    std::vector<RandomWords> lobes;
    for (uint i = 0; i < LOBES; ++i) lobes.push_back({0, 0, i * (LAST / LOBES + 1) + (LAST / LOBES + 1) / 2, 0});
    Violations violations;
    for (const BsdfCase& bsdf : cases) {
        const DeviceBsdf on_device(*context.device, bsdf, context.lanes);
        std::size_t followed_back = 0;
        for (const Direction& wo : standard_directions()) {
            violations.set_subject(from(bsdf, wo));
            const auto samples = on_device.sample({wo}, lobes);
            const std::vector<Direction> wi = directions_of(samples);
            double energy[3] = {0, 0, 0};
            for (const auto& s : samples) {
                violations.expect(s.delta && s.pdf == 1, "not a delta sample");
                violations.expect(std::abs(length(s.wi) - 1) <= 16 * FLOAT_ROUNDING, "not of unit length");
                for (std::size_t k = 0; k < 3; ++k) energy[k] += s.weight[k] / s.radiance_scale / LOBES;
            }
            for (const double e : energy) violations.expect(e <= 1 + 64 * FLOAT_ROUNDING, "energy above 1");
            const DeviceBsdf::Evaluation evaluation = on_device.evaluate({wo}, wi);
            for (std::size_t i = 0; i < wi.size(); ++i)
                violations.expect(evaluation.pdf[i] == 0 && evaluation.f[i] == std::array<float, 3>{0, 0, 0},
                                  "a value that light sampling could use");

            // One of the lobes from wi leads to wo.
            const auto first = on_device.sample(wi, std::vector<RandomWords>(wi.size(), {0, 0, 0, 0}));
            const auto last = on_device.sample(wi, std::vector<RandomWords>(wi.size(), {0, 0, LAST, 0}));
            for (std::size_t i = 0; i < wi.size(); ++i) {
                // The cosine on the side of the larger index is rounded: its square is out by 2 u, eta^2 times that on
                // the other side. Below some cosine that may turn a ray into the surface.
                const double eta = std::sqrt(std::max(samples[i].radiance_scale, 1 / samples[i].radiance_scale));
                const double cosine = std::min(std::abs(wo[2]), std::abs(wi[i][2]));
                if (cosine * cosine < 1e-6 * eta * eta) continue;
                ++followed_back;
                violations.expect(std::min(length(minus(first[i].wi, wo)), length(minus(last[i].wi, wo))) <=
                                      2e-7 * eta * eta / cosine + 1e-6,
                                  "no way back");
            }
        }
        violations.expect(followed_back >= 6 * std::size_t{LOBES}, "too few ways back were tried");
    }
    return {violations.result(name, Rule::bound)};
}
} // namespace

std::vector<Check> bsdf_checks()
{
    using Run = Results (*)(const CheckContext&, const std::string&, const std::vector<BsdfCase>&);
    std::vector<Check> checks;
    for (int number = 0; number < BSDF_COUNT; ++number) {
        const auto type = static_cast<BsdfType>(number);
        const std::size_t cases = bsdf_cases(type).size();
        const auto add = [&](const char* what, Run run, std::size_t statistical_tests = 0) {
            const std::string name = std::string(bsdf_name(type)) + "-" + what;
            checks.push_back(make_check(
                "bsdf", name, [=](const CheckContext& context) { return run(context, name, bsdf_cases(type)); },
                statistical_tests));
        };
        add("edges", check_edges);
        if (bsdf_is_delta(type)) {
            add("delta", check_delta);
            continue;
        }
        add("weight", check_weights);
        add("inversion", check_inversion);
        add("jacobian", check_jacobian);
        add("reciprocity", check_reciprocity);
        add("integral", check_integrals, cases * standard_directions().size() * 4);
        add("distribution", check_distribution, cases);
    }
    for (Check& check : fresnel_checks()) checks.push_back(std::move(check));
    return checks;
}
} // namespace etendue
