// Tone mapping works in double: the rounding to 8 bits is the only one.
#include "image/tone_map.h"

#include <cmath>

namespace etendue
{
DisplayImage tone_map_image(const Image& image, ToneMap tone_map, double exposure_stops)
{
    const std::size_t channels[] = {image.channel("R"), image.channel("G"), image.channel("B")};
    const double exposure = std::exp2(exposure_stops);
    DisplayImage display;
    display.rgb.reserve(image.pixel_count() * 3);
    for (std::size_t pixel = 0; pixel < image.pixel_count(); ++pixel) {
        for (const std::size_t channel : channels) {
            const float radiance = image.data[pixel * image.channels.size() + channel];
            const bool finite = std::isfinite(radiance);
            if (!finite) ++display.non_finite_values;
            const double shown = finite ? apply_tone_map(tone_map, static_cast<double>(radiance) * exposure) : 0.0;
            display.rgb.push_back(static_cast<std::uint8_t>(std::lround(shown * 255.0)));
        }
    }
    return display;
}
} // namespace etendue
