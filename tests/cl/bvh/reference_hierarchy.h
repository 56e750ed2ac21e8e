// The radix tree over sorted codes as a recursion that looks at one bit after the other, and its arrays as kernels get
// them.
#pragma once

#include "math/shared.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace etendue
{
struct ReferenceHierarchy {
    std::vector<cl_ulong> codes;
    std::vector<cl_uint2> children, ranges; // of the inner nodes
    std::vector<cl_uint> parents;           // of the inner nodes, then of the sorted positions

    uint count() const { return static_cast<uint>(codes.size()); }

    explicit ReferenceHierarchy(std::vector<cl_ulong> sorted_codes)
        : codes(std::move(sorted_codes)), children(count() - 1), ranges(count() - 1), parents(2 * codes.size() - 1)
    {
        build(0, count() - 1, NO_INDEX, true);
    }

private:
    // Bits 63..0 of the code, then 31..0 of the position.
    bool bit(uint position, int i) const { return i >= 32 ? codes[position] >> (i - 32) & 1 : position >> i & 1; }

    // Returns the child reference of the range.
    uint build(uint first, uint last, uint parent, bool is_first_child)
    {
        if (first == last) {
            parents[count() - 1 + first] = parent;
            return LEAF_BIT | first;
        }
        int i = 95;
        while (bit(first, i) == bit(last, i)) --i;
        uint split = first;
        while (!bit(split + 1, i)) ++split;

        // A first child is numbered by its last position, a second by its first; the root is 0.
        const uint node = parent == NO_INDEX ? 0 : is_first_child ? last : first;
        parents[node] = parent;
        ranges[node] = {{first, last}};
        const uint a = build(first, split, node, true), b = build(split + 1, last, node, false);
        children[node] = {{a, b}};
        return node;
    }
};

// Sorted codes of many kinds: spread, repeated, all equal, one bit each, close together.
inline std::vector<std::vector<cl_ulong>> code_sets()
{
    std::mt19937_64 random(9);
    std::vector<std::vector<cl_ulong>> sets;
    const auto add = [&](std::size_t count, auto make) {
        std::vector<cl_ulong> codes(count);
        for (std::size_t i = 0; i < count; ++i) codes[i] = make(i);
        std::ranges::sort(codes);
        sets.push_back(std::move(codes));
    };
    for (const std::size_t count : {2, 3, 4, 5, 63, 64, 65, 1000, 5000}) {
        add(count, [&](std::size_t) { return random() >> 1; });
        add(count, [&](std::size_t) { return random() % 7; });
        add(count, [](std::size_t) { return cl_ulong{0x7fffffffffffffff}; });
        add(count, [](std::size_t i) { return cl_ulong{i} * i; });
    }
    add(64, [](std::size_t i) { return i < 63 ? cl_ulong{1} << i : 0; });
    add(1000, [](std::size_t i) { return i < 63 ? cl_ulong{1} << i : 0; });
    return sets;
}
} // namespace etendue
