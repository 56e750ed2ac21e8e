// Checks of `etendue check` as tests.
#pragma once

#include "check/check.h"

#include <string>
#include <vector>

namespace etendue
{
// What a check finds on a device under test with the defaults.
std::vector<CheckResult> run_check(const Check& check, const Device& device);

// Run those of the checks whose name contains `part` on every device under test: at least one, each with results, all
// of which passed and belong to the check.
void require_passed(const std::vector<Check>& checks, const std::string& part = "");

// Names of the results that did not pass.
std::vector<std::string> failures(const std::vector<CheckResult>& results);
} // namespace etendue
