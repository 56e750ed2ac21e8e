// Pictures as a render writes them, whose noise is known.
#pragma once

#include "image/image.h"

namespace etendue
{
// 48x32 pixels of a gradient with normal noise of 5 % and the channels R, G, B, stderr.R/G/B and samples.Y (64).
Image noisy_picture(unsigned seed);

// R, G and B alone.
Image without_errors(const Image& image);

struct PictureArea {
    int x, y, width, height;
};
// Multiply R, G and B of an area.
void brighten(Image& image, const PictureArea& area, float factor);
} // namespace etendue
