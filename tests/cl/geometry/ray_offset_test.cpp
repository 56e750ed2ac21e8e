// Rays that leave a surface: they do not meet it again, however grazing, and miss nothing close above it. The checks of
// origins say so for every number of lanes; tests/src/check/bvh_checks_test.cpp shows that they find planted bugs.
#include "check/bvh_checks.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

using namespace etendue;

TEST_CASE("rays leave a surface on their side of it, at every number of lanes")
{
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            CheckContext context;
            context.device = &device;
            context.lanes = lanes;
            for (const Check& check : offset_checks())
                for (const CheckResult& result : check.run(context)) {
                    INFO(lanes << " lanes, " << result.name << ": " << result.note);
                    CHECK(result.verdict == Verdict::passed);
                }
        }
}
