// From radiance to the 8 bits of a display.
#pragma once

#include "image/image.h"
#include "math/color.h"

#include <cstdint>
#include <vector>

namespace etendue
{
struct DisplayImage {
    std::vector<std::uint8_t> rgb;       // interleaved, row by row from the top
    std::uint64_t non_finite_values = 0; // of R, G and B; they are shown as 0
};

// Scale R, G and B by 2^exposure_stops, apply the curve, clamp, round to the nearest of 0..255. Throws UsageError when
// the image has no R, G, B.
DisplayImage tone_map_image(const Image& image, ToneMap tone_map, double exposure_stops);
} // namespace etendue
