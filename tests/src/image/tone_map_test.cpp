// The 8 bits of known radiances.
#include "image/tone_map.h"
#include "util/error.h"

#include <catch2/catch.hpp>
#include <limits>

using namespace etendue;

namespace
{
int shown(float value, ToneMap tone_map = ToneMap::srgb, double stops = 0.0)
{
    const Image grey{1, 1, 0, 0, 1, 1, {"R", "G", "B"}, {value, value, value}, {}};
    const DisplayImage display = tone_map_image(grey, tone_map, stops);
    REQUIRE(display.rgb.size() == 3);
    CHECK(display.rgb[0] == display.rgb[2]);
    return display.rgb[1];
}
} // namespace

TEST_CASE("sRGB is the exact piecewise curve, rounded to nearest")
{
    CHECK(shown(0.18f) == 118);
    CHECK(shown(0.5f) == 188);
    CHECK(shown(0.0f) == 0);
    CHECK(shown(1.0f) == 255);
    CHECK(shown(0.002f) == 7); // the straight part: 255 * 12.92 * 0.002 = 6.59
    // Either side of the radiance at which 117.5 is crossed: ((117.5/255 + 0.055) / 1.055)^2.4.
    CHECK(shown(0.17951f) == 117);
    CHECK(shown(0.17953f) == 118);
}

TEST_CASE("gamma22 is the course's curve")
{
    CHECK(shown(0.18f, ToneMap::gamma22) == 117); // 255 * 0.18^(1/2.2) = 116.96
    CHECK(shown(0.5f, ToneMap::gamma22) == 186);
    CHECK(shown(0.002f, ToneMap::gamma22) == 15);
}

TEST_CASE("radiance outside 0..1 is clamped, and exposure comes first")
{
    CHECK(shown(-1.0f) == 0);
    CHECK(shown(1e8f) == 255);
    CHECK(shown(1e-8f) == 0);
    CHECK(shown(0.72f, ToneMap::srgb, -2.0) == 118);
    CHECK(shown(0.25f, ToneMap::srgb, 1.0) == 188);
    CHECK(shown(-1.0f, ToneMap::gamma22) == 0);
}

TEST_CASE("values that are not finite are shown as zero and counted")
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const Image image{2, 1, 0, 0, 2, 1, {"A", "B", "G", "R"}, {nan, 0.5f, inf, nan, 1.0f, -inf, 0.18f, 0.5f}, {}};
    const DisplayImage display = tone_map_image(image, ToneMap::srgb, 0.0);
    CHECK(display.rgb == std::vector<std::uint8_t>{0, 0, 188, 188, 118, 0});
    CHECK(display.non_finite_values == 3);
}

TEST_CASE("an image without colours names the channels that it has")
{
    const Image depth{1, 1, 0, 0, 1, 1, {"depth.Z", "samples.Y"}, {1.0f, 1.0f}, {}};
    CHECK_THROWS_AS(tone_map_image(depth, ToneMap::srgb, 0.0), UsageError);
    CHECK_THROWS_WITH(tone_map_image(depth, ToneMap::srgb, 0.0),
                      "The image has no channel \"R\"; there are: depth.Z, samples.Y.");
}
