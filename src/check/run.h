// Runs checks one after the other, within a time.
#pragma once

#include "check/check.h"
#include "check/family.h"
#include "compute/canary.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace etendue
{
struct RunOptions {
    CheckContext context; // test_alpha comes from the family
    bool fresh_seeds = false;
    std::optional<double> budget;                                                            // seconds
    std::function<void(const CheckResult&)> finished = [](const CheckResult&) {};            // after each result
    std::function<void(std::size_t, const Check&)> begun = [](std::size_t, const Check&) {}; // before each check
};

struct RunResult {
    DeviceInfo device;
    std::vector<CheckResult> results;
    std::vector<std::string> not_run; // names of checks for which there was no time
    bool interrupted = false;
    double seconds = 0.0;
    std::optional<CanaryReport> canary; // none when its kernel does not build

    std::size_t count(Verdict verdict) const;
    // Nothing failed, nothing was too weak and nothing was left out for want of time.
    bool passed() const;
};

// A check that throws has failed, and the others go on. context.stop ends the run before the next check; what
// the stopped one found is dropped.
RunResult run_checks(const std::vector<Check>& checks, const Family& family, const RunOptions& options);
} // namespace etendue
