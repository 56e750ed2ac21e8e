// The scenes that are written when they are run: they are scenes, and what they expect is judged.
#include "check/large_scene_checks.h"

#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

using namespace etendue;

TEST_CASE("large scenes are long checks and pass", "[check][render]")
{
    const std::vector<Check> checks = large_scene_checks();
    CHECK(checks.size() == 4);
    for (const Device& device : test_devices()) {
        CheckContext context;
        context.device = &device;
        for (const Check& check : checks) {
            CHECK(check.is_long);
            const std::vector<CheckResult> results = check.run(context);
            CHECK(!results.empty());
            std::size_t statistical_tests = 0;
            for (const CheckResult& result : results) {
                INFO(result.name << ": " << result.found << "; " << result.note);
                CHECK(result.name.rfind(check.name, 0) == 0);
                CHECK(result.group == check.group);
                CHECK(result.verdict == Verdict::passed);
                statistical_tests += result.rule == Rule::stat;
            }
            CHECK(statistical_tests == check.statistical_tests);
        }
    }
}
