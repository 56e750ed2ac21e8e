// Light from infinitely far away: uniform over the sphere, met by every ray that meets nothing else.
#include "check/device_lights.h"
#include "check/light_checks.h"
#include "check/primitive_sets.h"
#include "support/device_checks.h"
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

TEST_CASE(
    "samples of a constant environment are uniform over the sphere, at an unlimited distance, and give back their "
    "random numbers")
{
    require_passed(light_checks(), "light-environment");
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
