// Stratified samples: permutations drawn without preference, blocks independent of each other; that each cell is
// filled once is a check (check/sampler_checks).
#include "support/chi_square.h"
#include "support/device_lanes.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <random>
#include <set>

using namespace etendue;

namespace
{
const DeviceFunctions
    functions({"sampling/stratified.h"},
              {
                  // key low, key high, sample high; pixel, sample, dimension
                  {"block", "uint* uint uint uint -> uint uint uint uint",
                   "RandomStream s = {in0[0], in0[1], in0[2], in1, in2, SAMPLER_STRATIFIED, 1u};"
                   "RandomBlock b = stratified_block(s, in3); out0 = b.x; out1 = b.y; out2 = b.z; out3 = b.w;"},
                  {"permute", "uint uint uint -> uint", "stratum_permute(in0, in1, in2)"},
                  {"point", "uint uint -> uint", "stratum_point(in0, in1)"},
              });

using Words = std::vector<std::uint32_t>;
} // namespace

TEST_CASE("the order of the cells is a permutation without preference for any first two of them")
{
    // All 64 places of 64 drawn permutations, and the first two of many.
    constexpr std::uint32_t COUNT = 1 << 19;
    std::mt19937 random(4);
    Words i(COUNT), a(COUNT), b(COUNT);
    for (std::uint32_t k = 0; k < COUNT; ++k) {
        const std::uint32_t group = k < 4096 ? 64 : 2;
        i[k] = k % group;
        a[k] = i[k] == 0 ? static_cast<std::uint32_t>(random()) : a[k - 1];
        b[k] = i[k] == 0 ? static_cast<std::uint32_t>(random()) : b[k - 1];
    }
    for (Device& device : test_devices()) {
        const auto place = functions.evaluate(device, "permute", {i, a, b}).outputs[0];
        for (std::size_t begin = 0; begin < 4096; begin += 64)
            CHECK(std::set<std::uint32_t>(place.begin() + static_cast<std::ptrdiff_t>(begin),
                                          place.begin() + static_cast<std::ptrdiff_t>(begin) + 64)
                      .size() == 64);
        // 64 x 63 ordered pairs are equally likely.
        std::vector<double> pairs(64 * 64);
        std::size_t drawn = 0, same = 0;
        for (std::size_t k = 4096; k + 1 < COUNT; k += 2, ++drawn) {
            same += place[k] == place[k + 1];
            pairs[place[k] * 64 + place[k + 1]] += 1.0;
        }
        std::vector<double> probabilities(64 * 64, 1.0 / (64 * 63));
        for (std::size_t cell = 0; cell < 64; ++cell) probabilities[cell * 65] = 0.0;
        CHECK(same == 0);
        Histogram histogram(64, 64);
        for (std::size_t k = 4096; k + 1 < COUNT; k += 2)
            histogram.add((place[k + 1] + 0.5) / 64.0, (place[k] + 0.5) / 64.0);
        check_histogram("first two cells of a block", histogram, probabilities, 0.07);
        CHECK(histogram.total() == static_cast<double>(drawn));
    }
}

TEST_CASE("jitter fills a cell up to its last bit")
{
    const Words stratum{0, 0, 7, 7, 3}, jitter{0, 0xffffffffu, 0, 0xffffffffu, 8};
    const Words expected{0, 0x1fffffffu, 0xe0000000u, 0xffffffffu, 0x60000001u};
    for (Device& device : test_devices())
        CHECK(evaluate_in_all_lanes(functions, device, "point", {stratum, jitter}).outputs[0] == expected);
}
