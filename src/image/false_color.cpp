// Colour maps by way of Oklab, in which equal steps look equal (Ottosson 2020: A perceptual color space for image
// processing).
#include "image/false_color.h"

#include "math/color.h"
#include "util/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr double LEAST_P_EXPONENT = 6.0; // p-values of 10^-6 and less are the lightest
const Vec3 NOT_FINITE(0.9, 0.75, 0.0);
const Vec3 NOT_TESTED(0.2);

struct Lightness {
    double lightness, chroma, hue; // hue in degrees
};

// Oklab to linear sRGB, without clamping.
Vec3 from_oklab(const Lightness& color)
{
    const double angle = color.hue * std::numbers::pi / 180.0;
    const double a = color.chroma * std::cos(angle), b = color.chroma * std::sin(angle);
    const double l = std::pow(color.lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = std::pow(color.lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = std::pow(color.lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    return Vec3(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s);
}

bool is_displayable(const Vec3& c)
{
    return std::min({c.x, c.y, c.z}) >= 0.0 && std::max({c.x, c.y, c.z}) <= 1.0;
}

// The colour with as much of its chroma as a display has.
Vec3 displayable(Lightness color)
{
    double least = 0.0, most = color.chroma;
    if (is_displayable(from_oklab(color))) return from_oklab(color);
    for (int step = 0; step < 24; ++step) {
        color.chroma = 0.5 * (least + most);
        (is_displayable(from_oklab(color)) ? least : most) = color.chroma;
    }
    color.chroma = least;
    return glm::clamp(from_oklab(color), 0.0, 1.0);
}

Vec3 pixel_of(const Image& image, const std::array<std::size_t, 3>& channels, std::size_t pixel)
{
    const float* const values = &image.data[pixel * image.channels.size()];
    return Vec3(values[channels[0]], values[channels[1]], values[channels[2]]);
}

std::array<std::size_t, 3> colours(const Image& image)
{
    return {image.channel("R"), image.channel("G"), image.channel("B")};
}

Image empty_image(int width, int height)
{
    Image image;
    image.width = image.full_width = width;
    image.height = image.full_height = height;
    image.channels = {"R", "G", "B"};
    image.data.reserve(image.pixel_count() * 3);
    return image;
}

void put(Image& image, const Vec3& color)
{
    for (int c = 0; c < 3; ++c) image.data.push_back(static_cast<float>(color[c]));
}

// Of the three numbers, the one that is farthest from zero; NaN if one is.
double farthest(const Vec3& v)
{
    double found = 0.0;
    for (int c = 0; c < 3; ++c) {
        if (std::isnan(v[c])) return v[c];
        if (std::abs(v[c]) > std::abs(found)) found = v[c];
    }
    return found;
}

// Least p-value of a tile; NaN where none of its channels was tested.
double least_p_value(const WelchTiles& tiles, int column, int row)
{
    const auto first = 3 * static_cast<std::size_t>(row * tiles.columns + column);
    double least = tiles.p_values[first];
    for (std::size_t c = 1; c < 3; ++c) least = std::fmin(least, tiles.p_values[first + c]);
    return least;
}
} // namespace

Vec3 signed_error_color(double ratio)
{
    if (!std::isfinite(ratio)) return NOT_FINITE;
    // White to a saturated dark colour; both sides are equally dark at the same distance.
    const double t = std::min(1.0, std::abs(ratio));
    return displayable({1.0 - 0.52 * t, 0.21 * std::pow(t, 0.75), ratio < 0.0 ? 258.0 : 27.0});
}

Vec3 p_value_color(double p)
{
    if (std::isnan(p)) return NOT_TESTED;
    // Lightness is even in log p; the hue turns from blue over red to yellow.
    const double t = std::clamp(-std::log10(p) / LEAST_P_EXPONENT, 0.0, 1.0);
    return displayable({0.18 + 0.77 * t, 0.07 + 0.36 * t * (1.0 - t), 275.0 + 195.0 * t});
}

std::string css_color(const Vec3& linear)
{
    const auto byte = [](double c) {
        return static_cast<int>(std::lround(255.0 * srgb_encode(std::clamp(c, 0.0, 1.0))));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(linear.x), byte(linear.y), byte(linear.z));
}

Image signed_error_image(const Image& picture, const Image& reference, double scale)
{
    if (picture.width != reference.width || picture.height != reference.height)
        throw UsageError(fmt::format("The pictures have different sizes: {}x{} and {}x{} pixels.", picture.width,
                                     picture.height, reference.width, reference.height));
    const auto of_picture = colours(picture), of_reference = colours(reference);
    Image image = empty_image(picture.width, picture.height);
    for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
        const double error = farthest(pixel_of(picture, of_picture, i) - pixel_of(reference, of_reference, i));
        // Of equal pictures the scale may be 0.
        put(image, signed_error_color(error == 0.0 ? 0.0 : error / scale));
    }
    return image;
}

Image p_value_image(const WelchTiles& tiles)
{
    Image image = empty_image(tiles.width, tiles.height);
    for (int y = 0; y < tiles.height; ++y)
        for (int x = 0; x < tiles.width; ++x)
            put(image, p_value_color(least_p_value(tiles, std::min(x / tiles.tile, tiles.columns - 1),
                                                   std::min(y / tiles.tile, tiles.rows - 1))));
    return image;
}
} // namespace etendue
