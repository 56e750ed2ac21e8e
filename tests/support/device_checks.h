// Checks of `etendue check` as tests.
#pragma once

#include "check/check.h"

#include <filesystem>
#include <string>
#include <vector>

namespace etendue
{
// What a check finds on a device under test with the defaults.
std::vector<CheckResult> run_check(const Check& check, const Device& device);

// Run those of the checks whose name contains `part` on every device under test: at least one, each with results, all
// of which passed (or says that it is not covered) and belongs to the check.
void require_passed(const std::vector<Check>& checks, const std::string& part = "");

// Names of the results that failed or were underpowered.
std::vector<std::string> failures(const std::vector<CheckResult>& results);

// The results that fail on the first device under test when a piece of cl/`file` is another one, from those of the
// checks whose name contains `part`.
std::vector<std::string> failures_with_bug(const std::vector<Check>& checks, const std::string& part,
                                           const std::string& file, const std::string& piece, const std::string& other);
} // namespace etendue
