// Random numbers of the kernels against the published answers of Philox.
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace etendue;

namespace
{
using Words = std::vector<std::uint32_t>;

// A key is uniform over the lanes, so it comes as an array.
const DeviceFunctions functions(
    {"sampling/random.h"},
    {
        {"philox", "uint uint uint uint uint* -> uint uint uint uint",
         "RandomBlock b = philox(in0, in1, in2, in3, in4[0], in4[1]); out0 = b.x; out1 = b.y; out2 = b.z; out3 = b.w;"},
        {"stream", "uint uint uint uint* -> uint uint uint uint",
         "RandomStream s; s.pixel = in0; s.sample = in1; s.key_low = in3[0]; s.key_high = in3[1]; s.sample_high = "
         "in3[2]; RandomBlock b = random_block(s, in2); out0 = b.x; out1 = b.y; out2 = b.z; out3 = b.w;"},
        {"uniform", "uint -> float", "uniform_float(in0)"},
        {"below", "uint uint -> mask", "below_threshold(in0, in1)"},
    });

Words block_of(const Device& device, const Words& counter, const Words& key, std::uint32_t lanes)
{
    const DeviceResults out = functions.evaluate(
        device, "philox", {Words{counter[0]}, Words{counter[1]}, Words{counter[2]}, Words{counter[3]}, key}, lanes);
    return {out.outputs[0][0], out.outputs[1][0], out.outputs[2][0], out.outputs[3][0]};
}
} // namespace

TEST_CASE("Philox gives the known answers of its authors at every number of lanes")
{
    const std::uint32_t ones = 0xffffffffu;
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            CHECK(block_of(device, {0, 0, 0, 0}, {0, 0}, lanes) ==
                  Words{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u});
            CHECK(block_of(device, {ones, ones, ones, ones}, {ones, ones}, lanes) ==
                  Words{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu});
            CHECK(block_of(device, {0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, {0xa4093822u, 0x299f31d0u},
                           lanes) == Words{0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u});
        }
}

TEST_CASE("every lane draws the numbers that it would draw alone")
{
    Words c0, c1, c2, c3;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        c0.push_back(i * 2654435761u);
        c1.push_back(i);
        c2.push_back(~i);
        c3.push_back(i * i * 40503u);
    }
    const Words key{17u, 0x80000000u};
    for (Device& device : test_devices()) {
        const auto alone = functions.evaluate(device, "philox", {c0, c1, c2, c3, key}, 1).outputs;
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(functions.evaluate(device, "philox", {c0, c1, c2, c3, key}, lanes).outputs == alone);
    }
}

TEST_CASE("a block is Philox of pixel, sample, dimension and the sample's high word under the seed")
{
    for (Device& device : test_devices()) {
        const auto by_stream =
            functions.evaluate(device, "stream", {Words{11}, Words{22}, Words{33}, Words{55, 66, 44}}).outputs;
        CHECK(by_stream ==
              functions.evaluate(device, "philox", {Words{11}, Words{22}, Words{33}, Words{44}, Words{55, 66}}).outputs);
    }
}

TEST_CASE("a uniform number is the upper 24 bits of its integer, so that it never reaches 1")
{
    const Words bits{0u, 255u, 256u, 0x80000000u, 0xfffffeffu, 0xffffff00u, 0xffffffffu};
    std::vector<float> expected;
    for (const std::uint32_t b : bits) expected.push_back(static_cast<float>(b / 256u) / 16777216.0f);
    REQUIRE(*std::max_element(expected.begin(), expected.end()) < 1.0f);
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(functions.evaluate<float>(device, "uniform", {bits}, lanes) == expected);
}

TEST_CASE("an integer below its threshold is compared without a sign")
{
    const Words bits{0, 0, 5, 6, 0x7fffffffu, 0x80000000u, 0xffffffffu, 0xfffffffeu};
    const Words thresholds{0, 1, 6, 6, 0x80000000u, 0x7fffffffu, 0xffffffffu, 0xffffffffu};
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(functions.evaluate<std::uint32_t>(device, "below", {bits, thresholds}, lanes) ==
                  Words{0, 1, 1, 0, 1, 0, 0, 1});
}
