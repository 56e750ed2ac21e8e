/* 63-bit Morton codes of box centres on a grid of cubic cells (G. Morton 1966; Lauterbach et al. 2009 for its use). */
#pragma once
#include "algorithm/reduce.h"
#include "shared/limits.h"

/* Cells per unit of length: the power of two that spreads the largest extent over 2^(MORTON_BITS - 1) to 2^MORTON_BITS
 * cells; 0 when the extent is 0 (or subnormal). An extent with exponent field e is below 2^(e - 126), so the scale is
 * 2^(MORTON_BITS + 126 - e), whose field is MORTON_BITS + 253 - e. No division: the same on every device. */
STATIC float morton_scale(Aabb centres)
{
    const float4 extent = centres.upper - centres.lower;
    const float largest = max(max(extent.x, extent.y), extent.z);
    const uint exponent = largest > 0.0 ? as_uint(largest) >> 23 : 0u;
    return exponent == 0u ? 0.0 : as_float(min(MORTON_BITS + 253u - exponent, 254u) << 23);
}

/* Insert two zero bits between the lowest MORTON_BITS bits. */
STATIC ulong spread_bits(uint x)
{
    ulong bits = x;
    bits = (bits | bits << 32) & 0x001f00000000fffful;
    bits = (bits | bits << 16) & 0x001f0000ff0000fful;
    bits = (bits | bits << 8) & 0x100f00f00f00f00ful;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3ul;
    bits = (bits | bits << 2) & 0x1249249249249249ul;
    return bits;
}

/* The cell of one coordinate, clamped to the grid. */
STATIC uint morton_cell(float coordinate, float lower, float scale)
{
    const float last = (float)((1u << MORTON_BITS) - 1u);
    return (uint)min((coordinate - lower) * scale, last);
}

/* The code of a box: x in the highest of each three bits, then y, then z; 0 for the box of nothing. */
STATIC ulong morton_code(Aabb box, float4 lower, float scale)
{
    if (box.lower.x > box.upper.x) return 0ul;
    const float4 centre = aabb_centre(box);
    return spread_bits(morton_cell(centre.x, lower.x, scale)) << 2 |
           spread_bits(morton_cell(centre.y, lower.y, scale)) << 1 | spread_bits(morton_cell(centre.z, lower.z, scale));
}
