// What a BSDF of any kind has to satisfy, with sums and integrals in double precision.
#include "support/device_bsdf_suite.h"

#include "scene/material_parser.h"
#include "support/chi_square.h"
#include "util/statistics.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <numbers>
#include <random>

namespace etendue
{
namespace
{
constexpr double PI = std::numbers::pi;
constexpr double ROUNDOFF = 0x1p-24;
constexpr uint LAST = 0xffffffffu;

const char* BSDF_INPUTS = "Material* float* uint float float float";
const char* LOAD_MATERIAL = "SceneView view;\n"
                            "view.materials = in0;\n"
                            "view.parameters = in1;\n"
                            "Mask active = to_mask(true);\n"
                            "MaterialLanes m = load_material(view, in2, active);\n"
                            "Vec3 wo = vec3(in3, in4, in5);\n";

const DeviceFunctions& functions()
{
    static const DeviceFunctions all(
        {"bsdf/bsdf.h"},
        {{"evaluate", std::string(BSDF_INPUTS) + " float float float -> float float float float",
          std::string(LOAD_MATERIAL) + "Vec3 wi = vec3(in6, in7, in8);\n"
                                       "Color f = bsdf_evaluate(view, m, active, wo, wi);\n"
                                       "out0 = f.x; out1 = f.y; out2 = f.z;\n"
                                       "out3 = bsdf_pdf(view, m, active, wo, wi);\n"},
         {"sample",
          std::string(BSDF_INPUTS) + " uint uint uint uint -> float float float float float float float mask float",
          std::string(LOAD_MATERIAL) + "RandomBlock random = {in6, in7, in8, in9};\n"
                                       "BsdfSample s = bsdf_sample(view, m, active, wo, random);\n"
                                       "out0 = s.wi.x; out1 = s.wi.y; out2 = s.wi.z;\n"
                                       "out3 = s.weight.x; out4 = s.weight.y; out5 = s.weight.z;\n"
                                       "out6 = s.pdf; out7 = s.delta; out8 = s.radiance_scale;\n"}});
    return all;
}

// One list per component.
template<typename T, std::size_t N>
void append_components(std::vector<DeviceArgument>& arguments, const std::vector<std::array<T, N>>& vectors)
{
    for (std::size_t k = 0; k < N; ++k) {
        std::vector<T> component;
        for (const auto& v : vectors) component.push_back(v[k]);
        arguments.emplace_back(component);
    }
}

std::vector<DeviceArgument> material_arguments(const std::vector<BsdfCase>& cases, const std::vector<uint>& which,
                                               const std::vector<Direction>& wo)
{
    std::vector<Material> materials;
    std::vector<float> parameters;
    for (const BsdfCase& c : cases) {
        materials.push_back({static_cast<uint>(c.type), 0, static_cast<uint>(parameters.size()), 0});
        parameters.insert(parameters.end(), c.parameters.begin(), c.parameters.end());
    }
    std::vector<DeviceArgument> arguments{materials, parameters, which};
    append_components(arguments, wo);
    return arguments;
}

std::vector<RandomWords> random_words(std::size_t count, unsigned seed)
{
    std::mt19937 random(seed);
    std::vector<RandomWords> words(count);
    for (RandomWords& w : words)
        for (uint& x : w) x = static_cast<uint>(random());
    return words;
}

Direction direction(double z, double phi)
{
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(z)};
}

// Midpoints of a grid of equal solid angles, in cos and phi, over the whole sphere.
std::vector<Direction> sphere_grid(std::size_t rows, std::size_t columns)
{
    std::vector<Direction> grid;
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t k = 0; k < columns; ++k)
            grid.push_back(direction(-1 + (2 * static_cast<double>(i) + 1) / static_cast<double>(rows),
                                     2 * PI * (static_cast<double>(k) + 0.5) / static_cast<double>(columns)));
    return grid;
}

std::vector<double> cross(const Direction& a, const Direction& b)
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
} // namespace

