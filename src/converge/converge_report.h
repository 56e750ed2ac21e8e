// report.html: one page that says what a study found, then shows it.
#pragma once

#include "converge/analysis.h"
#include "converge/study.h"

#include <string>

namespace etendue
{
// Self-contained: plots are inline SVG, pictures data URIs.
std::string converge_report(const Study& study, const Analysis& analysis);
} // namespace etendue
