// Welch's test on pictures whose distributions are known: no alarm where there is nothing, an alarm where a bias was
// planted.
#include "image/welch.h"

#include "util/statistics.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <fmt/format.h>

using namespace etendue;

namespace
{
constexpr int WIDTH = 96, HEIGHT = 64;

// A rendering of `samples` per pixel, each exponential around a mean that differs between pixels and channels.
std::vector<PixelMoments> rendering(std::mt19937& random, int samples, int width = WIDTH, int height = HEIGHT)
{
    std::exponential_distribution<double> exponential(1.0);
    std::vector<PixelMoments> pixels;
    for (int i = 0; i < width * height; ++i) {
        PixelMoments pixel;
        pixel.degrees = samples - 1;
        for (int c = 0; c < 3; ++c) {
            const double mean = 0.5 + 0.4 * std::sin(0.3 * i + c);
            RunningStatistics statistics;
            for (int s = 0; s < samples; ++s) statistics.add(mean * exponential(random));
            pixel.mean[c] = statistics.mean();
            pixel.variance_of_mean[c] = statistics.variance() / samples;
        }
        pixels.push_back(pixel);
    }
    return pixels;
}

// The same of so many samples that their sum, which has a gamma distribution, is drawn at once.
std::vector<PixelMoments> long_rendering(std::mt19937& random, int samples, int width, int height)
{
    std::gamma_distribution<double> sum(samples);
    std::vector<PixelMoments> pixels;
    for (int i = 0; i < width * height; ++i) {
        PixelMoments pixel;
        pixel.degrees = samples - 1;
        for (int c = 0; c < 3; ++c) {
            const double mean = 0.5 + 0.4 * std::sin(0.3 * i + c);
            pixel.mean[c] = mean * sum(random) / samples;
            pixel.variance_of_mean[c] = mean * mean / samples;
        }
        pixels.push_back(pixel);
    }
    return pixels;
}

std::vector<Vec3> means_of(const std::vector<PixelMoments>& pixels)
{
    std::vector<Vec3> means;
    for (const PixelMoments& pixel : pixels) means.push_back(pixel.mean);
    return means;
}
} // namespace

TEST_CASE("p-values of two renderings of the same light are uniform", "[image][welch]")
{
    std::mt19937 random(11);
    const auto a = rendering(random, 16), b = rendering(random, 16);
    const auto paired = paired_test(means_of(a), means_of(b), WIDTH, HEIGHT, 8);
    for (const WelchTiles& tiles : {welch_test(a, b, WIDTH, HEIGHT, 8), paired}) {
        REQUIRE(tiles.p_values.size() == 12 * 8 * 3);
        CHECK(tiles.tests == 12 * 8 * 3);
        CHECK(tiles.exact == 0);
        CHECK(tiles.untested == 0);
        CHECK(tiles.below_alpha == 0);
        CHECK(tiles.ks_p_value > 0.01);
        CHECK(tiles.excess_p_value > 0.01);
        CHECK(ks_uniform_p_value(tiles.p_values) > 0.01); // the channels are independent here
        CHECK(std::abs(tiles.worst_z) < 4.75);
    }
}

TEST_CASE("a test says there is a difference as often as its level says", "[image][welch]")
{
    // 200 pairs at a level of 5 %: 10 +- 3.1 alarms; 25 are over 4.7 standard deviations away.
    std::mt19937 random(12);
    int alarms = 0, odd = 0;
    for (int run = 0; run < 200; ++run) {
        const auto a = rendering(random, 8, 32, 32), b = rendering(random, 8, 32, 32);
        const WelchTiles tiles = welch_test(a, b, 32, 32, 8, 0.05);
        alarms += tiles.below_alpha > 0 ? 1 : 0;
        odd += tiles.ks_p_value < 0.05 ? 1 : 0;
    }
    CHECK(alarms >= 1);
    CHECK(alarms < 25);
    CHECK(odd < 25);
}

