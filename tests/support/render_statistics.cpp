// Tests of means by their standard errors.
#include "support/render_statistics.h"

#include "util/statistics.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iostream>

namespace etendue
{
namespace
{
// The family of all tests of a run has this level, so that each has |t| < 4.75; on one device there are some 300.
constexpr double FAMILY_LEVEL = 1e-3;
constexpr std::size_t FAMILY_TESTS = 500;
// A bias at the smallest that a test may miss is found with this quantile's probability, 99 %.
constexpr double POWER_QUANTILE = 2.33;
// A mean of which one value brings more has an error that nobody knows.
constexpr double LARGEST_SHARE = 0.05;
// What float arithmetic along a path may add to a mean, in roundings.
constexpr double MEAN_ROUNDINGS = 16.0;

double test_level()
{
    return sidak_alpha(FAMILY_LEVEL, FAMILY_TESTS);
}

double critical_value()
{
    static const double value = normal_quantile(1.0 - test_level() / 2.0);
    return value;
}

// Mean of a rectangle of pixels in one channel, and the variance of that mean.
struct TileMean {
    double mean = 0.0, variance = 0.0;
};
TileMean tile_mean(const Picture& picture, const PixelRect& tile, int channel)
{
    TileMean result;
    const double pixels = tile.width * tile.height;
    for (int y = tile.y; y < tile.y + tile.height; ++y)
        for (int x = tile.x; x < tile.x + tile.width; ++x) {
            const PixelEstimate& pixel = picture.at(x, y);
            result.mean += pixel.mean[channel] / pixels;
            result.variance += pixel.standard_error[channel] * pixel.standard_error[channel] / (pixels * pixels);
        }
    return result;
}

// Two-sided p-values of the differences between tiles; tiles without variance must be equal and have none.
std::vector<double> welch_p_values(const Picture& a, const Picture& b, int tile, int channel)
{
    std::vector<double> values;
    for (int y = 0; y + tile <= a.height; y += tile)
        for (int x = 0; x + tile <= a.width; x += tile) {
            const TileMean first = tile_mean(a, {x, y, tile, tile}, channel);
            const TileMean second = tile_mean(b, {x, y, tile, tile}, channel);
            const double difference = std::abs(first.mean - second.mean);
            const double standard_error = std::sqrt(first.variance + second.variance);
            if (standard_error <= UNIT_ROUNDOFF * first.mean)
                CHECK(difference <= MEAN_ROUNDINGS * UNIT_ROUNDOFF * first.mean);
            else
                values.push_back(2.0 * normal_cdf(-difference / standard_error));
        }
    return values;
}
} // namespace

Estimate estimate_of(const Picture& picture, int channel)
{
    Moments all;
    double count = 0.0, largest = 0.0, squared_errors = 0.0;
    for (const PixelEstimate& pixel : picture.pixels) {
        const double n = static_cast<double>(pixel.samples), error = pixel.standard_error[channel];
        // A single sample says nothing of its pixel's variance.
        const double m2 = pixel.samples < 2 ? 0.0 : error * error * n * (n - 1.0);
        all = merge_moments(all, count, {pixel.mean[channel], m2}, n);
        count += n;
        squared_errors += error * error;
        largest = std::max(largest, pixel.mean[channel]);
    }
    const double pixels = static_cast<double>(picture.pixels.size()), variance = all.m2 / (count - 1.0);
    const double stratified = std::sqrt(squared_errors) / pixels;
    return {all.mean, std::isfinite(stratified) ? stratified : std::sqrt(variance / count), variance,
            all.mean > 0.0 ? largest / (all.mean * pixels) : 0.0};
}

void check_every_pixel(const Picture& picture, const Vec3& expected, double roundings)
{
    double worst = 0.0;
    for (const PixelEstimate& pixel : picture.pixels)
        for (int channel = 0; channel < 3; ++channel) {
            const double error = std::abs(pixel.mean[channel] - expected[channel]);
            worst = std::max(worst, error == 0.0 ? 0.0 : error / (UNIT_ROUNDOFF * expected[channel]));
        }
    CAPTURE(expected.x, expected.y, expected.z);
    CHECK(worst <= roundings);
}

MeanTests::~MeanTests()
{
    std::cout << fmt::format("{}: {} means; a bias of {:.2g} % would have been seen in each.\n", subject_, tests_,
                             100.0 * weakest_);
}

void MeanTests::check_difference(double difference, double standard_error, double expected, double smallest_bias)
{
    const double visible = (critical_value() + POWER_QUANTILE) * standard_error / expected;
    CAPTURE(subject_, expected, difference, standard_error, difference / standard_error);
    INFO("the smallest relative bias that this test would see is " << visible);
    CHECK(std::abs(difference) <=
          critical_value() * standard_error + MEAN_ROUNDINGS * UNIT_ROUNDOFF * std::abs(expected));
    const bool has_power = visible <= smallest_bias;
    CHECK(has_power);
    weakest_ = std::max(weakest_, visible);
    ++tests_;
}

void MeanTests::check(const Estimate& estimate, double expected, double smallest_bias)
{
    check_difference(estimate.mean - expected, estimate.standard_error, expected, smallest_bias);
    CAPTURE(subject_);
    CHECK(estimate.largest <= LARGEST_SHARE);
}

void MeanTests::check(const Picture& picture, const Vec3& expected, double smallest_bias)
{
    for (int channel = 0; channel < 3; ++channel)
        check(estimate_of(picture, channel), expected[channel], smallest_bias);
}

void MeanTests::check_same(const Picture& a, const Picture& b, int tile, double smallest_bias)
{
    REQUIRE(a.width == b.width);
    REQUIRE(a.height == b.height);
    for (int channel = 0; channel < 3; ++channel) {
        const PixelRect whole{0, 0, a.width, a.height};
        const TileMean first = tile_mean(a, whole, channel), second = tile_mean(b, whole, channel);
        check_difference(first.mean - second.mean, std::sqrt(first.variance + second.variance), second.mean,
                         smallest_bias);
        const std::vector<double> p_values = welch_p_values(a, b, tile, channel);
        REQUIRE(p_values.size() >= 16);
        CAPTURE(subject_, channel);
        CHECK(ks_uniform_p_value(p_values) > test_level());
    }
}

Picture as_picture(const Scene& scene, const ReferencePicture& reference, const ReferenceOptions& options)
{
    Picture picture;
    picture.width = scene.film.width;
    picture.height = scene.film.height;
    for (std::size_t i = 0; i < reference.pixels.size(); ++i)
        picture.pixels.push_back({reference.pixels[i], sqrt(reference.pixel_variances[i]), options.batches, 0});
    return picture;
}
} // namespace etendue
