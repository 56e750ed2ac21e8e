// What `etendue check` is made of: checks that can be run, and what each of them found.
#pragma once

#include "compute/device.h"
#include "compute/program.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace etendue
{
enum class Verdict {
    passed,
    failed,
    underpowered, // a bias as large as delta could have hidden: counts as a failure
    not_covered   // needs a feature that does not exist yet; the note says which
};

// How what was found was compared with what was expected.
enum class Rule {
    exact, // equal bits
    round, // within a number of roundings
    bound, // an inequality for every sample
    count, // no violation in so many trials
    stat   // a test at the family's level, with the power to see a bias of delta
};

inline constexpr double UNKNOWN = std::numeric_limits<double>::quiet_NaN();

// One line of the table.
struct CheckResult {
    std::string group; // "analytic"
    std::string name;  // "F1-albedo-0.8-depth-8"; unique within the run
    Rule rule = Rule::exact;
    std::string expected, found;      // for a person: "4.32891", "0 of 1000000"
    double statistic = UNKNOWN;       // how far off, in `unit`
    std::string unit;                 // "z", "ulp", "p", "violations", "x limit"
    double critical = UNKNOWN;        // the statistic's limit
    double detectable_bias = UNKNOWN; // the smallest relative bias seen with 99 % certainty
    double largest_share = UNKNOWN;   // of one contribution in the whole: above 5 % the tail is heavy
    Verdict verdict = Verdict::failed;
    double seconds = 0.0;
    std::string note; // why it failed, what is special
};

// A scene's own seed on top of it stays one that `etendue replay` takes.
inline constexpr std::uint64_t MAX_CHECK_SEED = ~std::uint64_t{0} >> 2;

inline constexpr double DEFAULT_DELTA = 0.005;

// What every check gets.
struct CheckContext {
    const Device* device = nullptr;
    std::uint32_t lanes = 0;      // 0: as suits the device
    bool specialize = false;      // scenes by their own kernels, not by the general one
    double test_alpha = 2e-6;     // two-sided level of one statistical test: the family's level after Sidak
    double delta = DEFAULT_DELTA; // relative bias that a statistical test must be able to see
    std::uint64_t seed = 0;       // added to the seeds of everything random; at most MAX_CHECK_SEED
    double effort = 1.0;          // multiplies the number of samples; 16 when a failure is tried again
    KernelCache cache;
    std::function<bool()> stop = [] { return false; };
};

// Something to check.
struct Check {
    std::string group;                 // "analytic", "stiff", "bsdf", "sampling", "bvh", "device"
    std::string name;                  // its results' names begin with it
    bool is_long = false;              // only with --long
    std::size_t statistical_tests = 0; // of its results: they make the family
    std::function<std::vector<CheckResult>(const CheckContext&)> run;
};
} // namespace etendue
