// Triangles, disks and spheres that emit, under the checks of src/check/light_checks.h.
#include "check/light_checks.h"
#include "support/device_checks.h"

#include <catch2/catch.hpp>

namespace etendue
{
TEST_CASE("the mean of one over the density of an area light's samples is its solid angle")
{
    require_passed(light_checks(), "light-solid-angle");
}

TEST_CASE("the density of an area light integrates to 1 over all directions that meet it")
{
    require_passed(light_checks(), "light-density-integral");
}

TEST_CASE("a sample of an area light lies on it, with the radiance and the density that a ray to it finds")
{
    require_passed(light_checks(), "light-agreement");
}

TEST_CASE("the random numbers of light samples are found again from their points")
{
    require_passed(light_checks(), "light-inversion");
}

TEST_CASE("samples of an area light are uniform: over the area of triangles and disks, over the cone of spheres")
{
    require_passed(light_checks(), "light-distribution");
}

TEST_CASE("from behind an area light is dark, exactly, unless it has two sides")
{
    require_passed(light_checks(), "light-behind");
}

TEST_CASE("from a point in its plane a flat light is dark, and from its surface nothing is infinite")
{
    require_passed(light_checks(), "light-plane");
}
} // namespace etendue
