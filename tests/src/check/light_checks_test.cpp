// The checks of lights find what is planted; that sound ones pass is in tests/cl/light.
#include "check/light_checks.h"

#include "support/device_checks.h"

#include <catch2/catch.hpp>

using namespace etendue;

namespace
{
using Names = std::vector<std::string>;
} // namespace

TEST_CASE("a light sampled with half its density is found")
{
    CHECK(failures_with_bug(light_checks(), "light-", "light/area.h", "distance2 / (area * cosine)",
                            "distance2 / (2.0 * area * cosine)") ==
          Names{"light-solid-angle", "light-density-integral"});
}

TEST_CASE("a cosine taken from both sides lets light out at the back")
{
    CHECK(failures_with_bug(light_checks(), "light-behind", "light/light.h", "(dot3(point.normal, wi) < 0.0)",
                            "(dot3(point.normal, wi) != 0.0)") == Names{"light-behind"});
}

TEST_CASE("points crowded at the centre of a disk are found")
{
    CHECK(failures_with_bug(light_checks(), "light-distribution", "sampling/warp.h",
                            "Float r = sqrt(v);\n    return vec2(",
                            "Float r = v;\n    return vec2(") == Names{"light-distribution"});
}

TEST_CASE("random numbers that swap their roles on a triangle are found")
{
    // Still uniform over its area.
    CHECK(failures_with_bug(light_checks(), "light-", "light/area.h", "uniform_triangle_sample(u, v)",
                            "uniform_triangle_sample(v, u)") == Names{"light-inversion"});
}
