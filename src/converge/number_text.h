// Numbers for people.
#pragma once

#include "converge/interval.h"

#include <string>

namespace etendue
{
// Three significant digits; a dash for what is not finite.
std::string short_text(double x);
// "1.23 [1.1, 1.4]".
std::string interval_text(const Interval& interval);
std::string percent_text(double share);
std::string seconds_text(double seconds);
} // namespace etendue