TEST_CASE("a bias of 1 % planted in one tile is found there", "[image][welch]")
{
    std::mt19937 random(13);
    // The error of a tile's mean is about 1.15 / sqrt(16 * 16 * 8192) = 0.08 % of it, that of a difference 0.11 %.
    constexpr int SIDE = 32, TILE = 16, SAMPLES = 8192;
    auto a = long_rendering(random, SAMPLES, SIDE, SIDE);
    const auto b = long_rendering(random, SAMPLES, SIDE, SIDE);
    const WelchTiles without = welch_test(a, b, SIDE, SIDE, TILE);
    for (int y = TILE; y < SIDE; ++y)
        for (int x = 0; x < TILE; ++x) a[static_cast<std::size_t>(y * SIDE + x)].mean.y *= 1.01;
    const WelchTiles with = welch_test(a, b, SIDE, SIDE, TILE);

    const double detectable = without.detectable_difference() / 0.5;
    INFO(fmt::format("detectable bias {:.3f} %, worst z {:.2f} without, {:.2f} with", 100 * detectable, without.worst_z,
                     with.worst_z));
    CHECK(detectable < 0.01);
    CHECK(without.below_alpha == 0);
    CHECK(with.below_alpha == 1);
    CHECK(with.worst == (1 * 2 + 0) * 3 + 1);
    CHECK(with.worst_z > 4);
    CHECK(with.p_values[with.worst] < with.test_alpha);
    // Too dark is as bad, and has the other sign.
    CHECK(welch_test(b, a, SIDE, SIDE, TILE).worst_z == Approx(-with.worst_z).epsilon(1e-6));
}

TEST_CASE("a bias everywhere, too small for any tile, makes too many p-values small", "[image][welch]")
{
    std::mt19937 random(14);
    auto a = rendering(random, 64);
    const auto b = rendering(random, 64);
    for (PixelMoments& pixel : a) pixel.mean *= 1.03;
    const WelchTiles tiles = welch_test(a, b, WIDTH, HEIGHT, 8);
    CHECK(tiles.ks_p_value < 1e-4);
    CHECK(tiles.excess_p_value < 1e-4);
    CHECK(std::abs(welch_test(a, b, WIDTH, HEIGHT, WIDTH).worst_z) > 5);
}

TEST_CASE("skewed noise is not taken for a difference, and does not hide one", "[image][welch]")
{
    // Each pixel is the sum of about 220 rare samples of exponential size; t of one has P(t < -5) = 5e-5.
    constexpr double SEEN = 220.0, SKEWNESS = 0.143;
    constexpr int TILES = 1024;
    std::mt19937 random(11);
    std::poisson_distribution<int> seen(SEEN);
    std::exponential_distribution<double> size(1.0);
    const auto picture = [&](double bias, double skewness) {
        std::vector<PixelMoments> pixels(TILES);
        for (PixelMoments& pixel : pixels) {
            pixel.degrees = 1e6;
            pixel.skewness = skewness;
            for (int c = 0; c < 3; ++c) {
                double sum = 0.0, squares = 0.0;
                for (int k = seen(random); k > 0; --k) {
                    const double x = size(random) / SEEN;
                    sum += x;
                    squares += x * x;
                }
                pixel.mean[c] = sum + bias;
                pixel.variance_of_mean[c] = squares;
            }
        }
        return pixels;
    };
    const std::vector<PixelMoments> truth(TILES, {Vec3(1.0), Vec3(0.0), 0});
    const auto alarms = [&](double bias, double skewness) {
        int count = 0;
        for (int i = 0; i < 50; ++i) {
            const WelchTiles tiles = welch_test(picture(bias, skewness), truth, TILES, 1, 1, 1e-2);
            count += tiles.excess_p_value < 1e-2 || tiles.below_alpha > 0;
        }
        return count;
    };
    // Expected is one.
    CHECK(alarms(0.0, 0.0) > 8);
    CHECK(alarms(0.0, SKEWNESS) <= 4);
    CHECK(alarms(0.5, SKEWNESS) == 50);
    CHECK(alarms(0.5, -SKEWNESS) == 50);
}

TEST_CASE("noise that is too skewed is not tested, and counted", "[image][welch]")
{
    const std::vector<PixelMoments> truth(16, {Vec3(1.0), Vec3(0.0), 0});
    // Of tiles of four pixels a half.
    const std::vector<PixelMoments> pixels(16, {Vec3(9.0), Vec3(0.01), 1000, 0.2});
    const WelchTiles single = welch_test(pixels, truth, 4, 4, 1), quads = welch_test(pixels, truth, 4, 4, 2);
    CHECK(single.too_skewed == 48);
    CHECK(single.untested == 48);
    CHECK(single.tests == 0);
    CHECK(std::isnan(single.p_values[0]));
    CHECK(quads.too_skewed == 0);
    CHECK(quads.tests == 12);
    CHECK(quads.below_alpha == 12);
    // Equal skewness of both cancels.
    CHECK(welch_test(pixels, pixels, 4, 4, 1).too_skewed == 0);
}

