// Colour: linear sRGB primaries everywhere, and the curves between linear light and what a display is sent.
#pragma once

#include "math/vector.h"

#include <algorithm>
#include <cmath>

namespace etendue
{
enum class ToneMap { srgb, gamma22 }; // gamma22: clamp(c^(1/2.2)), the course's

// Relative luminance of linear sRGB (ITU-R BT.709, item 3.2).
inline double luminance(const Vec3& rgb)
{
    return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
}

// Linear light to the sRGB display value and back, both 0..1 for 0..1 (IEC 61966-2-1). Negative values stay linear.
inline double srgb_encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}
inline double srgb_decode(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// Linear light to a display value in 0..1. A NaN stays one.
inline double apply_tone_map(ToneMap tone_map, double linear)
{
    const double light = std::clamp(linear, 0.0, 1.0);
    return tone_map == ToneMap::srgb ? srgb_encode(light) : std::pow(light, 1.0 / 2.2);
}
} // namespace etendue
