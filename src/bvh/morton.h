// 63-bit Morton codes of box centres, on the host.
#pragma once

#include "bvh/box.h"

#include <cstdint>
#include <vector>

namespace etendue
{
// Cubic cells over the box around all centres: the power of two that spreads the largest extent over 2^20 to 2^21 cells
// (MORTON_BITS = 21), or 0 when the extent is 0 or subnormal.
struct MortonGrid {
    std::array<float, 3> lower{};
    float scale = 0.0f; // cells per unit of length
};

// The grid for these boxes; boxes of nothing are ignored.
MortonGrid morton_grid(const std::vector<Box>& boxes);

// x in the highest of each three bits, then y, then z; 0 for the box of nothing.
std::uint64_t morton_code(const MortonGrid& grid, const Box& box);
} // namespace etendue
