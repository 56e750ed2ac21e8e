#include "check/statistics.h"

#include "util/statistics.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace etendue;
using Catch::Contains;

namespace
{
CheckContext at_level(double alpha, double delta = 0.005)
{
    CheckContext context;
    context.test_alpha = alpha;
    context.delta = delta;
    return context;
}

Verdict verdict_of(const MeanTest& test, const CheckContext& context)
{
    CheckResult result;
    judge(result, test, context);
    return result.verdict;
}
} // namespace

TEST_CASE("a mean is tested by Student's t at the level of the run", "[host]")
{
    // Quantiles of tables: 97.5 % of t with 10 degrees, and of the normal distribution.
    CHECK(critical_value(0.05, 10) == Approx(2.228139).epsilon(1e-6));
    CHECK(critical_value(0.05, 1e9) == Approx(1.959964).epsilon(1e-6));
    const MeanTest test = test_mean(1.02, 0.01, 10, 1.0, at_level(0.05));
    CHECK(test.z == Approx(2.0).epsilon(1e-3));
    CHECK(test.p_value == Approx(0.07339).epsilon(1e-3));
    CHECK(test.critical == Approx(2.228139).epsilon(1e-6));
}

TEST_CASE("a test that could not see a bias of delta is underpowered, whatever it finds", "[host]")
{
    // (1.96 + 2.33) standard errors are the bias that is seen with 99 % probability.
    const CheckContext context = at_level(0.05);
    const double limit = 0.005 / (1.959964 + 2.33);
    const MeanTest strong = test_mean(1.0, 0.999 * limit, 1e9, 1.0, context);
    CHECK(strong.detectable_bias == Approx(0.005).epsilon(2e-3));
    CHECK(verdict_of(strong, context) == Verdict::passed);
    const MeanTest weak = test_mean(1.0, 1.001 * limit, 1e9, 1.0, context);
    CHECK(weak.underpowered);
    CHECK(verdict_of(weak, context) == Verdict::underpowered);
    // The bias is relative.
    CHECK_FALSE(test_mean(100.0, limit, 1e9, 100.0, context).underpowered);
    // What is found wrong is wrong all the same.
    CHECK(verdict_of(test_mean(2.0, 1.001 * limit, 1e9, 1.0, context), context) == Verdict::failed);
}

TEST_CASE("99 % of biases as large as the detectable one are seen", "[host]")
{
    const CheckContext context = at_level(1e-3);
    std::mt19937_64 random(1);
    std::normal_distribution<double> noise;
    int seen = 0;
    const int trials = 20000;
    const double bias = test_mean(1.0, 0.001, 1e9, 1.0, context, 0, 0).detectable_bias;
    for (int i = 0; i < trials; ++i) {
        const MeanTest test = test_mean(1.0 + bias + 0.001 * noise(random), 0.001, 1e9, 1.0, context, 0, 0);
        seen += test.z > test.critical;
    }
    CHECK(seen / double(trials) == Approx(0.99).margin(0.003));
}

TEST_CASE("without any variance only roundings are allowed", "[host]")
{
    const CheckContext context = at_level(1e-6);
    CHECK(verdict_of(test_mean(1.0 + 15 * FLOAT_ROUNDING, 0.0, 100, 1.0, context), context) == Verdict::passed);
    const MeanTest off = test_mean(1.0 + 17 * FLOAT_ROUNDING, 0.0, 100, 1.0, context);
    CHECK(std::isinf(off.z));
    CHECK(verdict_of(off, context) == Verdict::failed);
    CHECK(verdict_of(test_mean(0.0, 0.0, 100, 0.0, context), context) == Verdict::passed);
    CHECK(verdict_of(test_mean(1e-30, 0.0, 100, 0.0, context), context) == Verdict::failed);
}

TEST_CASE("a mean that is no number fails, and so does an error that is none", "[host]")
{
    const CheckContext context = at_level(1e-3);
    const double nan = std::nan("");
    CHECK(verdict_of(test_mean(nan, 0.1, 100, 1.0, context), context) == Verdict::failed);
    CHECK(verdict_of(test_mean(INFINITY, 0.1, 100, 1.0, context), context) == Verdict::failed);
    CHECK(verdict_of(test_mean(1.5, nan, 100, 1.0, context), context) == Verdict::failed);
    CHECK(verdict_of(test_mean(1.0, INFINITY, 100, 1.0, context), context) == Verdict::underpowered);
}

TEST_CASE("a mean of which one contribution is a twentieth has no error that anyone knows", "[host]")
{
    const CheckContext context = at_level(1e-3);
    CHECK(verdict_of(test_mean(1.0, 1e-4, 1e4, 1.0, context, 0.049), context) == Verdict::passed);
    CheckResult result;
    judge(result, test_mean(1.0, 1e-4, 1e4, 1.0, context, 0.051), context);
    CHECK(result.verdict == Verdict::underpowered);
    CHECK_THAT(result.note, Contains("heavy tail"));
    // Without variance nothing is uncertain.
    CHECK(verdict_of(test_mean(1.0, 0.0, 1e4, 1.0, context, 1.0), context) == Verdict::passed);
}
