// The tables of report.html.
#pragma once

#include "converge/analysis.h"
#include "converge/study.h"

#include <string>

namespace etendue
{
std::string ratio_table(const Analysis& analysis);
std::string target_table(const Analysis& analysis);
std::string fit_table(const Analysis& analysis);
std::string verdict_table(const Analysis& analysis);
std::string calibration_table(const Analysis& analysis);
std::string phase_tables(const Study& study);
std::string self_check_table(const Study& study);
std::string setting_list(const Study& study);
} // namespace etendue
