// Owen-scrambled Sobol points against direction numbers, and the statistics that scrambling promises; that they are
// nets is a check (check/sampler_checks).
#include "check/sampling_checks.h"
#include "support/device_lanes.h"
#include "util/statistics.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

using namespace etendue;

namespace
{
const DeviceFunctions
    functions({"sampling/sobol.h"},
              {
                  // key low, key high, sample high, replicates; pixel, sample, dimension
                  {"block", "uint* uint uint uint -> uint uint uint uint",
                   "RandomStream s = {in0[0], in0[1], in0[2], in1, in2, SAMPLER_SOBOL, in0[3]};"
                   "RandomBlock b = sobol_block(s, in3); out0 = b.x; out1 = b.y; out2 = b.z; out3 = b.w;"},
                  {"place", "uint* uint -> uint uint uint",
                   "RandomStream s = {0u, 0u, in0[0], (Uint)(0u), in1, SAMPLER_SOBOL, in0[1]};"
                   "SobolPlace p = sobol_place(s); out0 = p.replicate; out1 = p.index; out2 = (Uint)(p.index_high);"},
                  {"reverse", "uint -> uint", "reverse_bits(in0)"},
                  {"second", "uint -> uint", "reverse_bits(sobol_second_reversed(in0))"},
                  {"scramble", "uint uint uint -> uint", "scramble_reversed(in0, in1, in2)"},
              });

using Words = std::vector<std::uint32_t>;

std::uint32_t reversed(std::uint32_t x)
{
    std::uint32_t result = 0;
    for (int bit = 0; bit < 32; ++bit) result |= (x >> bit & 1u) << (31 - bit);
    return result;
}

// The second Sobol dimension by its direction numbers: primitive polynomial x + 1, so that v_1 = 1/2 and
// v_(i+1) = v_i xor v_i / 2 (Bratley and Fox 1988).
std::uint32_t sobol_by_direction_numbers(std::uint32_t index)
{
    std::uint32_t x = 0, direction = 0x80000000u;
    for (; index != 0; index >>= 1) {
        if (index & 1u) x ^= direction;
        direction ^= direction >> 1;
    }
    return x;
}

double unit(std::uint32_t bits)
{
    return bits * 0x1p-32;
}
} // namespace

TEST_CASE("the second Sobol dimension is that of its direction numbers, and bits are reversed one by one")
{
    Words index(4096);
    std::mt19937 random(1);
    for (std::uint32_t i = 0; i < index.size(); ++i) index[i] = i < 2048 ? i : static_cast<std::uint32_t>(random());
    for (Device& device : test_devices()) {
        const auto second = evaluate_in_all_lanes(functions, device, "second", {index}).outputs[0];
        const auto reverse = evaluate_in_all_lanes(functions, device, "reverse", {index}).outputs[0];
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < index.size(); ++i)
            wrong += second[i] != sobol_by_direction_numbers(index[i]) || reverse[i] != reversed(index[i]);
        CHECK(wrong == 0);
    }
}

TEST_CASE("scrambling changes each digit by the digits before it and no others, and is a permutation")
{
    std::mt19937 random(2);
    Words x(4096), add(4096), multiply(4096), changed(4096);
    std::vector<int> bit(4096);
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = static_cast<std::uint32_t>(random());
        add[i] = static_cast<std::uint32_t>(random());
        multiply[i] = static_cast<std::uint32_t>(random());
        bit[i] = static_cast<int>(random() % 32);
        changed[i] = x[i] ^ 1u << bit[i];
    }
    for (Device& device : test_devices()) {
        const auto here = evaluate_in_all_lanes(functions, device, "scramble", {x, add, multiply}).outputs[0];
        const auto there = functions.evaluate(device, "scramble", {changed, add, multiply}).outputs[0];
        // The lowest bit that differs is the one changed: digits before it stay, it is turned, later ones may turn.
        std::size_t wrong = 0;
        std::array<double, 32> turned{}, seen{};
        for (std::size_t i = 0; i < x.size(); ++i) {
            const std::uint32_t difference = here[i] ^ there[i];
            wrong += (difference & ((2u << bit[i]) - 1u)) != 1u << bit[i];
            for (int later = bit[i] + 1; later < 32; ++later) {
                turned[static_cast<std::size_t>(later - bit[i])] += difference >> later & 1u;
                seen[static_cast<std::size_t>(later - bit[i])] += 1.0;
            }
        }
        CHECK(wrong == 0);
        // Later digits turn as often as not: five standard deviations of so many throws of a coin.
        for (std::size_t distance = 1; distance < 24; ++distance) {
            INFO("digits at distance " << distance);
            CHECK(std::abs(turned[distance] - 0.5 * seen[distance]) <
                  5.0 * 0.5 * std::sqrt(seen[distance]) + 0.03 * seen[distance]);
        }
    }
}