std::vector<BsdfCase> bsdf_cases(BsdfType type)
{
    std::mt19937 random(static_cast<unsigned>(type) + 1);
    std::uniform_real_distribution<double> uniform(0, 1);
    // Where in the range each parameter lies: at an end, or anywhere; below 0 is the default.
    const auto make = [&](auto place) {
        BsdfCase c{type, {}, bsdf_name(type)};
        const std::vector<double> standard = default_material(type).parameters;
        for (const BsdfParameter& row : bsdf_parameters()) {
            if (row.bsdf != type) continue;
            const Range& range = row.property.range;
            for (int k = 0; k < (row.property.kind == Kind::colour ? 3 : 1); ++k) {
                const double t = place(), low = range.low, high = range.high;
                // A wide range of positive numbers is one of ratios.
                const double value =
                    low > 0 && high > 10 * low ? low * std::pow(high / low, t) : low + (high - low) * t;
                c.parameters.push_back(static_cast<float>(t < 0 ? standard[c.parameters.size()] : value));
            }
        }
        c.name += fmt::format(" {}", fmt::join(c.parameters, " "));
        return c;
    };
    std::vector<BsdfCase> cases{make([] { return -1.0; }), make([] { return 0.0; }), make([] { return 1.0; })};
    for (int i = 0; i < 3; ++i) cases.push_back(make([&] { return uniform(random); }));
    return cases;
}

std::vector<Direction> standard_directions()
{
    std::vector<Direction> directions;
    double phi = 0.3;
    for (const double side : {1.0, -1.0})
        for (const double z : {1.0, 0.9, 0.5, 0.1, 0.01, 0.001}) directions.push_back(direction(side * z, phi += 1.1));
    return directions;
}

DeviceBsdf::Evaluation DeviceBsdf::evaluate(std::vector<Direction> wo, const std::vector<Direction>& wi) const
{
    if (wo.size() == 1) wo.resize(wi.size(), wo[0]);
    std::vector<DeviceArgument> arguments = material_arguments({bsdf_}, std::vector<uint>(wi.size(), 0), wo);
    append_components(arguments, wi);
    const DeviceResults results = functions().evaluate(device_, "evaluate", arguments, lanes_);
    Evaluation evaluation{std::vector<std::array<float, 3>>(wi.size()), results.get<float>(3)};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::vector<float> f = results.get<float>(k);
        for (std::size_t i = 0; i < f.size(); ++i) evaluation.f[i][k] = f[i];
    }
    return evaluation;
}

std::vector<DeviceBsdf::Sample> DeviceBsdf::sample(std::vector<Direction> wo,
                                                   const std::vector<RandomWords>& random) const
{
    if (wo.size() == 1) wo.resize(random.size(), wo[0]);
    std::vector<DeviceArgument> arguments = material_arguments({bsdf_}, std::vector<uint>(random.size(), 0), wo);
    append_components(arguments, random);
    const DeviceResults results = functions().evaluate(device_, "sample", arguments, lanes_);
    std::vector<std::vector<float>> out;
    for (const std::size_t k : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 8u}) out.push_back(results.get<float>(k));
    const std::vector<uint> delta = results.get<uint>(7);
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < random.size(); ++i)
        samples.push_back({{out[0][i], out[1][i], out[2][i]},
                           {out[3][i], out[4][i], out[5][i]},
                           out[6][i],
                           delta[i] != 0,
                           out[7][i]});
    return samples;
}

std::vector<std::vector<std::uint32_t>> sample_and_evaluate(const Device& device, const std::vector<BsdfCase>& cases,
                                                            const std::vector<uint>& which,
                                                            const std::vector<Direction>& wo,
                                                            const std::vector<Direction>& wi,
                                                            const std::vector<RandomWords>& random, std::uint32_t lanes)
{
    std::vector<DeviceArgument> sampling = material_arguments(cases, which, wo), evaluation = sampling;
    append_components(sampling, random);
    append_components(evaluation, wi);
    auto outputs = functions().evaluate(device, "sample", sampling, lanes).outputs;
    const auto more = functions().evaluate(device, "evaluate", evaluation, lanes).outputs;
    outputs.insert(outputs.end(), more.begin(), more.end());
    return outputs;
}

