// The loop over checks.
#include "check/run.h"

#include "util/error.h"
#include "util/stopwatch.h"

#include <algorithm>

namespace etendue
{
namespace
{
// The check of the canary, where it is asked for, tells why there is none.
std::optional<CanaryReport> canary_of(const CheckContext& context)
{
    if (!context.device) return {};
    try {
        return run_canary(*context.device, "", context.cache);
    } catch (const Error&) {
        return {};
    }
}

std::vector<CheckResult> run_or_fail(const Check& check, const CheckContext& context, bool fresh_seeds)
{
    Stopwatch watch;
    try {
        return run_check(check, context, fresh_seeds);
    } catch (const std::exception& error) {
        CheckResult result;
        result.group = check.group;
        result.name = check.name;
        result.expected = "a result";
        result.found = "an error";
        result.seconds = watch.seconds();
        result.note = error.what();
        return {result};
    }
}
} // namespace

std::size_t RunResult::count(Verdict verdict) const
{
    return static_cast<std::size_t>(std::count_if(
        results.begin(), results.end(), [&](const CheckResult& result) { return result.verdict == verdict; }));
}

bool RunResult::passed() const
{
    return count(Verdict::failed) == 0 && count(Verdict::underpowered) == 0 && not_run.empty();
}

RunResult run_checks(const std::vector<Check>& checks, const Family& family, const RunOptions& options)
{
    Stopwatch watch;
    RunResult run;
    CheckContext context = options.context;
    context.test_alpha = family.test_alpha;
    if (context.device) run.device = context.device->info();
    run.canary = canary_of(context);
    for (std::size_t i = 0; i < checks.size(); ++i) {
        const bool late = options.budget && watch.seconds() >= *options.budget;
        run.interrupted = run.interrupted || context.stop();
        if (late || run.interrupted) {
            run.not_run.push_back(checks[i].name);
            continue;
        }
        options.begun(i, checks[i]);
        const std::vector<CheckResult> results = run_or_fail(checks[i], context, options.fresh_seeds);
        if (context.stop()) {
            run.interrupted = true;
            run.not_run.push_back(checks[i].name);
            continue;
        }
        for (const CheckResult& result : results) {
            run.results.push_back(result);
            options.finished(result);
        }
    }
    run.seconds = watch.seconds();
    return run;
}
} // namespace etendue
