// The canary's findings as lines, and parts of the other groups under names of their own.
#include "check/device_checks.h"

#include "check/bvh_checks.h"
#include "check/findings.h"
#include "compute/canary.h"

namespace etendue
{
namespace
{
using Results = std::vector<CheckResult>;

// D1: flown anew, whatever the cache says.
Results check_canary(const CheckContext& context)
{
    Results results;
    for (const CanaryFinding& finding : run_canary(*context.device, "", KernelCache::none()).findings) {
        CheckResult result;
        result.name = "device-canary-" + finding.name;
        result.rule = Rule::exact;
        result.expected = "strict";
        result.found = finding.passed ? "strict" : "not strict";
        result.verdict = finding.passed ? Verdict::passed : Verdict::failed;
        result.note = finding.detail;
        results.push_back(result);
    }
    return results;
}
} // namespace

std::vector<Check> device_checks()
{
    std::vector<Check> checks{make_check("device", "device-canary", check_canary)};
    for (Check& check : accuracy_checks()) checks.push_back(std::move(check));
    checks.push_back(make_check("device", "device-sort",
                                [](const CheckContext& c) { return Results{check_sort(c, "device-sort")}; }));
    checks.push_back(make_check("device", "device-tree",
                                [](const CheckContext& c) { return Results{check_device_tree(c, "device-tree")}; }));
    checks.push_back(make_check("device", "device-watertight",
                                [](const CheckContext& c) { return check_watertight(c, "device-watertight", 1e5); }));
    for (Check& check : bits_checks()) checks.push_back(std::move(check));
    return checks;
}
} // namespace etendue