void check_weights(const Device& device, const BsdfCase& bsdf)
{
    CAPTURE(bsdf.name);
    const DeviceBsdf on_device(device, bsdf);
    const std::vector<RandomWords> random = random_words(4096, 11);
    std::size_t wrong_pdf = 0, wrong_weight = 0, not_unit = 0, too_much = 0, no_density = 0;
    for (const Direction& wo : standard_directions()) {
        const std::vector<DeviceBsdf::Sample> samples = on_device.sample({wo}, random);
        std::vector<Direction> wi;
        for (const auto& s : samples) wi.push_back(s.wi);
        const DeviceBsdf::Evaluation evaluation = on_device.evaluate({wo}, wi);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double pdf = evaluation.pdf[i], cosine = std::abs(wi[i][2]);
            no_density += !(pdf > 0);
            wrong_pdf += !relatively_equal(samples[i].pdf, pdf, 64 * ROUNDOFF);
            not_unit += std::abs(length(wi[i]) - 1) > 8 * ROUNDOFF;
            for (std::size_t k = 0; k < 3; ++k) {
                const double weight = evaluation.f[i][k] * cosine / pdf;
                wrong_weight += !relatively_equal(samples[i].weight[k], weight, 64 * ROUNDOFF);
                too_much += samples[i].weight[k] < 0 || samples[i].weight[k] > 1 + 64 * ROUNDOFF;
            }
        }
    }
    CHECK(no_density == 0);
    CHECK(wrong_pdf == 0);
    CHECK(wrong_weight == 0);
    CHECK(not_unit == 0);
    CHECK(too_much == 0);
}

// Squares of the random numbers' plane become patches of the sphere: their size is the square's over the density. Asked
// of samples whose direction takes no choice of a lobe.
void check_jacobian(const Device& device, const BsdfCase& bsdf)
{
    CAPTURE(bsdf.name);
    constexpr uint HALF = 1u << 22; // half the side of a square, of 2^32
    constexpr double AREA = 0x1p-18;
    const DeviceBsdf on_device(device, bsdf);
    std::mt19937 generator(3);
    std::size_t wrong = 0, compared = 0;
    for (const Direction& wo : standard_directions()) {
        std::vector<RandomWords> corners;
        for (int i = 0; i < 512; ++i) {
            // Stay away from the border of the plane, where maps may have edges.
            const auto inner = [&] { return (1u << 27) + static_cast<uint>(generator() % ((1u << 31) + (7u << 28))); };
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
            const std::vector<double> patch =
                cross(minus(samples[i + 1].wi, samples[i].wi), minus(samples[i + 3].wi, samples[i + 2].wi));
            const double size = std::hypot(patch[0], patch[1], patch[2]);
            ++compared;
            wrong += !relatively_equal(size * samples[i + 4].pdf, AREA, 0.01);
        }
    }
    CAPTURE(compared);
    CHECK(wrong == 0);
}

void check_reciprocity(const Device& device, const BsdfCase& bsdf)
{
    CAPTURE(bsdf.name);
    const DeviceBsdf on_device(device, bsdf);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<Direction> a, b;
    for (int i = 0; i < 1 << 14; ++i) {
        // Both on one side: the light that passes is scaled by indices of refraction.
        const double side = i % 2 ? 1 : -1;
        a.push_back(direction(side * std::abs(uniform(random)), PI * uniform(random)));
        b.push_back(direction(side * std::abs(uniform(random)), PI * uniform(random)));
    }
    const auto there = on_device.evaluate(a, b).f, back = on_device.evaluate(b, a).f;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) wrong += !relatively_equal(there[i][k], back[i][k], 1e-5);
    CHECK(wrong == 0);
}

