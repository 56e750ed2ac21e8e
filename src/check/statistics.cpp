// Student's t with a statement of its power.
#include "check/statistics.h"

#include "util/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace etendue
{
namespace
{
// A bias is seen with 99 % probability when it is so many standard errors beyond the critical value.
constexpr double POWER_QUANTILE = 2.33;

// Above, Student's t is the normal distribution to all digits that count, and its inverse by bisection is slow.
constexpr double MANY_DEGREES = 1e6;
} // namespace

double critical_value(double test_alpha, double degrees)
{
    const double p = 1.0 - test_alpha / 2.0;
    return degrees > MANY_DEGREES ? normal_quantile(p) : student_t_quantile(p, degrees);
}

MeanTest test_mean(double mean, double standard_error, double degrees, double expected, const CheckContext& context,
                   double largest_share, double roundings)
{
    MeanTest test;
    test.critical = critical_value(context.test_alpha, degrees);
    const double rounding = roundings * FLOAT_ROUNDING * std::abs(expected);
    const double difference = std::max(0.0, std::abs(mean - expected) - rounding);
    if (difference > 0.0) test.z = difference / standard_error;
    // What is not a number is as far off as can be.
    if (!std::isfinite(mean) || std::isnan(test.z)) test.z = std::numeric_limits<double>::infinity();
    test.p_value = 2.0 * (degrees > MANY_DEGREES ? normal_cdf(-test.z) : student_t_cdf(-test.z, degrees));

    const double visible = (test.critical + POWER_QUANTILE) * standard_error + rounding;
    test.detectable_bias = visible == 0.0 ? 0.0 : visible / std::abs(expected);
    test.underpowered = !(test.detectable_bias <= context.delta);
    test.heavy_tail = standard_error != 0.0 && !(largest_share <= HEAVY_SHARE);
    return test;
}

void judge(CheckResult& result, const MeanTest& test, const CheckContext& context)
{
    result.rule = Rule::stat;
    result.statistic = test.z;
    result.unit = "z";
    result.critical = test.critical;
    result.detectable_bias = test.detectable_bias;
    const auto note = [&](const std::string& text) { result.note += (result.note.empty() ? "" : "; ") + text; };
    if (!(test.z <= test.critical)) {
        result.verdict = Verdict::failed;
        note(fmt::format("p = {:.2g}", test.p_value));
    } else if (test.underpowered) {
        result.verdict = Verdict::underpowered;
        note(fmt::format("a bias of {:.2g} % could hide, {:.2g} % must not", 100.0 * test.detectable_bias,
                         100.0 * context.delta));
    } else if (test.heavy_tail) {
        result.verdict = Verdict::underpowered;
        note("heavy tail: one contribution brings more than 5 % of the sum, so the error is not known");
    } else {
        result.verdict = Verdict::passed;
    }
}
} // namespace etendue
