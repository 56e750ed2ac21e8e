// What a light sample promises whoever traces a shadow ray to it.
#include "check/device_lights.h"
#include "check/primitive_sets.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace etendue
{
namespace
{
LightScene one_of_each()
{
    LightScene scene;
    scene.add_area(make_triangle(make_real4(-1, 2, -1), make_real4(2, 2, 0), make_real4(0, 2, 1.5)), {1, 1, 1});
    scene.add_area(make_sphere(3, 0, 0, 0.5), {2, 2, 2});
    scene.add_area({make_real4(0, 0, 3, PRIMITIVE_DISK), make_real4(0, 0, -1), make_real4(0.5, 0, 0)}, {3, 3, 3});
    scene.add_environment({4, 4, 4});
    return scene;
}
} // namespace

TEST_CASE("to_light leads to the light in lengths of t_max, and wi is the same direction with length 1")
{
    const Point from{0.25, 0.125, 0};
    for (const Device& device : test_devices()) {
        std::size_t seen[4] = {0, 0, 0, 0}, wrong = 0;
        for (const auto& s : DeviceLights(device, one_of_each()).sample(from, random_words(1 << 12, 79))) {
            ++seen[s.primitive == NO_INDEX ? 3 : s.primitive];
            wrong += std::abs(length(s.wi) - 1) > 1e-6;
            wrong += length(cross(s.wi, s.to_light)) > 1e-6 * length(s.to_light) || dot(s.wi, s.to_light) <= 0;
            if (s.primitive == NO_INDEX) continue;
            // The point is where t_max says, on the plane or the sphere.
            const Point p = from + s.t_max * s.to_light;
            wrong += s.t_max != 1;
            if (s.primitive == 0) wrong += std::abs(p[1] - 2) > 1e-6;
            if (s.primitive == 1) wrong += std::abs(length(p - Point{3, 0, 0}) - 0.5) > 2e-6;
            if (s.primitive == 2) wrong += std::abs(p[2] - 3) > 1e-6;
        }
        CHECK(wrong == 0);
        for (const std::size_t count : seen) CHECK(count > 500);
    }
}

TEST_CASE("lanes that are not active get a sample of density 0")
{
    const auto words = random_words(1 << 10, 83);
    std::vector<uint> active;
    for (std::size_t i = 0; i < words.size(); ++i) active.push_back(words[i][0] >> 5 & 1);
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceLights lights(device, one_of_each(), lanes);
            const auto all = lights.sample({0, 0, 0}, words), some = lights.sample({0, 0, 0}, words, active);
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < words.size(); ++i) wrong += some[i].pdf != (active[i] ? all[i].pdf : 0.0);
            CHECK(wrong == 0);
        }
}
} // namespace etendue
