// Light from infinitely far away: uniform over the sphere, met by every ray that meets nothing else.
#include "check/primitive_sets.h"
#include "support/chi_square.h"
#include "check/device_lights.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

namespace etendue
{
namespace
{
constexpr double PI = std::numbers::pi;
const Point RADIANCE{0.5, 1, 2};

LightScene sky()
{
    LightScene scene;
    scene.add_environment(RADIANCE);
    return scene;
}
} // namespace

TEST_CASE("samples of a constant environment are uniform over the sphere, at an unlimited distance")
{
    for (const Device& device : test_devices()) {
        Histogram histogram(16, 16);
        std::size_t wrong = 0;
        for (const auto& s : DeviceLights(device, sky()).sample({0.1, 0.2, 0.3}, random_words(1 << 19, 59))) {
            const double turn = std::atan2(s.wi[1], s.wi[0]) / (2 * PI);
            histogram.add(turn - std::floor(turn), 0.5 * (1 + s.wi[2]));
            wrong += s.t_max != std::numeric_limits<double>::infinity() || s.primitive != NO_INDEX;
            wrong += s.radiance != RADIANCE || std::abs(s.pdf * 4 * PI - 1) > 1e-6;
            wrong += std::abs(length(s.wi) - 1) > 1e-6 || s.to_light != s.wi;
        }
        CHECK(wrong == 0);
        check_histogram("environment", histogram, std::vector<double>(256, 1.0 / 256));
    }
}

TEST_CASE("the direction of an environment sample gives back the random numbers")
{
    const auto words = random_words(1 << 14, 61);
    for (const Device& device : test_devices()) {
        const auto samples = DeviceLights(device, sky()).sample({0, 0, 0}, words);
        double worst = 0;
        for (std::size_t i = 0; i < words.size(); ++i) {
            const double u = (words[i][2] >> 8) * 0x1p-24, v = (words[i][3] >> 8) * 0x1p-24;
            const Point& w = samples[i].wi;
            const double sine = std::hypot(w[0], w[1]);
            worst = std::max(worst, std::abs(0.5 * (1 - w[2]) - v));
            worst = std::max(worst, sine * std::abs(std::remainder(std::atan2(w[1], w[0]) / (2 * PI) - u, 1.0)));
        }
        CHECK(worst <= 1e-6);
    }
}

TEST_CASE("rays that leave a scene see its environment with the density of its sampling, others what they meet")
{
    LightScene scene = sky();
    scene.add_dark(triangle_at(0, 0, -1, 0.5));
    std::vector<Point> directions{{0, 0, -1}};
    for (std::size_t i = 0; i < 1 << 12; ++i) {
        const auto [u, v] = even_point(i);
        const double z = 1 - 2 * v, r = std::sqrt(1 - z * z);
        directions.push_back({r * std::cos(2 * PI * u), r * std::sin(2 * PI * u), z});
    }
    for (const Device& device : test_devices()) {
        const auto hits = DeviceLights(device, scene).meet({0, 0, 0}, directions);
        CHECK(hits[0].primitive == 0);
        double integral = 0;
        for (const DeviceLightHit& hit : hits) {
            const bool met = hit.primitive != NO_INDEX;
            CHECK(hit.radiance == (met ? Point{0, 0, 0} : RADIANCE));
            CHECK(hit.pdf == Approx(met ? 0 : 1 / (4 * PI)).epsilon(1e-6));
            integral += met ? 1 / (4 * PI) : hit.pdf;
        }
        CHECK(integral / static_cast<double>(hits.size()) * 4 * PI == Approx(1).epsilon(1e-6));
    }
}

TEST_CASE("without an environment a ray that leaves the scene sees black")
{
    LightScene scene;
    scene.add_area(triangle_at(0, 0, -1, 0.5), RADIANCE);
    for (const Device& device : test_devices()) {
        const auto hits = DeviceLights(device, scene).meet({0, 0, 0}, {{0, 0, 1}});
        CHECK(hits[0].primitive == NO_INDEX);
        CHECK(hits[0].radiance == Point{0, 0, 0});
        CHECK(hits[0].pdf == 0);
    }
}
} // namespace etendue
