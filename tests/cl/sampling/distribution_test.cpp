// The alias table by exact enumeration: integers in, integers out.
#include "math/shared.h"
#include "support/device_lanes.h"

#include <catch2/catch.hpp>

#include <random>

using namespace etendue;

namespace
{
// alias_shift comes in an array, as it is uniform.
const DeviceFunctions
    functions({"sampling/distribution.h"},
              {{"alias", "AliasBucket* uint* uint uint mask -> uint", "alias_sample(in0, in1[0], in2, in3, in4)"},
               {"remainder", "uint* uint uint -> uint", "alias_remainder(in0[0], in1, in2)"}});

using Words = std::vector<std::uint32_t>;

struct Table {
    std::vector<AliasBucket> buckets;
    std::uint32_t shift; // 32 - log2(number of buckets)
};

// A table whose thresholds are multiples of 2^24, so that 256 values of the top byte enumerate it exactly.
Table random_table(std::uint32_t log2_size, unsigned seed)
{
    std::mt19937 random(seed);
    Table table{{}, 32 - log2_size};
    const std::uint32_t size = 1u << log2_size;
    for (std::uint32_t i = 0; i < size; ++i)
        table.buckets.push_back(
            {static_cast<std::uint32_t>(random() % 256) << 24, static_cast<std::uint32_t>(random() % size)});
    return table;
}
} // namespace

TEST_CASE("every entry is chosen exactly as often as its integers say")
{
    std::mt19937 random(1);
    for (const std::uint32_t log2_size : {0u, 1u, 2u, 5u, 8u}) {
        const Table table = random_table(log2_size, log2_size + 10);
        const std::size_t size = table.buckets.size();
        // Take every bucket and every top byte; the bits below must not matter.
        Words bucket_bits, entry_bits;
        for (std::uint32_t bucket = 0; bucket < size; ++bucket)
            for (std::uint32_t byte = 0; byte < 256; ++byte) {
                const auto low = static_cast<std::uint32_t>(random());
                bucket_bits.push_back(log2_size == 0 ? low
                                                     : bucket << table.shift | (low & ((1u << table.shift) - 1u)));
                entry_bits.push_back(byte << 24 | (static_cast<std::uint32_t>(random()) >> 8));
            }
        std::vector<std::size_t> expected(size);
        for (std::size_t i = 0; i < size; ++i) {
            expected[i] += table.buckets[i].threshold >> 24;
            expected[table.buckets[i].alias] += 256 - (table.buckets[i].threshold >> 24);
        }
        for (Device& device : test_devices()) {
            const auto chosen = evaluate_in_all_lanes(functions, device, "alias",
                                                      {table.buckets, Words{table.shift}, bucket_bits, entry_bits,
                                                       Words(entry_bits.size(), 1u)})
                                    .get<std::uint32_t>(0);
            std::vector<std::size_t> counts(size);
            for (const std::uint32_t entry : chosen) ++counts.at(entry);
            CAPTURE(size);
            CHECK(counts == expected);
        }
    }
}

TEST_CASE("buckets and thresholds begin and end at their exact integers")
{
    // A bucket chosen for bits below 0x80000001 of 2^32, an empty one, a full one, one of a single integer.
    const Table table{{{0x80000001u, 3u}, {0u, 2u}, {0xffffffffu, 2u}, {1u, 0u}}, 30};
    struct Draw {
        std::uint32_t bucket_bits, entry_bits, chosen;
    };
    const Draw draws[] = {
        {0u, 0x80000000u, 0},          {0x3fffffffu, 0x80000001u, 3}, {0x40000000u, 0u, 2},
        {0x7fffffffu, 0xffffffffu, 2}, {0x80000000u, 0xfffffffeu, 2}, {0xbfffffffu, 0xffffffffu, 2},
        {0xc0000000u, 0u, 3},          {0xffffffffu, 1u, 0},          {0x3fffffffu, 0u, 0},
        {0xffffffffu, 0xffffffffu, 0},
    };
    Words bucket_bits, entry_bits, expected;
    for (const Draw& draw : draws) {
        bucket_bits.push_back(draw.bucket_bits);
        entry_bits.push_back(draw.entry_bits);
        expected.push_back(draw.chosen);
    }
    for (Device& device : test_devices())
        CHECK(evaluate_in_all_lanes(
                  functions, device, "alias",
                  {table.buckets, Words{table.shift}, bucket_bits, entry_bits, Words(expected.size(), 1u)})
                  .get<std::uint32_t>(0) == expected);
}

TEST_CASE("lanes that draw nothing leave the draws of the others alone")
{
    const Table table{{{0u, 1u}, {0xffffffffu, 1u}}, 31};
    const Words bucket_bits{0u, 0xffffffffu, 0u, 0u, 0xffffffffu, 0u}, active{1, 0, 1, 0, 1, 0};
    for (Device& device : test_devices()) {
        const auto chosen =
            evaluate_in_all_lanes(functions, device, "alias",
                                  {table.buckets, Words{table.shift}, bucket_bits, Words(6, 5u), active})
                .get<std::uint32_t>(0);
        for (const std::size_t i : {0u, 2u, 4u}) CHECK(chosen[i] == 1);
    }
}

TEST_CASE("what a bucket leaves of its bits is all of them but those it took, with others below")
{
    std::mt19937 random(6);
    Words bits, more;
    for (int i = 0; i < 1000; ++i) {
        bits.push_back(static_cast<std::uint32_t>(random()));
        more.push_back(static_cast<std::uint32_t>(random()));
    }
    for (Device& device : test_devices())
        for (const std::uint32_t log2_size : {0u, 1u, 7u, 20u, 31u}) {
            const auto found =
                evaluate_in_all_lanes(functions, device, "remainder", {Words{32u - log2_size}, bits, more}).outputs[0];
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < bits.size(); ++i) {
                // The 64 bits of both, from the first one that the bucket did not take.
                const std::uint64_t both = std::uint64_t{bits[i]} << 32 | more[i];
                wrong += found[i] != static_cast<std::uint32_t>(both << log2_size >> 32);
            }
            CAPTURE(log2_size);
            CHECK(wrong == 0);
        }
}