void check_pdf_integral(const Device& device, const BsdfCase& bsdf)
{
    CAPTURE(bsdf.name);
    const DeviceBsdf on_device(device, bsdf);
    const std::vector<Direction> grid = sphere_grid(512, 128);
    const std::vector<RandomWords> random = random_words(4096, 13);
    for (const Direction& wo : standard_directions()) {
        double integral = 0;
        for (const float pdf : on_device.evaluate({wo}, grid).pdf) integral += pdf;
        integral *= 4 * PI / static_cast<double>(grid.size());
        // Samples without a direction are what is missing.
        double sampled = 0;
        for (const auto& s : on_device.sample({wo}, random)) sampled += s.pdf > 0;
        sampled /= static_cast<double>(random.size());
        const double allowed = 1e-4 + 4.75 * std::sqrt(sampled * (1 - sampled) / static_cast<double>(random.size()));
        CHECK(std::abs(integral - sampled) <= allowed);
    }
}

void check_distribution(const Device& device, const BsdfCase& bsdf)
{
    constexpr std::size_t ROWS = 16, COLUMNS = 16, FINER = 16;
    const DeviceBsdf on_device(device, bsdf);
    const std::vector<Direction> grid = sphere_grid(ROWS * FINER, COLUMNS * FINER);
    for (const Direction& wo : {direction(0.9, 1), direction(-0.2, 4)}) {
        // Integrate the density over each bin.
        std::vector<double> probabilities(ROWS * COLUMNS);
        const std::vector<float> pdf = on_device.evaluate({wo}, grid).pdf;
        for (std::size_t i = 0; i < grid.size(); ++i) {
            const std::size_t row = i / (COLUMNS * FINER) / FINER, column = i % (COLUMNS * FINER) / FINER;
            probabilities[row * COLUMNS + column] += pdf[i] * 4 * PI / static_cast<double>(grid.size());
        }
        // Count the samples in it.
        Histogram histogram(COLUMNS, ROWS);
        for (const auto& s : on_device.sample({wo}, random_words(1 << 19, 17))) {
            const double turn = std::atan2(s.wi[1], s.wi[0]) / (2 * PI);
            histogram.add(turn - std::floor(turn), std::min(1.0, 0.5 * (1.0 + s.wi[2])));
        }
        check_histogram(fmt::format("{} from cos {:.2g}", bsdf.name, wo[2]), histogram, probabilities);
    }
}

void check_albedo(const Device& device, const BsdfCase& bsdf)
{
    CAPTURE(bsdf.name);
    const DeviceBsdf on_device(device, bsdf);
    const std::vector<Direction> grid = sphere_grid(512, 128);
    const std::vector<RandomWords> random = random_words(1 << 16, 19);
    for (const Direction& wo : standard_directions()) {
        const auto f = on_device.evaluate({wo}, grid).f;
        const auto samples = on_device.sample({wo}, random);
        for (std::size_t k = 0; k < 3; ++k) {
            double integral = 0;
            for (std::size_t i = 0; i < grid.size(); ++i) integral += f[i][k] * std::abs(grid[i][2]);
            integral *= 4 * PI / static_cast<double>(grid.size());
            RunningStatistics sampled;
            for (const auto& s : samples) sampled.add(s.pdf > 0 ? s.weight[k] : 0.0);
            CHECK(integral <= 1 + 1e-4);
            CHECK(std::abs(sampled.mean() - integral) <= 1e-4 + 4.75 * sampled.standard_error());
            // A bias of half a percent would be seen.
            CHECK((4.75 + 2.33) * sampled.standard_error() <= 5e-3 + 5e-3 * integral);
        }
    }
}

