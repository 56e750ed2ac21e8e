// Verdicts about what was gathered.
#include "check/findings.h"

#include "util/statistics.h"
#include "util/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

namespace etendue
{
namespace
{
// Of N trials without a violation: rates above this over N would have shown one with 99 % certainty, log(100).
constexpr double VISIBLE_VIOLATIONS = 4.605;
// A bias at the smallest that a test may miss is found with this quantile's probability, 99 %.
constexpr double POWER_QUANTILE = 2.33;
// A quadrature of probabilities may be off by this.
constexpr double PROBABILITY_TOLERANCE = 1e-4;
} // namespace

Check make_check(const std::string& group, const std::string& name,
                 std::function<std::vector<CheckResult>(const CheckContext&)> run, std::size_t statistical_tests,
                 bool is_long)
{
    const auto timed = [group, run = std::move(run)](const CheckContext& context) {
        const Stopwatch watch;
        std::vector<CheckResult> results = run(context);
        const double share = watch.seconds() / static_cast<double>(std::max<std::size_t>(results.size(), 1));
        for (CheckResult& result : results) {
            result.group = group;
            if (result.seconds == 0.0) result.seconds = share;
        }
        return results;
    };
    return {group, name, is_long, statistical_tests, timed};
}

CheckResult needs_double(const std::string& name, Rule rule, const DeviceInfo& device)
{
    CheckResult result;
    result.name = name;
    result.rule = rule;
    result.verdict = Verdict::not_covered;
    result.note = device.name + " has no double precision (cl_khr_fp64)";
    return result;
}

void Violations::add(const char* what, std::size_t count)
{
    if (count == 0) return;
    if (count_ == 0) first_subject_ = subject_;
    count_ += count;
    const auto found = std::find_if(kinds_.begin(), kinds_.end(), [&](const auto& kind) { return kind.first == what; });
    if (found == kinds_.end())
        kinds_.emplace_back(what, count);
    else
        found->second += count;
}

CheckResult Violations::result(const std::string& name, Rule rule) const
{
    CheckResult result;
    result.name = name;
    result.rule = rule;
    result.expected = "0";
    result.found = fmt::format("{} of {}", count_, trials_);
    result.statistic = static_cast<double>(count_);
    result.unit = "violations";
    result.critical = 0.0;
    if (trials_ > 0) result.detectable_bias = VISIBLE_VIOLATIONS / static_cast<double>(trials_);
    result.verdict = count_ == 0 && trials_ > 0 ? Verdict::passed : Verdict::failed;
    if (trials_ == 0) result.note = "Nothing was tried.";
    for (const auto& [what, count] : kinds_)
        result.note += fmt::format("{}{}: {}", result.note.empty() ? "" : ", ", what, count);
    if (count_ > 0 && !first_subject_.empty()) result.note += fmt::format("; first in {}", first_subject_);
    return result;
}

void WorstError::add(double error)
{
    if (std::isnan(error)) error = std::numeric_limits<double>::infinity();
    if (errors_++ > 0 && error <= worst_) return;
    worst_ = error;
    worst_subject_ = subject_;
}

CheckResult WorstError::result(const std::string& name, double limit, const std::string& unit, Rule rule) const
{
    CheckResult result;
    result.name = name;
    result.rule = rule;
    result.expected = fmt::format("<= {:.4g}", limit);
    result.found = fmt::format("{:.4g}", worst_);
    result.statistic = worst_;
    result.unit = unit;
    result.critical = limit;
    result.verdict = errors_ > 0 && worst_ <= limit ? Verdict::passed : Verdict::failed;
    if (errors_ == 0)
        result.note = "Nothing was tried.";
    else if (!worst_subject_.empty())
        result.note = "worst in " + worst_subject_;
    return result;
}

void DistributionTests::add(const std::string& subject, const Histogram& histogram,
                            const std::vector<double>& probabilities)
{
    add(subject, histogram.counts(), histogram.outside(), probabilities);
}

void DistributionTests::add(const std::string& subject, const std::vector<double>& counts, double outside,
                            const std::vector<double>& probabilities)
{
    const double samples = std::accumulate(counts.begin(), counts.end(), outside);
    std::vector<double> expected;
    double sum = 0.0, where_none = outside;
    for (std::size_t i = 0; i < probabilities.size(); ++i) {
        expected.push_back(probabilities[i] * samples);
        sum += probabilities[i];
        if (probabilities[i] == 0.0) where_none += counts[i];
    }
    const ChiSquare test = chi_square(counts, expected, level_);
    if (tests_++ == 0 || test.p_value < least_p_) {
        least_p_ = test.p_value;
        worst_subject_ = subject;
    }
    worst_bias_ = std::max(worst_bias_, test.degrees > 0.0 ? test.smallest_bias : 1.0);
    samples_ += static_cast<std::size_t>(samples);
    outside_ += static_cast<std::size_t>(where_none);
    if (where_none > 0.0) note_ += fmt::format("{}: {} samples where there are none; ", subject, where_none);
    if (!(std::abs(sum - 1.0) <= PROBABILITY_TOLERANCE))
        note_ += fmt::format("{}: the probabilities add up to {:.6g}; ", subject, sum);
}

CheckResult DistributionTests::result(const std::string& name) const
{
    CheckResult result;
    result.name = name;
    result.rule = Rule::stat;
    result.expected = fmt::format("p > {:.1e}", level_);
    result.found = fmt::format("least p of {}: {:.3g}", tests_, least_p_);
    result.statistic = least_p_;
    result.unit = "p";
    result.critical = level_;
    result.detectable_bias = worst_bias_;
    result.note = note_ + "least in " + worst_subject_;
    if (tests_ == 0 || least_p_ <= level_ || !note_.empty())
        result.verdict = Verdict::failed;
    else
        result.verdict = worst_bias_ <= smallest_bias_ ? Verdict::passed : Verdict::underpowered;
    return result;
}

ExpectedMeans::ExpectedMeans(const CheckContext& context)
    : delta_(context.delta), critical_(normal_quantile(1.0 - 0.5 * context.test_alpha))
{
}

void ExpectedMeans::add(const std::string& subject, double mean, double standard_error, double expected,
                        double tolerance)
{
    const double excess = std::max(std::abs(mean - expected) - tolerance, 0.0);
    double z = excess == 0.0 ? 0.0 : excess / standard_error;
    if (std::isnan(z)) z = std::numeric_limits<double>::infinity();
    if (tests_++ == 0 || z > worst_z_) {
        worst_z_ = z;
        worst_subject_ = subject;
        expected_ = fmt::format("{:.6g}", expected);
        found_ = fmt::format("{:.6g}", mean);
    }
    if (standard_error > 0.0)
        worst_bias_ = std::max(worst_bias_, (critical_ + POWER_QUANTILE) * standard_error / std::abs(expected));
}

CheckResult ExpectedMeans::result(const std::string& name) const
{
    CheckResult result;
    result.name = name;
    result.rule = Rule::stat;
    result.expected = expected_;
    result.found = found_;
    result.statistic = worst_z_;
    result.unit = "z";
    result.critical = critical_;
    result.detectable_bias = worst_bias_;
    result.note = fmt::format("worst of {} in {}", tests_, worst_subject_);
    if (tests_ == 0 || !(worst_z_ <= critical_))
        result.verdict = Verdict::failed;
    else
        result.verdict = worst_bias_ <= delta_ ? Verdict::passed : Verdict::underpowered;
    return result;
}
} // namespace etendue
