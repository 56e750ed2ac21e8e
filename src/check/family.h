// All statistical tests of a run are one family: with nothing wrong, the probability that any of them fails is alpha.
#pragma once

#include "check/check.h"

#include <cstddef>
#include <vector>

namespace etendue
{
// With fresh seeds a failure is tried again with so many times the samples, and must be as unlikely as this then.
inline constexpr double RETRY_EFFORT = 16.0;
inline constexpr double RETRY_ALPHA = 1e-6;

struct Family {
    double alpha = 1e-3; // of the family
    std::size_t tests = 0;
    double test_alpha = 1e-3; // of one test (Sidak 1967)
    double critical_z = 0.0;  // of a test with many degrees of freedom
};

// The family of the statistical tests of these checks, each run `repeats` times (once for each device).
Family make_family(const std::vector<Check>& checks, double alpha, std::size_t repeats = 1);

// Run a check. With fresh seeds one that fails a statistical test is run again, and the second verdict counts.
std::vector<CheckResult> run_check(const Check& check, const CheckContext& context, bool fresh_seeds);
} // namespace etendue
