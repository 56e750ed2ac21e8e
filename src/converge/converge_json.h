// converge.json: a study with all that it was and came to, for programs.
#pragma once

#include "converge/analysis.h"
#include "converge/study.h"

#include <string>

namespace etendue
{
std::string converge_json(const Study& study, const Analysis& analysis);
} // namespace etendue
