// Random numbers by position: known answers, an independent generator, counters that never meet; that
// streams are independent is a check (check/sampling_checks).
#include "check/philox_reference.h"
#include "support/device_lanes.h"

#include <catch2/catch.hpp>

#include <random>
#include <set>

using namespace etendue;

namespace
{
const DeviceFunctions functions(
    {"sampling/random.h"},
    {
        {"philox", "uint* uint uint uint uint -> uint uint uint uint",
         "RandomBlock b = philox(in1, in2, in3, in4, in0[0], in0[1]); out0 = b.x; out1 = b.y; out2 = b.z; out3 = b.w;"},
        // key low, key high, sample high; pixel, sample, dimension
        {"block", "uint* uint uint uint -> uint uint uint uint",
         "RandomStream s = {in0[0], in0[1], in0[2], in1, in2}; RandomBlock b = random_block(s, in3);"
         "out0 = b.x; out1 = b.y; out2 = b.z; out3 = b.w;"},
        {"convert", "uint uint -> float mask", "out0 = uniform_float(in0); out1 = below_threshold(in0, in1);"},
    });

using Words = std::vector<std::uint32_t>;
using Block = PhiloxBlock;

Block element(const DeviceResults& out, std::size_t i)
{
    return {out.outputs[0][i], out.outputs[1][i], out.outputs[2][i], out.outputs[3][i]};
}

double unit(std::uint32_t bits)
{
    return bits * 0x1p-32;
}
} // namespace

TEST_CASE("Philox gives the known answers of its authors")
{
    struct KnownAnswer {
        Words key;
        Block counter, answer;
    };
    const std::uint32_t ones = 0xffffffffu;
    const KnownAnswer known[] = {
        {{0, 0}, {0, 0, 0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
        {{ones, ones}, {ones, ones, ones, ones}, {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
        {{0xa4093822, 0x299f31d0},
         {0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
         {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
    };
    for (Device& device : test_devices())
        for (const auto& [key, c, answer] : known)
            CHECK(element(evaluate_in_all_lanes(functions, device, "philox",
                                                {key, Words{c[0]}, Words{c[1]}, Words{c[2]}, Words{c[3]}}),
                          0) == answer);
}

TEST_CASE("Philox agrees with its definition for random counters and keys")
{
    std::mt19937 random(1);
    for (Device& device : test_devices())
        for (int run = 0; run < 4; ++run) {
            const Words key{static_cast<std::uint32_t>(random()), static_cast<std::uint32_t>(random())};
            std::vector<Words> c(4, Words(4096));
            for (Words& words : c)
                for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(random());
            const DeviceResults out = evaluate_in_all_lanes(functions, device, "philox", {key, c[0], c[1], c[2], c[3]});
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < 4096; ++i)
                wrong += element(out, i) != reference_philox({c[0][i], c[1][i], c[2][i], c[3][i]}, key[0], key[1]);
            CHECK(wrong == 0);
        }
}

TEST_CASE("pixel, sample and dimension each have their own word of the counter, and no two positions share a block")
{
    for (Device& device : test_devices()) {
        // Every combination of small and huge pixels, samples across 2^32, and dimensions beyond 1024.
        std::set<Block> blocks;
        std::size_t positions = 0;
        for (const std::uint32_t sample_high : {0u, 1u, 7u})
            for (const std::uint32_t seed : {5u, 6u}) {
                Words pixel, sample, dimension;
                for (const std::uint32_t p : {0u, 1u, 2u, 16384u * 16384u - 1u, 0xffffffffu})
                    for (const std::uint32_t s : {0u, 1u, 2u, 3u, 63u, 64u, 0xfffffff8u, 0xffffffffu})
                        for (const std::uint32_t d : {0u, 1u, 2u, 3u, 1024u, 1025u, 65536u, 131073u}) {
                            pixel.push_back(p);
                            sample.push_back(s);
                            dimension.push_back(d);
                        }
                const Words stream{seed, 0x80000000u, sample_high};
                const DeviceResults out =
                    evaluate_in_all_lanes(functions, device, "block", {stream, pixel, sample, dimension});
                for (std::size_t i = 0; i < pixel.size(); ++i) {
                    blocks.insert(element(out, i));
                    CHECK(element(out, i) ==
                          reference_philox({pixel[i], sample[i], dimension[i], sample_high}, seed, 0x80000000u));
                }
                positions += pixel.size();
            }
        CHECK(blocks.size() == positions);
    }
}

TEST_CASE("bits become numbers of [0, 1) and choices, exactly")
{
    Words bits{0, 255, 256, 0xffffff00u, 0xffffff80u, 0xffffffffu, 0x80000000u, 0x7fffffffu};
    Words threshold{0, 255, 257, 0xffffff00u, 0xffffffffu, 0xffffffffu, 0x80000001u, 0x7fffffffu};
    std::mt19937 random(2);
    while (bits.size() < 65536) {
        bits.push_back(static_cast<std::uint32_t>(random()));
        threshold.push_back(bits.back() + static_cast<std::uint32_t>(random() % 3) - 1u);
    }
    for (Device& device : test_devices()) {
        const DeviceResults out = evaluate_in_all_lanes(functions, device, "convert", {bits, threshold});
        const auto u = out.get<float>(0);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < bits.size(); ++i)
            wrong += u[i] != std::floor(unit(bits[i]) * 0x1p24) * 0x1p-24 || !(u[i] >= 0.0f && u[i] < 1.0f) ||
                     out.outputs[1][i] != (bits[i] < threshold[i]);
        CHECK(wrong == 0);
        CHECK(u[5] == 1.0f - 0x1p-24f);
    }
}
