// Pictures of what no eye sees: errors with their sign, and p-values. The colours are linear light, as in every Image,
// and come out as meant by writing with the sRGB curve.
#pragma once

#include "image/image.h"
#include "image/welch.h"
#include "math/vector.h"

namespace etendue
{
// The channel of every pixel that is off most: white where equal, to full blue at -scale (the picture is too dark), to
// full red at +scale (too bright). Not finite: yellow. Both have channels R, G, B and the same size; throws UsageError
// otherwise.
Image signed_error_image(const Image& picture, const Image& reference, double scale);

// The least p-value of the three channels, tile by tile at the size of the picture: dark where nothing is odd, light
// towards p = 1e-6 and below. Not tested: grey.
Image p_value_image(const WelchTiles& tiles);

// The colours of both, for scales: of error / scale, and of a p-value.
Vec3 signed_error_color(double ratio);
Vec3 p_value_color(double p);

// "#rrggbb" of linear light.
std::string css_color(const Vec3& linear);
} // namespace etendue
