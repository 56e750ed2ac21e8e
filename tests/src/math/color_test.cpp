// Display curves against the standard's own numbers.
#include "math/color.h"

#include <catch2/catch.hpp>

using namespace etendue;

TEST_CASE("the sRGB curve and its inverse agree, and meet where their pieces do")
{
    for (int i = 0; i <= 1000; ++i) {
        const double linear = i / 1000.0;
        CHECK(srgb_decode(srgb_encode(linear)) == Approx(linear).margin(1e-8));
    }
    CHECK(srgb_encode(0.0031308) == Approx(srgb_encode(0.0031309)).epsilon(1e-4));
    CHECK(srgb_decode(128.0 / 255.0) == Approx(0.21586050).epsilon(1e-7));
    CHECK(srgb_encode(1.0) == Approx(1.0).epsilon(1e-15));
}

TEST_CASE("luminance weighs the primaries of sRGB, and white is one")
{
    CHECK(luminance(Vec3(1.0)) == Approx(1.0).epsilon(1e-15));
    CHECK(luminance({0, 1, 0}) > luminance({1, 0, 0}));
    CHECK(luminance({1, 0, 0}) > luminance({0, 0, 1}));
}
