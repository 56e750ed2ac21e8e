// The bench on the furnace: its closed forms by brute force, and that it notices a wrong renderer.
#include "converge/self_check.h"

#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <random>

using namespace etendue;

TEST_CASE("the furnace's variance is that of its random walk", "[converge]")
{
    CHECK(furnace_variance(0.5, 0.8) == Approx(0.363636).epsilon(1e-5));
    CHECK(furnace_cost(0.5, 0.5) == Approx(4.0));
    CHECK(furnace_cost(0.5, 0.8) == Approx(1.818).epsilon(1e-3));
    CHECK(furnace_cost(0.5, 0.95) == Approx(1.4286).epsilon(1e-4));
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform;
    double sum = 0.0, squares = 0.0;
    const int walks = 400'000;
    for (int i = 0; i < walks; ++i) {
        double x = 1.0, throughput = 1.0;
        while (uniform(random) < 0.8) x += throughput *= 0.5 / 0.8;
        sum += x / walks;
        squares += x * x / walks;
    }
    CHECK(squares - sum * sum == Approx(furnace_variance(0.5, 0.8)).epsilon(0.02));
}

TEST_CASE("the bench measures what is known", "[converge]")
{
    RenderOptions options;
    options.devices = {test_devices().front().info()};
    const std::vector<SelfCheckResult> results = run_self_check(options, [] { return false; });
    REQUIRE(results.size() == 6);
    for (const SelfCheckResult& result : results) {
        CAPTURE(result.name, result.expected, result.found, result.standard_error);
        CHECK(result.passed);
        // It could have seen an error of a tenth.
        CHECK(result.standard_error < 0.03 * result.expected);
    }
    CHECK(run_self_check(options, [] { return true; }).empty());
}

TEST_CASE("a bench that is wrong does not pass", "[converge]")
{
    const SelfCheckResult right{"a", 1.0, 1.01, 0.01, true}, wrong{"b", 1.0, 1.1, 0.01, false};
    CHECK(passed({right}));
    CHECK_FALSE(passed({right, wrong}));
    CHECK(wrong.z() == Approx(10.0));
}
