// Error against time, as pictures.
#pragma once

#include "converge/analysis.h"
#include "converge/study.h"

#include <string>

namespace etendue
{
enum class TimeAxis { render, total };

// A curve with its band for each configuration, a guide of slope -1, and the reference's own variance.
std::string convergence_svg(const Study& study, const Analysis& analysis, const std::string& metric, TimeAxis axis);
} // namespace etendue
