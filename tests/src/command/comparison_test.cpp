// The judgement of two pictures: which variance, which verdict, and what is refused.
#include "command/comparison.h"

#include "command/comparison_report.h"
#include "support/compared_pictures.h"
#include "util/error.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace etendue;
using Catch::Contains;

TEST_CASE("two renderings of the same light do not differ", "[command][compare]")
{
    const Image a = noisy_picture(1), b = noisy_picture(2);
    const Comparison c = compare_images(a, b, {});
    CHECK(c.passed());
    CHECK_FALSE(c.identical);
    CHECK(c.variance == VarianceSource::standard_errors);
    CHECK(c.remarks.empty());
    CHECK(c.tiles.tests == 6 * 4 * 3);
    // Noise of 5 % in 48x32 pixels is 0.13 % of the mean; a bias of six such errors of a difference is seen for sure.
    CHECK(c.detectable_bias() == Approx(6.3 * 0.05 * std::sqrt(2.0) / std::sqrt(48.0 * 32.0)).epsilon(0.15));
    CHECK(c.detectable_in_tile() > 4 * c.detectable_bias());
}

TEST_CASE("a bias is found with standard errors and without", "[command][compare]")
{
    Image a = noisy_picture(1);
    const Image b = noisy_picture(2);
    brighten(a, {8, 8, 8, 8}, 1.1f);
    for (const VarianceSource source : {VarianceSource::standard_errors, VarianceSource::differences}) {
        const Comparison c = compare_images(a, b, {source, 8, 1e-3});
        CHECK_FALSE(c.passed());
        CHECK(c.variance == source);
        REQUIRE(c.failures.size() >= 1);
        CHECK_THAT(c.failures[0], Contains("tile at 8,8"));
    }
    // Spread over the picture it hides from the tiles, not from their sum.
    Image everywhere = noisy_picture(3);
    brighten(everywhere, {0, 0, 48, 32}, 1.012f);
    const Comparison c = compare_images(everywhere, b, {});
    CHECK(c.tiles.below_alpha == 0);
    CHECK(c.whole.below_alpha > 0);
    CHECK_FALSE(c.passed());
}

TEST_CASE("the level decides", "[command][compare]")
{
    Image a = noisy_picture(1);
    brighten(a, {8, 8, 8, 8}, 1.04f);
    const Image b = noisy_picture(2);
    CHECK_FALSE(compare_images(a, b, {VarianceSource::automatic, 8, 0.2}).passed());
    CHECK(compare_images(a, b, {VarianceSource::automatic, 8, 1e-9}).passed());
}

TEST_CASE("equal pictures are equal, and pictures that share their noise are remarked on", "[command][compare]")
{
    const Image a = noisy_picture(1);
    const Comparison same = compare_images(a, a, {});
    CHECK(same.passed());
    CHECK(same.identical);
    CHECK(same.remarks.empty());

    Image nearly = a;
    nearly.data[0] += 0.01f;
    const Comparison c = compare_images(nearly, a, {});
    CHECK(c.passed());
    CHECK_FALSE(c.identical);
    REQUIRE(c.remarks.size() == 1);
    CHECK_THAT(c.remarks[0], Contains("share random numbers"));
}

TEST_CASE("without usable standard errors the differences are used, and it is said why", "[command][compare]")
{
    const Image a = noisy_picture(1), b = noisy_picture(2);
    const Image plain = without_errors(b);
    Image infinite = b;
    infinite.data[infinite.channel("stderr.G")] = std::numeric_limits<float>::infinity();

    const Comparison missing = compare_images(a, plain, {});
    CHECK(missing.variance == VarianceSource::differences);
    CHECK_THAT(missing.variance_reason, Contains("B has no channel stderr.R"));
    CHECK(missing.passed());
    CHECK_THAT(compare_images(infinite, b, {}).variance_reason, Contains("A has a standard error of inf at pixel 0,0"));
    CHECK_THAT(compare_images(a, b, {VarianceSource::differences, 8, 1e-3}).variance_reason, Contains("asked for"));
    CHECK_THROWS_WITH(compare_images(a, plain, {VarianceSource::standard_errors, 8, 1e-3}),
                      Contains("B has no channel stderr.R"));
}

TEST_CASE("one pixel that is not finite fails a picture, of either", "[command][compare]")
{
    const Image good = noisy_picture(1);
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Image bad = good;
        bad.data[bad.channel("B")] = value;
        for (const Comparison& c : {compare_images(bad, good, {}), compare_images(good, bad, {})}) {
            REQUIRE(c.failures.size() >= 1);
            CHECK(c.metrics.non_finite == 1);
            CHECK_THAT(c.failures[0], Contains("1 pixel is not finite"));
            CHECK(c.tiles.untested >= 1);
        }
    }
}

TEST_CASE("pixels below zero are remarked on", "[command][compare]")
{
    Image a = without_errors(noisy_picture(1));
    a.data[0] = -0.5f;
    const Comparison c = compare_images(a, without_errors(noisy_picture(2)), {});
    CHECK(c.metrics.negative == 1);
    REQUIRE(c.remarks.size() >= 1);
    CHECK_THAT(c.remarks[0], Contains("1 pixel of A is below 0"));
}

TEST_CASE("pictures of other sizes or places are refused, with both named", "[command][compare]")
{
    const Image a = noisy_picture(1);
    Image moved = a, small = a;
    moved.x = 3;
    moved.y = 7;
    small.width = 24;
    small.data.resize(small.data.size() / 2);
    CHECK_THROWS_WITH(compare_images(a, small, {}), Contains("48x32") && Contains("24x32"));
    CHECK_THROWS_WITH(compare_images(a, moved, {}), Contains("0,0") && Contains("3,7"));
    CHECK_THROWS_AS(compare_images(a, moved, {}), UsageError);
}

TEST_CASE("where nothing can be tested, nothing is said", "[command][compare]")
{
    Image a = without_errors(noisy_picture(1));
    a.width = a.height = 1;
    a.data.resize(3);
    Image b = a;
    b.data[0] += 0.1f;
    CHECK_THROWS_WITH(compare_images(a, b, {}), Contains("Nothing can be tested"));
}

TEST_CASE("degrees of freedom follow how the standard error came about", "[command][compare]")
{
    using Metadata = std::map<std::string, std::string>;
    const auto degrees = [](const std::string& estimate) {
        return degrees_of_freedom(64, Metadata{{"etendue:error_estimate", estimate}});
    };
    CHECK(degrees_of_freedom(64, {}) == 63);
    CHECK(degrees("independent samples") == 63);
    CHECK(degrees("two halves") == 1);
    CHECK(degrees("16 independent blocks") == 15);
    CHECK(degrees("independent blocks") == 1);
}

TEST_CASE("the scale of errors is a round number above nearly all of them", "[command][compare]")
{
    const Image a = without_errors(noisy_picture(1));
    Image b = a;
    CHECK(error_scale(a, b) == 1.0);
    b.data[5] += 3e-7f;
    CHECK(error_scale(a, b) == Approx(5e-7));
    for (float& value : b.data) value += 0.0013f;
    CHECK(error_scale(a, b) == Approx(2e-3));
}
