// Levels by Sidak, and second tries.
#include "check/family.h"

#include "check/statistics.h"
#include "util/statistics.h"

#include <algorithm>
#include <limits>

namespace etendue
{
namespace
{
// Another seed that nothing else of the run has.
constexpr std::uint64_t RETRY_SEED = 0x9e3779b97f4a7c15u;

bool failed_by_chance_perhaps(const CheckResult& result)
{
    return result.rule == Rule::stat && result.verdict == Verdict::failed;
}
} // namespace

Family make_family(const std::vector<Check>& checks, double alpha, std::size_t repeats)
{
    Family family;
    family.alpha = alpha;
    for (const Check& check : checks) family.tests += check.statistical_tests * repeats;
    family.test_alpha = sidak_alpha(alpha, std::max<std::size_t>(family.tests, 1));
    family.critical_z = critical_value(family.test_alpha, std::numeric_limits<double>::infinity());
    return family;
}

std::vector<CheckResult> run_check(const Check& check, const CheckContext& context, bool fresh_seeds)
{
    std::vector<CheckResult> results = check.run(context);
    if (!fresh_seeds || !std::any_of(results.begin(), results.end(), failed_by_chance_perhaps)) return results;

    CheckContext again = context;
    again.seed = (again.seed + RETRY_SEED) & MAX_CHECK_SEED;
    again.effort *= RETRY_EFFORT;
    again.test_alpha = RETRY_ALPHA;
    std::vector<CheckResult> second = check.run(again);
    for (std::size_t i = 0; i < second.size() && i < results.size(); ++i) {
        if (!failed_by_chance_perhaps(results[i])) continue;
        results[i] = second[i];
        results[i].note += (results[i].note.empty() ? "" : "; ");
        results[i].note += "failed at first, tried again with 16 times the samples";
    }
    return results;
}
} // namespace etendue
