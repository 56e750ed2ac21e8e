// Results for programs.
#pragma once

#include "check/run.h"

#include <string>
#include <vector>

namespace etendue
{
// What a run was, and every result of every device. Numbers that are not known or not finite are null.
std::string check_json(const std::vector<RunResult>& runs, const Family& family, const CheckContext& context,
                       const std::string& command);
} // namespace etendue