void check_edges(const Device& device, const BsdfCase& bsdf)
{
    CAPTURE(bsdf.name);
    const DeviceBsdf on_device(device, bsdf);
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
    std::size_t not_finite = 0, negative = 0, along_the_surface = 0, too_much = 0;
    for (const Direction& wo : directions) {
        for (const auto& s : on_device.sample({wo}, corners)) {
            not_finite += !is_finite(s.wi) || !std::isfinite(s.pdf) || !std::isfinite(s.radiance_scale);
            along_the_surface += wo[2] == 0 && s.pdf != 0;
            negative += s.pdf < 0;
            if (!(s.pdf > 0)) continue;
            for (const float w : s.weight) {
                not_finite += !std::isfinite(w);
                negative += w < 0;
                too_much += w > s.radiance_scale * (1 + 64 * ROUNDOFF);
            }
        }
        const DeviceBsdf::Evaluation evaluation = on_device.evaluate({wo}, directions);
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const auto& f = evaluation.f[i];
            not_finite += !is_finite(f) || !std::isfinite(evaluation.pdf[i]);
            negative += f[0] < 0 || f[1] < 0 || f[2] < 0 || evaluation.pdf[i] < 0;
            along_the_surface += (wo[2] == 0 || directions[i][2] == 0) && evaluation.pdf[i] != 0;
        }
    }
    CHECK(not_finite == 0);
    CHECK(negative == 0);
    CHECK(along_the_surface == 0);
    CHECK(too_much == 0);
}

void check_delta(const Device& device, const BsdfCase& bsdf)
{
    CAPTURE(bsdf.name);
    const DeviceBsdf on_device(device, bsdf);
    // The lobe is chosen evenly, so that a mean over it is an integral.
    constexpr uint LOBES = 4096;
    std::vector<RandomWords> lobes;
    for (uint i = 0; i < LOBES; ++i) lobes.push_back({0, 0, i * (LAST / LOBES + 1) + (LAST / LOBES + 1) / 2, 0});
    std::size_t no_delta = 0, some_value = 0, not_unit = 0, followed_back = 0, no_way_back = 0;
    for (const Direction& wo : standard_directions()) {
        const auto samples = on_device.sample({wo}, lobes);
        double energy[3] = {0, 0, 0};
        std::vector<Direction> wi;
        for (const auto& s : samples) {
            wi.push_back(s.wi);
            no_delta += !s.delta || s.pdf != 1;
            not_unit += std::abs(length(s.wi) - 1) > 16 * ROUNDOFF;
            for (std::size_t k = 0; k < 3; ++k) energy[k] += s.weight[k] / s.radiance_scale / LOBES;
        }
        for (const double e : energy) CHECK(e <= 1 + 64 * ROUNDOFF);
        const DeviceBsdf::Evaluation evaluation = on_device.evaluate({wo}, wi);
        for (std::size_t i = 0; i < wi.size(); ++i)
            some_value += evaluation.pdf[i] != 0 || evaluation.f[i] != std::array<float, 3>{0, 0, 0};

        // One of the lobes from wi leads to wo.
        const auto first = on_device.sample(wi, std::vector<RandomWords>(wi.size(), {0, 0, 0, 0}));
        const auto last = on_device.sample(wi, std::vector<RandomWords>(wi.size(), {0, 0, LAST, 0}));
        for (std::size_t i = 0; i < wi.size(); ++i) {
            // The cosine on the side of the larger index is rounded: its square is out by 2 u, eta^2 times that on the
            // other side. Below some cosine that may turn a ray into the surface.
            const double eta = std::sqrt(std::max(samples[i].radiance_scale, 1 / samples[i].radiance_scale));
            const double cosine = std::min(std::abs(wo[2]), std::abs(wi[i][2]));
            if (cosine * cosine < 1e-6 * eta * eta) continue;
            ++followed_back;
            no_way_back += std::min(length(minus(first[i].wi, wo)), length(minus(last[i].wi, wo))) >
                           2e-7 * eta * eta / cosine + 1e-6;
        }
    }
    CHECK(no_delta == 0);
    CHECK(some_value == 0);
    CHECK(not_unit == 0);
    CHECK(followed_back >= 6 * std::size_t{LOBES});
    CHECK(no_way_back == 0);
}
} // namespace etendue
