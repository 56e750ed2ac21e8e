// The perfect mirror: one direction, known exactly.
#include "check/bsdf_suite.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

namespace etendue
{
TEST_CASE("a mirror turns a direction round its normal, exactly, on both sides, and multiplies by its colour")
{
    const BsdfCase mirror{BSDF_MIRROR, {0.25f, 0.5f, 1.0f}, "mirror"};
    for (const Device& device : test_devices())
        for (const Direction& wo : standard_directions())
            for (const auto& s :
                 DeviceBsdf(device, mirror).sample({wo}, {{0, 0, 0, 0}, {7, 1u << 31, 0xffffffffu, 9}})) {
                CHECK(s.wi == Direction{-wo[0], -wo[1], wo[2]});
                CHECK(s.weight == std::array<float, 3>{0.25f, 0.5f, 1.0f});
                CHECK(s.pdf == 1.0f);
                CHECK(s.delta);
                CHECK(s.radiance_scale == 1.0f);
            }
}
} // namespace etendue
