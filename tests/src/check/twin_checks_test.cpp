// Case D2: it passes on the kernels as they are, and counts where paths part.
#include "check/twin_checks.h"

#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace etendue;
using Catch::Contains;

namespace
{
PathRecord path_over(const std::vector<std::uint32_t>& primitives)
{
    PathRecord path;
    for (const std::uint32_t primitive : primitives) {
        fp64::PathVertex vertex{};
        vertex.primitive = primitive;
        path.vertices.push_back(vertex);
    }
    path.vertex_count = static_cast<std::uint32_t>(primitives.size());
    return path;
}
} // namespace

TEST_CASE("paths part where their primitives do, or where one ends, and count no further", "[check][twin]")
{
    PathDivergence total;
    add_divergence(total, {path_over({1, 2, 3}), path_over({1, 2, 3}), path_over({1, 2}), path_over({5})},
                   {path_over({1, 2, 3}), path_over({1, 9, 3}), path_over({1, 2, 4}), path_over({6})});
    CHECK(total.pairs == std::vector<std::uint64_t>{4, 3, 2});
    CHECK(total.parted == std::vector<std::uint64_t>{1, 1, 1});
    add_divergence(total, {path_over({1, 2, 3, 4})}, {path_over({1, 2, 3, 4})});
    CHECK(total.pairs == std::vector<std::uint64_t>{5, 4, 3, 1});
    CHECK(total.parted == std::vector<std::uint64_t>{1, 1, 1, 0});
}

TEST_CASE("the fp64 twin finds the same light as the float kernels", "[check][twin]")
{
    // The box, one of light and one of nothing but darkness; all scenes take two minutes.
    std::vector<Check> checks = twin_checks();
    CHECK(std::count_if(checks.begin(), checks.end(), [](const Check& c) { return !c.is_long; }) == 1);
    CHECK(checks.size() > 280);
    std::erase_if(checks, [](const Check& c) {
        return c.name != "D2" && c.name != "D2-R4-gap-1e-06" && c.name != "D2-L11-no-light";
    });
    REQUIRE(checks.size() == 3);
    for (const Device& device : test_devices())
        for (const Check& check : checks) {
            CHECK(check.group == "device");
            CheckContext context;
            context.device = &device;
            std::size_t statistical = 0;
            for (const CheckResult& result : check.run(context)) {
                INFO(result.name << ": " << result.found << "; " << result.note);
                CHECK_THAT(result.name, Catch::StartsWith(check.name));
                statistical += result.rule == Rule::stat;
                if (!device.info().has_double) {
                    CHECK(result.verdict == Verdict::not_covered);
                    continue;
                }
                CHECK(result.verdict == Verdict::passed);
                CHECK(result.statistic <= result.critical);
                if (result.rule == Rule::stat) {
                    CHECK_FALSE(result.detectable_bias > context.delta);
                    // The roundings differ.
                    if (check.name == "D2") CHECK(result.detectable_bias > 0.0);
                } else {
                    CHECK_THAT(result.note, Contains(" 0: ") && Contains(" 8: "));
                }
            }
            CHECK(statistical == check.statistical_tests);
        }
}

TEST_CASE("a device without double precision leaves the twin uncovered", "[check][twin]")
{
    DeviceInfo info = test_devices().front().info();
    info.has_double = false;
    const Device device(info);
    CheckContext context;
    context.device = &device;
    const auto results = twin_checks()[0].run(context);
    REQUIRE(results.size() == 2);
    for (const CheckResult& result : results) {
        CHECK(result.verdict == Verdict::not_covered);
        CHECK_THAT(result.note, Contains("no double precision"));
    }
}
