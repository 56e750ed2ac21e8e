// Metrics against closed forms, and their invariances.
#include "image/metrics.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace etendue;

namespace
{
// Pictures of positive noise around a gradient.
std::vector<Vec3> noisy(std::size_t pixels, unsigned seed, double noise)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-noise, noise);
    std::vector<Vec3> values;
    for (std::size_t i = 0; i < pixels; ++i) {
        const double base = 0.2 + 2.0 * static_cast<double>(i) / static_cast<double>(pixels);
        values.emplace_back(base + uniform(random), 0.5 * base + uniform(random), 0.1 + uniform(random));
    }
    return values;
}

std::vector<Vec3> times(std::vector<Vec3> values, double factor)
{
    for (Vec3& value : values) value *= factor;
    return values;
}
} // namespace

TEST_CASE("a constant error has the metrics that can be worked out by hand", "[image][metrics]")
{
    // r = 2 and x = 2.5 everywhere: e = 0.02, r^2 + e^2 = 4.0004.
    const std::vector<Vec3> picture(2000, Vec3(2.5)), reference(2000, Vec3(2.0));
    const Metrics m = compare_pictures(picture, reference);
    CHECK(m.mse == Approx(0.25));
    CHECK(m.relmse == Approx(0.25 / 4.0004));
    CHECK(m.mape == Approx(0.5 / std::sqrt(4.0004)));
    CHECK(m.max_relative == Approx(0.5 / std::sqrt(4.0004)));
    CHECK(m.mean_error == Approx(0.5));
    CHECK(m.psnr == Approx(10.0 * std::log10(4.0 / 0.25)));
    CHECK(m.trimmed_relmse == Approx(0.25 / 4.0004));
    CHECK(m.top_share == Approx(0.001));
    CHECK(m.reference_mean == Approx(2.0));
    CHECK(compare_pictures(reference, picture).mean_error == Approx(-0.5));
}

TEST_CASE("one bad pixel of a thousand carries the error, and trimming takes it away", "[image][metrics]")
{
    // Channels of different values, so that a mix-up of them shows.
    std::vector<Vec3> reference(1000, Vec3(1.0, 2.0, 3.0)), picture = reference;
    for (std::size_t i = 1; i < 1000; ++i) picture[i].y += 0.1;
    picture[0].x += 30.0;
    const Metrics m = compare_pictures(picture, reference);
    const double e2 = 0.02 * 0.02, small = 0.01 * 999;
    CHECK(m.mse == Approx((900.0 + small) / 3000));
    CHECK(m.relmse == Approx((900.0 / (1 + e2) + small / (4 + e2)) / 3000));
    CHECK(m.trimmed_relmse == Approx(0.01 / (4 + e2) * 999 / (3 * 999)));
    CHECK(m.top_share == Approx(900.0 / (900.0 + small)));
    CHECK(m.max_relative == Approx(30.0 / std::sqrt(1 + e2)));

    // Twice the share is two pixels.
    CHECK(compare_pictures(picture, reference, {0.01, 0.002}).top_share == Approx(900.01 / (900.0 + small)));
}

TEST_CASE("relative metrics do not change with the brightness of both pictures", "[image][metrics]")
{
    const std::vector<Vec3> picture = noisy(3000, 1, 0.05), reference = noisy(3000, 2, 0.01);
    const Metrics m = compare_pictures(picture, reference);
    for (const double factor : {1e-8, 1e-3, 1e3, 1e8}) {
        const Metrics scaled = compare_pictures(times(picture, factor), times(reference, factor));
        INFO(factor);
        CHECK(scaled.relmse == Approx(m.relmse).epsilon(1e-10));
        CHECK(scaled.mape == Approx(m.mape).epsilon(1e-10));
        CHECK(scaled.max_relative == Approx(m.max_relative).epsilon(1e-10));
        CHECK(scaled.trimmed_relmse == Approx(m.trimmed_relmse).epsilon(1e-10));
        CHECK(scaled.top_share == Approx(m.top_share).epsilon(1e-10));
        CHECK(scaled.psnr == Approx(m.psnr).epsilon(1e-10));
        CHECK(scaled.mse == Approx(m.mse * factor * factor).epsilon(1e-10));
        CHECK(scaled.mean_error == Approx(m.mean_error * factor).epsilon(1e-10));
    }
}

TEST_CASE("equal pictures have no error, black ones too", "[image][metrics]")
{
    for (const Vec3& value : {Vec3(0.7), Vec3(0.0)}) {
        const std::vector<Vec3> picture(50, value);
        const Metrics m = compare_pictures(picture, picture);
        CHECK(m.mse == 0.0);
        CHECK(m.relmse == 0.0);
        CHECK(m.mape == 0.0);
        CHECK(m.trimmed_relmse == 0.0);
        CHECK(m.top_share == 0.0);
        CHECK(m.psnr == std::numeric_limits<double>::infinity());
    }
    // Against black nothing is small.
    const Metrics m = compare_pictures(std::vector<Vec3>(4, Vec3(1e-9)), std::vector<Vec3>(4, Vec3(0.0)));
    CHECK(m.relmse == std::numeric_limits<double>::infinity());
}

TEST_CASE("pixels that are not finite are counted and left out, those below zero counted", "[image][metrics]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const std::vector<Vec3> reference{Vec3(1.0), Vec3(1.0), Vec3(1.0, inf, 1.0), Vec3(1.0), Vec3(1.0)};
    const std::vector<Vec3> picture{Vec3(1.5), Vec3(1.0, nan, 1.0), Vec3(1.0), Vec3(-inf, 1.0, 1.0), Vec3(-0.5)};
    const Metrics m = compare_pictures(picture, reference);
    CHECK(m.non_finite == 3);
    CHECK(m.negative == 2);
    CHECK(m.mse == Approx((0.25 + 2.25) / 2));
    CHECK(m.mean_error == Approx((0.5 - 1.5) / 2));

    const Metrics none = compare_pictures(std::vector<Vec3>(2, Vec3(nan)), std::vector<Vec3>(2, Vec3(1.0)));
    CHECK(none.non_finite == 2);
    for (const MetricName& name : metric_names()) {
        INFO(name.name);
        CHECK(std::isnan(none.*name.value));
    }
}

TEST_CASE("pictures of different sizes are not compared", "[image][metrics]")
{
    CHECK_THROWS_AS(compare_pictures(std::vector<Vec3>(3), std::vector<Vec3>(4)), std::invalid_argument);
}