TEST_CASE("replicates take turns block by block and none repeats a place")
{
    Words sample;
    for (std::uint32_t s = 0; s < 1024; ++s) sample.insert(sample.end(), {s, 0x80000000u + s, 0xffffffffu - s});
    for (Device& device : test_devices())
        for (const std::uint32_t replicates : {1u, 2u}) {
            std::set<std::array<std::uint32_t, 3>> places;
            for (const std::uint32_t high : {0u, 1u, 2u, 3u, 0xffffffffu}) {
                const auto out =
                    evaluate_in_all_lanes(functions, device, "place", {Words{high, replicates}, sample}).outputs;
                std::size_t wrong = 0;
                for (std::size_t i = 0; i < sample.size(); ++i) {
                    const std::uint64_t number = std::uint64_t{high} << 32 | sample[i],
                                        block = number / SAMPLES_PER_BLOCK;
                    const std::uint64_t index = block / replicates * SAMPLES_PER_BLOCK + number % SAMPLES_PER_BLOCK;
                    wrong += out[0][i] != block % replicates || out[1][i] != static_cast<std::uint32_t>(index) ||
                             out[2][i] != static_cast<std::uint32_t>(index >> 32);
                    places.insert({out[0][i], out[1][i], out[2][i]});
                }
                CHECK(wrong == 0);
            }
            CHECK(places.size() == 5 * sample.size());
        }
}

TEST_CASE("the mean of a smooth function is unbiased, and its variance falls as fast as scrambled nets promise")
{
    // f = u v^2 has the mean 1/6. The variance of the mean of n = 2^m points is O(n^-3 log n) (Owen 1997), and that of
    // independent ones is Var f / n = (1/15 - 1/36) / n.
    constexpr std::uint32_t PIXELS = 4096, SAMPLES = 256;
    Words pixel, sample;
    for (std::uint32_t i = 0; i < PIXELS * SAMPLES; ++i) {
        pixel.push_back(i / SAMPLES);
        sample.push_back(i % SAMPLES);
    }
    const Words dimension(pixel.size(), 2);
    for (Device& device : test_devices()) {
        const auto out = functions.evaluate(device, "block", {Words{1, 0, 0, 1}, pixel, sample, dimension}).outputs;
        for (std::size_t pair = 0; pair < 2; ++pair)
            for (const std::uint32_t count : {4u, 16u, 64u, 256u}) {
                RunningStatistics means;
                for (std::uint32_t p = 0; p < PIXELS; ++p) {
                    double sum = 0.0;
                    for (std::uint32_t s = 0; s < count; ++s) {
                        const double u = unit(out[2 * pair][p * SAMPLES + s]);
                        const double v = unit(out[2 * pair + 1][p * SAMPLES + s]);
                        sum += u * v * v;
                    }
                    means.add(sum / count);
                }
                CAPTURE(pair, count, means.variance());
                const double independent = (1.0 / 15 - 1.0 / 36) / count;
                CHECK(means.variance() < independent / count);
                CHECK(means.variance() > 0.0);
                CHECK(std::abs(means.mean() - 1.0 / 6) < 4.5 * means.standard_error());
            }
    }
}

TEST_CASE("sequences of neighbouring pixels, dimensions, seeds, replicates and both points of a block are independent")
{
    // Nets of 4096 points, which would correlate by the order of 1 if two of them shared a shuffle and a scramble. With
    // nested shuffles the variance of a correlation is not 1/n: the first digits of samples 2k and 2k + 1 are opposite
    // in both sequences, so that their products come in equal pairs. They carry 3/4 of the variance of a number, which
    // gives (3/4)^2 2/n; with the digits after them it is 1.55/n.
    constexpr std::uint32_t DRAWS = 4096, STREAMS = 256;
    const Words first = samples_of_replicate(0, 2, DRAWS), second = samples_of_replicate(1, 2, DRAWS);
    for (Device& device : test_devices()) {
        std::vector<std::vector<float>> streams;
        const auto add = [&](const Words& stream, std::uint32_t pixel, std::uint32_t dimension, const Words& samples) {
            const auto out =
                functions.evaluate(device, "block", {stream, Words(DRAWS, pixel), samples, Words(DRAWS, dimension)})
                    .outputs;
            for (const auto& words : out) {
                std::vector<float> values(DRAWS);
                for (std::size_t i = 0; i < DRAWS; ++i)
                    values[i] = static_cast<float>((unit(words[i]) - 0.5) * std::sqrt(12.0));
                streams.push_back(values);
            }
        };
        for (std::uint32_t pixel = 0; pixel < 12; ++pixel)
            for (const std::uint32_t dimension : {0u, 1u, 2u}) add({1, 0, 0, 2}, pixel, dimension, first);
        for (std::uint32_t seed = 2; seed < 14; ++seed) add({seed, 0, 0, 2}, 0, 0, first);
        for (std::uint32_t dimension = 0; dimension < 12; ++dimension) add({1, 0, 0, 2}, 0, dimension, second);
        for (std::uint32_t high = 2; high < 10; high += 2) add({1, 0, high, 2}, 0, 0, first);
        REQUIRE(streams.size() == STREAMS);
        double largest = 0.0, squares = 0.0;
        for (std::size_t i = 0; i < STREAMS; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                float sum = 0.0f;
                for (std::size_t k = 0; k < DRAWS; ++k) sum += streams[i][k] * streams[j][k];
                const double r = static_cast<double>(sum) / DRAWS;
                largest = std::max(largest, std::abs(r));
                squares += r * r;
            }
        const double pairs = STREAMS * (STREAMS - 1.0) / 2.0;
        CAPTURE(largest, squares / pairs * DRAWS);
        CHECK(squares / pairs * DRAWS == Approx(1.55).epsilon(0.05));
        CHECK(largest < 1.2 * std::sqrt(1.55 * 2.0 * std::log(pairs) / DRAWS));
    }
}
