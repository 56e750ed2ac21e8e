// Verdicts: what passes, what fails, and what says too little.
#include "check/findings.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace etendue;
using Catch::Contains;

TEST_CASE("no violation passes, with the rate that would have been seen; one fails and is named")
{
    Violations violations;
    CHECK(violations.result("x").verdict == Verdict::failed); // nothing was tried
    for (int i = 0; i < 1000; ++i) violations.expect(true, "wrong");
    const CheckResult good = violations.result("x");
    CHECK(good.verdict == Verdict::passed);
    CHECK(good.found == "0 of 1000");
    CHECK(good.detectable_bias == Approx(std::log(100) / 1000).epsilon(1e-3));
    violations.set_subject("the first");
    violations.expect(false, "wrong");
    violations.set_subject("the second");
    violations.add("odd", 2);
    const CheckResult bad = violations.result("x");
    CHECK(bad.verdict == Verdict::failed);
    CHECK(bad.statistic == 3);
    CHECK(bad.note == "wrong: 1, odd: 2; first in the first");
}

TEST_CASE("the largest error counts, and one that is not a number is infinite")
{
    WorstError error;
    CHECK(error.result("x", 1, "u").verdict == Verdict::failed); // nothing was tried
    error.set_subject("a");
    error.add(0.5);
    error.set_subject("b");
    error.add(0.25);
    CHECK(error.result("x", 0.5, "u").verdict == Verdict::passed);
    CHECK(error.result("x", 0.4, "u").verdict == Verdict::failed);
    CHECK(error.result("x", 0.4, "u").note == "worst in a");
    error.add(std::numeric_limits<double>::quiet_NaN());
    CHECK(error.result("x", 1e300, "u").verdict == Verdict::failed);
}

TEST_CASE("a distribution passes by its density, fails by another, and a few samples are underpowered")
{
    const CheckContext context;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(0, 1);
    const auto result = [&](int samples, double power) {
        Histogram histogram(4, 4);
        for (int i = 0; i < samples; ++i) histogram.add(std::pow(u(random), power), u(random));
        DistributionTests tests(context);
        tests.add("square", histogram, std::vector<double>(16, 1.0 / 16));
        return tests.result("x");
    };
    CHECK(result(1 << 18, 1.0).verdict == Verdict::passed);
    CHECK(result(1 << 18, 1.05).verdict == Verdict::failed);
    CHECK(result(1 << 10, 1.0).verdict == Verdict::underpowered);
}

TEST_CASE("samples where there are none, or probabilities that do not add up to 1, fail")
{
    const CheckContext context;
    Histogram histogram(2, 1);
    for (int i = 0; i < 1 << 19; ++i) histogram.add(0.25 + 0.5 * (i % 2), 0.5);
    DistributionTests good(context), outside(context), unequal(context);
    good.add("halves", histogram, {0.5, 0.5});
    CHECK(good.result("x").verdict == Verdict::passed);
    unequal.add("halves", histogram, {0.5, 0.501});
    CHECK_THAT(unequal.result("x").note, Contains("add up to 1.001"));
    CHECK(unequal.result("x").verdict == Verdict::failed);
    histogram.add(2, 0.5);
    outside.add("halves", histogram, {0.5, 0.5});
    CHECK(outside.result("x").verdict == Verdict::failed);
}

TEST_CASE("a mean is right within its error, wrong beyond, underpowered when the error hides a bias of delta")
{
    const CheckContext context; // sees 0.5 %
    const auto result = [&](double mean, double standard_error) {
        ExpectedMeans tests(context);
        tests.add("mean", mean, standard_error, 2.0, 0.0);
        return tests.result("x").verdict;
    };
    CHECK(result(2.0, 0.001) == Verdict::passed);
    CHECK(result(2.004, 0.001) == Verdict::passed);
    CHECK(result(2.006, 0.001) == Verdict::failed);
    CHECK(result(2.0, 0.01) == Verdict::underpowered);
    // Without variance a mean is right or wrong.
    CHECK(result(2.0, 0.0) == Verdict::passed);
    CHECK(result(2.0 + 1e-9, 0.0) == Verdict::failed);
    CHECK(result(std::nan(""), 0.001) == Verdict::failed);
}

TEST_CASE("results get the group of their check, and share its time")
{
    const Check check = make_check(
        "bvh", "two", [](const CheckContext&) { return std::vector<CheckResult>(2); }, 3, true);
    CHECK(check.is_long);
    CHECK(check.statistical_tests == 3);
    for (const CheckResult& result : check.run({})) {
        CHECK(result.group == "bvh");
        CHECK(result.seconds > 0);
    }
}
