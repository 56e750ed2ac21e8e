// The checks' program, and one function for each line or two of the table.
#include "check/sampling_checks.h"

#include "check/device_functions.h"
#include "check/findings.h"
#include "check/philox_reference.h"
#include "geometry/distribution.h"
#include "math/rounding.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include <fmt/format.h>

namespace etendue
{
namespace
{
using Results = std::vector<CheckResult>;
using Words = std::vector<std::uint32_t>;

// Parameters of the maps that have some: 1 - cos of a cone's half angle, radius and mass of a Gaussian.
constexpr float ONE_MINUS_COS = 1e-4f;
constexpr float GAUSSIAN_RADIUS = 2.0f;

const DeviceFunctions& functions()
{
    static const DeviceFunctions all(
        {"sampling/random.h", "sampling/warp.h", "sampling/distribution.h", "sampling/mis.h", "math/frame.h"},
        {{"philox", "uint* uint uint uint uint -> uint uint uint uint",
          "RandomBlock b = philox(in1, in2, in3, in4, in0[0], in0[1]); out0 = b.x; out1 = b.y; out2 = b.z; out3 = "
          "b.w;"},
         {"block", "uint* uint uint uint -> uint uint uint uint",
          "RandomStream s = {in0[0], in0[1], in0[2], in1, in2}; RandomBlock b = random_block(s, in3);"
          "out0 = b.x; out1 = b.y; out2 = b.z; out3 = b.w;"},
         {"convert", "uint -> float", "uniform_float(in0)"},
         {"warp", "uint* float* float float -> float float float", R"(
    Vec2 p = vec2((Float)(0.0), (Float)(0.0));
    Vec3 w;
    switch (in0[0]) {
    case 0: w = cosine_hemisphere_sample(in2, in3); break;
    case 1: w = uniform_hemisphere_sample(in2, in3); break;
    case 2: w = uniform_sphere_sample(in2, in3); break;
    case 3: w = uniform_cone_sample(in2, in3, (Float)(in1[0])); break;
    case 4: p = uniform_triangle_sample(in2, in3); break;
    case 5: p = uniform_disk_sample(in2, in3); break;
    case 6: p = vec2(tent_sample(in2), tent_sample(in3)); break;
    case 7: p = truncated_gaussian_sample(in2, in3, (Float)(in1[1]), (Float)(in1[2])); break;
    }
    if (in0[0] >= 4) w = vec3(p.x, p.y, (Float)(0.0));
    out0 = w.x; out1 = w.y; out2 = w.z;)"},
         {"alias", "AliasBucket* uint* uint uint -> uint", "alias_sample(in0, in1[0], in2, in3, to_mask(true))"},
         {"mis", "float float -> float", "power_heuristic(in0, in1)"},
         {"frame", "float float float -> float float float float float float float float float",
          "Frame f = make_frame(vec3(in0, in1, in2));"
          "out0 = f.s.x; out1 = f.s.y; out2 = f.s.z; out3 = f.t.x; out4 = f.t.y; out5 = f.t.z;"
          "out6 = f.n.x; out7 = f.n.y; out8 = f.n.z;"}});
    return all;
}

DeviceResults call(const CheckContext& context, const std::string& name, const std::vector<DeviceArgument>& arguments)
{
    return functions().evaluate(*context.device, name, arguments, context.lanes);
}

PhiloxBlock element(const DeviceResults& out, std::size_t i)
{
    return {out.outputs[0][i], out.outputs[1][i], out.outputs[2][i], out.outputs[3][i]};
}

// N1: the known answers of Philox's authors, and its definition for random counters and keys.
Results check_philox(const CheckContext& context)
{
    struct KnownAnswer {
        Words key;
        PhiloxBlock counter, answer;
    };
    const std::uint32_t ones = 0xffffffffu;
    const KnownAnswer known[] = {
        {{0, 0}, {0, 0, 0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
        {{ones, ones}, {ones, ones, ones, ones}, {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
        {{0xa4093822, 0x299f31d0},
         {0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
         {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
    };
    Violations answers;
    for (const auto& [key, c, answer] : known) {
        const DeviceResults out = call(context, "philox", {key, Words{c[0]}, Words{c[1]}, Words{c[2]}, Words{c[3]}});
        answers.expect(element(out, 0) == answer, "known answer");
    }
    std::mt19937_64 random(context.seed + 1);
    for (int run = 0; run < 4; ++run) {
        const Words key{static_cast<std::uint32_t>(random()), static_cast<std::uint32_t>(random())};
        std::vector<Words> c(4, Words(4096));
        for (Words& words : c)
            for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(random());
        const DeviceResults out = call(context, "philox", {key, c[0], c[1], c[2], c[3]});
        for (std::size_t i = 0; i < c[0].size(); ++i)
            answers.expect(element(out, i) == reference_philox({c[0][i], c[1][i], c[2][i], c[3][i]}, key[0], key[1]),
                           "definition");
    }
    return {answers.result("philox", Rule::exact)};
}

constexpr const char* WARPS[] = {
    "cosine hemisphere", "uniform hemisphere", "sphere", "cone", "triangle", "disk", "tent", "gaussian"};

// Finite, and within the shape of the map of that number.
void expect_in_shape(std::uint32_t number, const DeviceResults& out, Violations& violations)
{
    const auto x = out.get<float>(0), y = out.get<float>(1), z = out.get<float>(2);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double r2 = double{x[i]} * x[i] + double{y[i]} * y[i], length = std::sqrt(r2 + double{z[i]} * z[i]);
        violations.expect(std::isfinite(length), "not finite");
        if (number < 4) violations.expect(std::abs(length - 1) < 4e-7, "not of unit length");
        if (number < 2) violations.expect(z[i] >= 0, "below the horizon");
        if (number == 3) violations.expect(z[i] >= 1 - ONE_MINUS_COS * (1 + 1e-3), "out of the cone");
        if (number == 4)
            violations.expect(x[i] >= 0 && y[i] >= 0 && x[i] + y[i] <= 1 + 2 * FLOAT_ROUNDING, "out of the triangle");
        if (number == 5) violations.expect(r2 <= 1 + 8 * FLOAT_ROUNDING, "out of the disk");
        if (number == 6) violations.expect(std::abs(x[i]) <= 1 && std::abs(y[i]) <= 1, "out of the tent");
        if (number == 7)
            violations.expect(std::sqrt(r2) <= GAUSSIAN_RADIUS * (1 + 8 * FLOAT_ROUNDING), "out of the radius");
    }
}

// N2: every map at the ends of the unit square and over it: finite, within its shape.
Results check_warps(const CheckContext& context, const std::string& name, std::uint32_t stride)
{
    const float mass = static_cast<float>(-std::expm1(-0.5 * GAUSSIAN_RADIUS * GAUSSIAN_RADIUS));
    const std::vector<float> parameters{ONE_MINUS_COS, GAUSSIAN_RADIUS, mass};
    // One coordinate goes through the integers, the other stays at an end or in the middle.
    Violations violations;
    for (const std::uint32_t other : {0u, 1u, 1u << 23, (1u << 24) - 1}) {
        std::vector<float> moving{0.0f};
        for (std::uint32_t k = stride; k <= 1u << 24; k += stride)
            moving.push_back(static_cast<float>(k - 1) * 0x1p-24f);
        moving.push_back(static_cast<float>((1u << 24) - 1) * 0x1p-24f);
        const std::vector<float> fixed(moving.size(), static_cast<float>(other) * 0x1p-24f);
        for (std::uint32_t number = 0; number < std::size(WARPS); ++number)
            for (const bool swapped : {false, true}) {
                const DeviceResults out = call(
                    context, "warp", {Words{number}, parameters, swapped ? fixed : moving, swapped ? moving : fixed});
                violations.set_subject(WARPS[number]);
                expect_in_shape(number, out, violations);
            }
    }
    return {violations.result(name, Rule::bound)};
}

// [0, 1) from words: the upper 24 bits, never 1.
Results check_conversion(const CheckContext& context)
{
    Words bits{0, 255, 256, 0xffffff00u, 0xffffff80u, 0xffffffffu, 0x80000000u, 0x7fffffffu};
    std::mt19937_64 random(context.seed + 2);
    while (bits.size() < 1 << 18) bits.push_back(static_cast<std::uint32_t>(random()));
    const auto u = call(context, "convert", {bits}).get<float>(0);
    Violations violations;
    for (std::size_t i = 0; i < bits.size(); ++i)
        violations.expect(u[i] == static_cast<float>(bits[i] >> 8) * 0x1p-24f && u[i] >= 0.0f && u[i] < 1.0f, "number");
    return {violations.result("uniform-number", Rule::exact)};
}

// N3: the correlations of all pairs of many streams, neighbours in pixel, sample, dimension and seed.
Results check_correlations(const CheckContext& context, const std::string& name, std::size_t streams)
{
    constexpr std::size_t DRAWS = 4096, QUARTER = DRAWS / 4;
    std::vector<float> draws(streams * DRAWS);
    for (std::size_t k = 0; k < streams; ++k) {
        // Neighbours in each of the four in turn.
        const auto step = static_cast<std::uint32_t>(k / 4), kind = static_cast<std::uint32_t>(k % 4);
        Words pixel(QUARTER), sample(QUARTER), dimension(QUARTER);
        for (std::uint32_t i = 0; i < QUARTER; ++i) {
            pixel[i] = kind == 0 ? step : 0x01000000u;
            sample[i] = kind == 1 ? step : i;
            dimension[i] = kind == 2 ? step : kind == 1 ? i : 0u;
        }
        const Words stream{static_cast<std::uint32_t>(context.seed) + (kind == 3 ? step : 0u), kind, 0};
        const DeviceResults out = call(context, "block", {stream, pixel, sample, dimension});
        for (std::size_t i = 0; i < DRAWS; ++i)
            draws[k * DRAWS + i] = static_cast<float>(out.outputs[i % 4][i / 4] * 0x1p-32 - 0.5) * std::sqrt(12.0f);
    }
    double worst = 0.0;
    for (std::size_t a = 0; a < streams; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            float sums[8] = {};
            const float *x = &draws[a * DRAWS], *y = &draws[b * DRAWS];
            for (std::size_t i = 0; i < DRAWS; i += 8)
                for (std::size_t j = 0; j < 8; ++j) sums[j] += x[i + j] * y[i + j];
            double r = 0.0;
            for (const float sum : sums) r += sum / DRAWS;
            worst = std::max(worst, std::abs(r));
        }
    // Of n draws a correlation has standard deviation 1 / sqrt(n); this is 1.2 times what the largest of all pairs is.
    const double pairs = static_cast<double>(streams) * static_cast<double>(streams - 1) / 2;
    WorstError correlation;
    correlation.set_subject(fmt::format("{} streams of {} draws", streams, DRAWS));
    correlation.add(worst);
    return {correlation.result(name, 1.2 * std::sqrt(2 * std::log(pairs) / DRAWS), "correlation", Rule::stat)};
}

// N3: pairs of numbers, one of a position and one of its neighbour, are uniform over the square.
constexpr std::size_t NEIGHBOURS = 6;
Results check_neighbours(const CheckContext& context)
{
    constexpr std::size_t BINS = 16;
    const auto count = static_cast<std::uint32_t>((1 << 19) * std::min(context.effort, 256.0));
    Words pixel(count), sample(count), dimension(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        pixel[i] = i % 1024;
        sample[i] = i / 1024 % 256;
        dimension[i] = i / (1024 * 256);
    }
    const auto shifted = [](Words words) {
        for (std::uint32_t& word : words) ++word;
        return words;
    };
    const auto draw = [&](std::uint32_t seed, const Words& p, const Words& s, const Words& d) {
        return call(context, "block", {Words{static_cast<std::uint32_t>(context.seed) + seed, 0, 0}, p, s, d}).outputs;
    };
    const auto here = draw(1, pixel, sample, dimension);
    const std::pair<std::string, Words> neighbours[NEIGHBOURS] = {
        {"pixels", draw(1, shifted(pixel), sample, dimension)[0]},
        {"samples", draw(1, pixel, shifted(sample), dimension)[0]},
        {"dimensions", draw(1, pixel, sample, shifted(dimension))[0]},
        {"seeds", draw(2, pixel, sample, dimension)[0]},
        {"first and second words", here[1]},
        {"first and fourth words", here[3]},
    };
    DistributionTests tests(context);
    for (const auto& [name, there] : neighbours) {
        Histogram pairs(BINS, BINS);
        for (std::size_t i = 0; i < count; ++i) pairs.add(here[0][i] * 0x1p-32, there[i] * 0x1p-32);
        tests.add(name, pairs, std::vector<double>(BINS * BINS, 1.0 / (BINS * BINS)));
    }
    return {tests.result("philox-neighbours")};
}

// N4: no block comes twice: samples across 2^32, pixels up to 2^32, dimensions beyond 1024.
Results check_repeats(const CheckContext& context)
{
    std::set<PhiloxBlock> blocks;
    std::size_t positions = 0;
    for (const std::uint32_t sample_high : {0u, 1u, 7u})
        for (const std::uint32_t seed : {5u, 6u}) {
            Words pixel, sample, dimension;
            for (const std::uint32_t p : {0u, 1u, 2u, 16384u * 16384u - 1u, 0xffffffffu})
                for (std::uint32_t s = 0; s < 24; ++s)
                    for (const std::uint32_t d : {0u, 1u, 2u, 3u, 1024u, 1025u, 65536u, 131073u}) {
                        pixel.push_back(p);
                        sample.push_back(s < 16 ? s : 0xfffffff8u + (s - 16));
                        dimension.push_back(d);
                    }
            const DeviceResults out =
                call(context, "block", {Words{seed, 0x80000000u, sample_high}, pixel, sample, dimension});
            for (std::size_t i = 0; i < pixel.size(); ++i) blocks.insert(element(out, i));
            positions += pixel.size();
        }
    Violations violations;
    violations.add_trials(positions);
    violations.add("blocks that came before", positions - blocks.size());
    return {violations.result("philox-repeats", Rule::exact)};
}

// Alias tables: each bucket's two entries begin and end at their integers, and the integers make the probabilities.
Results check_alias_tables(const CheckContext& context)
{
    std::mt19937_64 random(context.seed + 3);
    std::uniform_real_distribution<double> uniform(0, 1);
    Violations violations;
    for (const std::size_t size : {1u, 2u, 3u, 7u, 64u, 1000u}) {
        std::vector<double> weights;
        for (std::size_t i = 0; i < size; ++i) weights.push_back(std::pow(uniform(random), 8) * (i % 5 ? 1 : 1e-6));
        if (size > 2) weights[1] = 0;
        const AliasTable table = make_alias_table(weights);
        const auto log2_size = static_cast<std::uint32_t>(std::countr_zero(table.buckets.size()));
        const std::uint32_t shift = 32 - log2_size;
        Words bucket_bits, entry_bits, expected;
        std::vector<double> integers(size);
        for (std::uint32_t b = 0; b < table.buckets.size(); ++b) {
            const AliasBucket& bucket = table.buckets[b];
            const std::uint32_t first = log2_size == 0 ? 0 : b << shift,
                                last = first + (log2_size == 0 ? 0xffffffffu : (1u << shift) - 1);
            for (const std::uint32_t bits : {first, last})
                for (const std::uint32_t entry : {0u, bucket.threshold - 1, bucket.threshold, 0xffffffffu}) {
                    bucket_bits.push_back(bits);
                    entry_bits.push_back(entry);
                    expected.push_back(entry < bucket.threshold ? b : bucket.alias);
                }
            if (bucket.threshold > 0) integers.at(b) += bucket.threshold;
            integers.at(bucket.alias) += 0x1p32 - bucket.threshold;
        }
        violations.set_subject(fmt::format("{} weights", size));
        const auto chosen = call(context, "alias", {table.buckets, Words{shift}, bucket_bits, entry_bits}).outputs[0];
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            violations.expect(chosen[i] == expected[i], "choice");
            violations.expect(chosen[i] < size && weights[chosen[i]] > 0, "choice of weight zero");
        }
        for (std::size_t i = 0; i < size; ++i)
            violations.expect(table.probabilities[i] ==
                                  integers[i] * 0x1p-32 / static_cast<double>(table.buckets.size()),
                              "probability");
    }
    return {violations.result("alias-table", Rule::exact)};
}

// Weights of two densities add up to 1 and are finite for densities of any size.
Results check_mis(const CheckContext& context)
{
    std::vector<float> a, b;
    for (int i = -126; i <= 126; i += 3)
        for (int k = -126; k <= 126; k += 3) {
            a.push_back(std::ldexp(1.37f, i));
            b.push_back(std::ldexp(1.11f, k));
        }
    const auto there = call(context, "mis", {a, b}).get<float>(0), back = call(context, "mis", {b, a}).get<float>(0);
    Violations violations;
    for (std::size_t i = 0; i < a.size(); ++i) {
        violations.expect(there[i] >= 0 && there[i] <= 1, "out of [0, 1]");
        violations.expect(std::abs(double{there[i]} + back[i] - 1) <= 4 * FLOAT_ROUNDING, "sum of both");
    }
    return {violations.result("mis-weights", Rule::bound)};
}

// R5: frames are orthonormal and right-handed for normals everywhere, next to the poles, and at them.
Results check_frames(const CheckContext& context)
{
    std::mt19937_64 random(context.seed + 4);
    std::uniform_real_distribution<double> u(0, 1);
    std::vector<float> n[3];
    const auto add = [&](double x, double y, double z) {
        const double length = std::sqrt(x * x + y * y + z * z);
        n[0].push_back(static_cast<float>(x / length));
        n[1].push_back(static_cast<float>(y / length));
        n[2].push_back(static_cast<float>(z / length));
    };
    for (const double pole : {1.0, -1.0}) {
        for (const double zero : {0.0, -0.0}) add(zero, 0.0, pole);
        add(1.0, 0.0, 0.0 * pole);
        add(0.6, -0.8, 0.0 * pole);
    }
    while (n[0].size() < 1 << 20) {
        const double phi = 2 * std::numbers::pi * u(random), near = std::pow(10.0, -3.0 - 6.0 * u(random));
        add(near * std::cos(phi), near * std::sin(phi), n[0].size() % 2 ? 1.0 : -1.0);
        if (n[0].size() % 4 == 0) add(u(random) - 0.5, u(random) - 0.5, u(random) - 0.5);
    }
    const auto out = call(context, "frame", {n[0], n[1], n[2]}).outputs;
    WorstError error, handedness;
    Violations normals;
    for (std::size_t i = 0; i < n[0].size(); ++i) {
        double f[3][3];
        for (std::size_t k = 0; k < 9; ++k) f[k / 3][k % 3] = std::bit_cast<float>(out[k][i]);
        const auto dot = [&](int a, int b) { return f[a][0] * f[b][0] + f[a][1] * f[b][1] + f[a][2] * f[b][2]; };
        error.add(std::max({std::abs(std::sqrt(dot(0, 0)) - 1), std::abs(std::sqrt(dot(1, 1)) - 1), std::abs(dot(0, 1)),
                            std::abs(dot(0, 2)), std::abs(dot(1, 2))}) /
                  FLOAT_ROUNDING);
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3, last = (k + 2) % 3;
            handedness.add(std::abs(f[0][next] * f[1][last] - f[0][last] * f[1][next] - f[2][k]) / FLOAT_ROUNDING);
            normals.expect(out[6 + static_cast<std::size_t>(k)][i] == std::bit_cast<std::uint32_t>(n[k][i]), "normal");
        }
    }
    return {error.result("frames-orthonormal", 4, "u"), handedness.result("frames-handedness", 8, "u"),
            normals.result("frames-normal", Rule::exact)};
}
} // namespace

std::vector<Check> sampling_checks()
{
    const auto check = [](const char* name, auto run, std::size_t statistical_tests = 0, bool is_long = false) {
        return make_check("sampling", name, run, statistical_tests, is_long);
    };
    // The integers of 24 bits in steps; all of them, and all pairs of 4096 streams, take minutes.
    const auto warps = [](const CheckContext& c) { return check_warps(c, "warps", 257); };
    const auto all_warps = [](const CheckContext& c) { return check_warps(c, "warps-everywhere", 1); };
    const auto streams = [](const CheckContext& c) { return check_correlations(c, "philox-correlation", 512); };
    const auto all_streams = [](const CheckContext& c) {
        return check_correlations(c, "philox-correlation-4096", 4096);
    };
    std::vector<Check> checks{check("philox", check_philox),
                              check("uniform-number", check_conversion),
                              check("warps", warps),
                              check("warps-everywhere", all_warps, 0, true),
                              check("philox-correlation", streams, 1),
                              check("philox-correlation-4096", all_streams, 1, true),
                              check("philox-neighbours", check_neighbours, NEIGHBOURS),
                              check("philox-repeats", check_repeats),
                              check("alias-table", check_alias_tables),
                              check("mis-weights", check_mis),
                              check("frames", check_frames)};
    for (Check& sampler : sampler_checks()) checks.push_back(std::move(sampler));
    return checks;
}
} // namespace etendue
