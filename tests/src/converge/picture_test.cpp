// Pools of pictures against the moments of the distributions that their pixels come from.
#include "converge/picture.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace etendue;

namespace
{
// Pixels that are sums of `shape` exponential values: mean and variance `shape`, skewness 2 / sqrt(shape).
PixelPool gamma_pictures(double shape, int pictures, std::size_t pixels, std::uint64_t seed, double sign = 1.0)
{
    std::mt19937_64 random(seed);
    std::gamma_distribution<double> gamma(shape);
    PixelPool pool;
    for (int k = 0; k < pictures; ++k) {
        Pixels picture;
        for (std::size_t i = 0; i < pixels; ++i) {
            const double x = gamma(random), y = gamma(random), z = gamma(random);
            picture.emplace_back(sign * x, sign * y, sign * z);
        }
        pool.add(picture);
    }
    return pool;
}
} // namespace

TEST_CASE("a pool knows mean, variance and skewness of its pictures", "[converge]")
{
    constexpr double SHAPE = 4.0;
    constexpr int PICTURES = 8;
    constexpr std::size_t PIXELS = 20000;
    for (const double sign : {1.0, -1.0}) {
        const PixelPool pool = gamma_pictures(SHAPE, PICTURES, PIXELS, 5, sign);
        CHECK(pool.count() == PICTURES);
        CHECK(mean_of(pool.mean()).y == Approx(sign * SHAPE).epsilon(0.01));
        CHECK(mean_of(pool.variance_of_mean()).y == Approx(SHAPE / PICTURES).epsilon(0.02));
        // By the true variance, and by the spread of eight pictures, which understates it by a half.
        const Pixels variance(PIXELS, Vec3(SHAPE / PICTURES));
        const double skewness = sign * 2.0 / std::sqrt(SHAPE * PICTURES);
        CHECK(pool.skewness_of_mean(variance) == Approx(skewness).epsilon(0.05));
        CHECK(pool.skewness_of_mean() == Approx(0.54 * skewness).epsilon(0.05));
    }
}

TEST_CASE("a pool of few or equal pictures has no skewness", "[converge]")
{
    CHECK(gamma_pictures(1.0, 2, 10, 1).skewness_of_mean() == 0.0);
    CHECK(std::isinf(gamma_pictures(1.0, 1, 10, 1).variance_of_mean().front().x));
    PixelPool equal;
    for (int k = 0; k < 4; ++k) equal.add(Pixels(10, Vec3(0.3)));
    CHECK(equal.skewness_of_mean() == 0.0);
    CHECK(equal.variance_of_mean().front() == Vec3(0.0));
}
