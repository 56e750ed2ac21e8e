// The choice of lights.
#include "geometry/lights.h"

#include <catch2/catch.hpp>
#include <numbers>

using namespace etendue;

namespace
{
std::vector<double> probabilities(const LightList& list)
{
    std::vector<double> result;
    for (const Light& light : list.lights) result.push_back(static_cast<double>(light.radiance.s[3]));
    return result;
}
} // namespace

TEST_CASE("lights are chosen by power, with a uniform share")
{
    LightList list;
    CHECK(add_area_light(list, {Vec3(3, 0, 0), false}, 5, 2.0, {}) == 0);
    CHECK(add_area_light(list, {Vec3(1, 1, 1), true}, 6, 1.0, {}) == 1);
    add_environment_light(list, {Vec3(0.5), {}}, 2.0);
    const auto table = make_light_table(list);
    CHECK(table.size() == 4);

    // Powers: pi * 2, pi * 1 * 2 sides, and pi * 0.5 * (pi * 4).
    const double powers[] = {2.0, 2.0, 2.0 * std::numbers::pi};
    const double sum = powers[0] + powers[1] + powers[2];
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(probabilities(list)[i] == Approx(0.9 * powers[i] / sum + 0.1 / 3).epsilon(1e-6));
    CHECK(list.lights[0].type == LIGHT_AREA);
    CHECK(list.lights[0].primitive == 5);
    CHECK(list.lights[0].flags == 0);
    CHECK(list.lights[0].radiance.s[0] == 3.0f);
    CHECK(list.lights[1].flags == LIGHT_TWO_SIDED);
    CHECK(list.lights[2].type == LIGHT_ENVIRONMENT);
    CHECK(list.lights[2].primitive == NO_INDEX);
}

TEST_CASE("of two lights of 1e8 and 1e-8 the dim one is still chosen every twentieth time")
{
    LightList list;
    add_area_light(list, {Vec3(1e8), false}, 0, 1.0, {});
    add_area_light(list, {Vec3(1e-8), false}, 1, 1.0, {});
    make_light_table(list);
    CHECK(probabilities(list)[0] == Approx(0.95).epsilon(1e-6));
    CHECK(probabilities(list)[1] == Approx(0.05).epsilon(1e-6));
}

TEST_CASE("what emits nothing is no light, and an environment alone is chosen always")
{
    LightList list;
    CHECK(add_area_light(list, {Vec3(0.0), false}, 0, 1.0, {}) == NO_INDEX);
    CHECK(add_area_light(list, {Vec3(1e-60), false}, 0, 1.0, {}) == NO_INDEX);
    CHECK(make_light_table(list).empty());
    add_environment_light(list, {Vec3(1.0), {}}, 0.0);
    CHECK(make_light_table(list).size() == 1);
    CHECK(probabilities(list) == std::vector<double>{1.0});
}

TEST_CASE("a radiance that is negative or no finite float is refused")
{
    LightList list;
    SourceLocation where;
    where.pointer = "/shapes/1";
    CHECK_THROWS_AS(add_area_light(list, {Vec3(0, -1, 0), false}, 0, 1.0, where), SceneError);
    CHECK_THROWS_WITH(add_area_light(list, {Vec3(0, 1e39, 0), false}, 0, 1.0, where),
                      "/shapes/1: the radiance must be between 0 and 3.4e+38, is (0, 1e+39, 0).");
    CHECK_THROWS_AS(add_environment_light(list, {Vec3(NAN), where}, 1.0), SceneError);
}
