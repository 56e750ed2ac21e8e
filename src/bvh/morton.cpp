// 63-bit Morton codes of box centres, on the host: the same bits as cl/bvh/morton.h.
#include "bvh/morton.h"

#include <algorithm>
#include <cmath>

namespace etendue
{
namespace
{
// Insert two zero bits between the lowest MORTON_BITS bits.
std::uint64_t spread_bits(std::uint64_t x)
{
    x = (x | x << 32) & 0x001f00000000ffffu;
    x = (x | x << 16) & 0x001f0000ff0000ffu;
    x = (x | x << 8) & 0x100f00f00f00f00fu;
    x = (x | x << 4) & 0x10c30c30c30c30c3u;
    x = (x | x << 2) & 0x1249249249249249u;
    return x;
}

std::uint64_t cell(float coordinate, float lower, float scale)
{
    constexpr float LAST = static_cast<float>((1u << MORTON_BITS) - 1u);
    return static_cast<std::uint64_t>(std::min((coordinate - lower) * scale, LAST));
}
} // namespace

MortonGrid morton_grid(const std::vector<Box>& boxes)
{
    Box centres;
    for (const Box& box : boxes)
        if (!box.empty()) centres.extend(Box{box.centre(), box.centre()});
    if (centres.empty()) return {};

    float extent = 0.0f;
    for (std::size_t axis = 0; axis < 3; ++axis) extent = std::max(extent, centres.upper[axis] - centres.lower[axis]);
    if (extent < std::numeric_limits<float>::min()) return {centres.lower, 0.0f};

    // The extent is below 2^(exponent + 1); scales end at 2^127.
    const int exponent = std::isinf(extent) ? 128 : std::ilogb(extent);
    return {centres.lower, std::ldexp(1.0f, std::min(static_cast<int>(MORTON_BITS) - 1 - exponent, 127))};
}

std::uint64_t morton_code(const MortonGrid& grid, const Box& box)
{
    if (box.empty()) return 0;
    const auto centre = box.centre();
    return spread_bits(cell(centre[0], grid.lower[0], grid.scale)) << 2 |
           spread_bits(cell(centre[1], grid.lower[1], grid.scale)) << 1 |
           spread_bits(cell(centre[2], grid.lower[2], grid.scale));
}
} // namespace etendue