TEST_CASE("one test is Welch's by hand", "[image][welch]")
{
    // Two pixels per picture; per channel the difference of means is (0.3 + 0.1) / 2.
    const std::vector<PixelMoments> a{{Vec3(1.3), Vec3(0.01), 9}, {Vec3(2.1), Vec3(0.04), 19}};
    const std::vector<PixelMoments> b{{Vec3(1.0), Vec3(0.02), 4}, {Vec3(2.0), Vec3(0.00), 99}};
    const WelchTiles tiles = welch_test(a, b, 2, 1, 2);
    const double error = std::sqrt(0.07) / 2;
    const double degrees = 0.07 * 0.07 / (0.01 * 0.01 / 9 + 0.04 * 0.04 / 19 + 0.02 * 0.02 / 4);
    REQUIRE(tiles.p_values.size() == 3);
    CHECK(tiles.differences[0] == Approx(0.2));
    CHECK(tiles.standard_errors[1] == Approx(error));
    CHECK(tiles.p_values[2] == Approx(2 * student_t_cdf(-0.2 / error, degrees)).epsilon(1e-4));
    CHECK(normal_cdf(-tiles.z_values[0]) == Approx(tiles.p_values[0] / 2));
    CHECK(std::isnan(tiles.ks_p_value));
}

TEST_CASE("the paired test is Student's by hand", "[image][welch]")
{
    const std::vector<Vec3> a{Vec3(1.0), Vec3(2.0), Vec3(4.0)}, b{Vec3(0.5), Vec3(1.7), Vec3(3.3)};
    const WelchTiles tiles = paired_test(a, b, 3, 1, 3);
    // Differences 0.5, 0.3, 0.7: mean 0.5, standard deviation 0.2.
    const double error = 0.2 / std::sqrt(3.0);
    CHECK(tiles.standard_errors[0] == Approx(error));
    CHECK(tiles.p_values[0] == Approx(2 * student_t_cdf(-0.5 / error, 2)).epsilon(1e-4));
}

TEST_CASE("tiles reach the edges, and none is smaller than it should be", "[image][welch]")
{
    // 21x10 in tiles of 8: two columns of 8 and 13, one row of 10. A difference in the last pixel is in the last tile.
    std::vector<PixelMoments> a(210, {Vec3(1.0), Vec3(1e-4), 10}), b = a;
    a.back().mean.z = 2.0;
    const WelchTiles tiles = welch_test(a, b, 21, 10, 8);
    CHECK(tiles.columns == 2);
    CHECK(tiles.rows == 1);
    CHECK(tiles.worst == 5);
    CHECK(tiles.differences[5] == Approx(1.0 / 130));
    CHECK(tiles.differences[2] == 0.0);
    CHECK(welch_test(a, b, 21, 10, 64).columns == 1);
}

TEST_CASE("without noise, equal or not is a fact, up to the rounding of floats", "[image][welch]")
{
    std::vector<PixelMoments> a(64, {Vec3(0.25), Vec3(0.0), 0}), b = a;
    CHECK(welch_test(a, b, 8, 8, 4).exact == 12);
    CHECK(welch_test(a, b, 8, 8, 4).noisy_p_values().empty());
    CHECK(welch_test(a, b, 8, 8, 4).worst_z == 0.0);
    for (PixelMoments& pixel : a) pixel.mean.x = 0.25 * (1 + 4e-7);
    CHECK(welch_test(a, b, 8, 8, 4).below_alpha == 0);
    for (PixelMoments& pixel : a) pixel.mean.x = 0.25 * (1 + 4e-6);
    const WelchTiles tiles = welch_test(a, b, 8, 8, 4);
    CHECK(tiles.below_alpha == 4);
    CHECK(tiles.worst_z == std::numeric_limits<double>::infinity());
}

TEST_CASE("what is not known or not finite is not tested, and counted", "[image][welch]")
{
    std::mt19937 random(15);
    auto a = rendering(random, 4, 16, 8);
    const auto b = rendering(random, 4, 16, 8);
    a[0].variance_of_mean = Vec3(std::numeric_limits<double>::infinity());
    a[15].mean.y = std::numeric_limits<double>::quiet_NaN();
    const WelchTiles tiles = welch_test(a, b, 16, 8, 8);
    CHECK(tiles.untested == 4);
    CHECK(tiles.tests == 2);
    CHECK(std::isnan(tiles.p_values[0]));
    CHECK(std::isnan(tiles.p_values[4]));
    CHECK(std::isfinite(tiles.p_values[3]));
}

TEST_CASE("pictures of another size than said are refused", "[image][welch]")
{
    const std::vector<PixelMoments> a(6), b(8);
    CHECK_THROWS_AS(welch_test(a, b, 3, 2, 2), std::invalid_argument);
    CHECK_THROWS_AS(welch_test(a, a, 3, 3, 2), std::invalid_argument);
    CHECK_THROWS_AS(welch_test(a, a, 3, 2, 0), std::invalid_argument);
}
