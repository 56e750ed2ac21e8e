// Colour maps: which colours stand for what, and that equal steps look equal.
#include "image/false_color.h"

#include "math/color.h"
#include "util/error.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace etendue;

namespace
{
// CIE L* of linear light: what is seen of a difference in brightness (CIE 015:2018, eq. 8.3).
double lightness(const Vec3& linear)
{
    const double y = luminance(linear);
    return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389.0 / 27;
}

Image grey(int width, int height, float value)
{
    Image image;
    image.width = width;
    image.height = height;
    image.channels = {"R", "G", "B"};
    image.data.assign(image.pixel_count() * 3, value);
    return image;
}

Vec3 pixel(const Image& image, int x, int y)
{
    return Vec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2));
}
} // namespace

TEST_CASE("the signed error is white where equal, red above and blue below", "[image][false_color]")
{
    Image a = grey(5, 1, 1.0f);
    const Image b = a;
    a.data[3] = 1.5f;                                         // brighter in R
    a.data[2 * 3 + 1] = 0.5f;                                 // darker in G
    a.data[3 * 3] = 1.1f, a.data[3 * 3 + 2] = 0.5f;           // more darker than brighter
    a.data[4 * 3] = std::numeric_limits<float>::quiet_NaN();  // not finite
    const Image error = signed_error_image(a, b, 0.5);
    REQUIRE(error.width == 5);
    CHECK(css_color(pixel(error, 0, 0)) == "#ffffff");
    const Vec3 red = pixel(error, 1, 0), blue = pixel(error, 2, 0);
    CHECK((red.x > 3 * red.y && red.x > 3 * red.z));
    CHECK((blue.z > 3 * blue.x && blue.z > 2 * blue.y));
    CHECK(pixel(error, 3, 0) == blue);
    const Vec3 yellow = pixel(error, 4, 0);
    CHECK((yellow.x > 0.5 && yellow.y > 0.5 && yellow.z == 0.0));

    // Equal pictures need no scale, and errors beyond it have the colour at its end.
    CHECK(css_color(pixel(signed_error_image(b, b, 0.0), 0, 0)) == "#ffffff");
    CHECK(pixel(signed_error_image(a, b, 0.01), 1, 0) == red);
    CHECK_THROWS_AS(signed_error_image(a, grey(4, 1, 1.0f), 1.0), UsageError);
}

TEST_CASE("equal errors of either sign are equally dark", "[image][false_color]")
{
    for (const double t : {0.1, 0.3, 0.5, 0.8, 1.0})
        CHECK(std::abs(lightness(signed_error_color(t)) - lightness(signed_error_color(-t))) < 8.0);
}

TEST_CASE("both maps change their lightness evenly and stay displayable", "[image][false_color]")
{
    double last_error = lightness(signed_error_color(0.0)), last_p = lightness(p_value_color(1.0));
    CHECK(last_error == Approx(100.0).margin(0.1));
    for (int i = 1; i <= 20; ++i) {
        const Vec3 error = signed_error_color(i / 20.0), p = p_value_color(std::pow(10.0, -6.0 * i / 20));
        for (const Vec3& color : {error, p}) {
            for (int c = 0; c < 3; ++c) CHECK((color[c] >= 0.0 && color[c] <= 1.0));
        }
        INFO(i);
        CHECK(last_error - lightness(error) > 1.0);
        CHECK(last_error - lightness(error) < 5.0);
        CHECK(lightness(p) - last_p > 2.0);
        CHECK(lightness(p) - last_p < 8.0);
        last_error = lightness(error);
        last_p = lightness(p);
    }
}

TEST_CASE("the p-values of tiles cover the picture, the least of three channels each", "[image][false_color]")
{
    // 5x2 pixels in tiles of 2: the second column is three pixels wide.
    std::vector<PixelMoments> a(10, {Vec3(1.0), Vec3(0.01), 1000}), b = a;
    for (const std::size_t i : {2, 3, 4, 7, 8, 9}) a[i].mean.y = 2.0;
    const Image image = p_value_image(welch_test(a, b, 5, 2, 2));
    REQUIRE(image.width == 5);
    REQUIRE(image.height == 2);
    CHECK(pixel(image, 0, 0) == pixel(image, 1, 1));
    CHECK(pixel(image, 2, 0) == pixel(image, 4, 1));
    CHECK(lightness(pixel(image, 1, 0)) < 15);
    CHECK(lightness(pixel(image, 2, 0)) > 80);

    a[0].variance_of_mean = Vec3(std::numeric_limits<double>::infinity());
    const Vec3 untested = pixel(p_value_image(welch_test(a, b, 5, 2, 2)), 0, 0);
    CHECK(untested.x == untested.y);
    CHECK(untested.x == untested.z);
}
