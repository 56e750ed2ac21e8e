// Results for people, as lines of a table.
#pragma once

#include "check/check.h"
#include "check/run.h"

#include <string>

namespace etendue
{
const char* verdict_name(Verdict verdict); // "passed"
const char* rule_name(Rule rule);          // "round"

std::string table_header();
// One line; a note follows on a line of its own where the verdict is not good.
std::string table_row(const CheckResult& result);
// "97 passed, 0 failed, ...", the level of the family, seconds; and what was not run.
std::string table_summary(const RunResult& run, const Family& family);
} // namespace etendue
