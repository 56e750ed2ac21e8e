// report.html: one page that says what a study found, then shows it.
#pragma once

#include "converge/analysis.h"
#include "converge/study.h"
#include "converge/study_pictures.h"

#include <string>
#include <vector>

namespace etendue
{
// Self-contained: plots are inline SVG, pictures data URIs. `pictures` are those of write_pictures, in `folder`.
std::string converge_report(const Study& study, const Analysis& analysis,
                            const std::vector<std::vector<StudyPicture>>& pictures, const std::string& folder);
} // namespace etendue
