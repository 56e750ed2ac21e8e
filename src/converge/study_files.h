// Everything a study leaves behind.
#pragma once

#include "converge/analysis.h"
#include "converge/study.h"

#include <string>

namespace etendue
{
// Create the folder if it is not there. Throws FileError.
void make_study_folder(const std::string& folder);

// errors.csv, converge.json, converge.svg and .png (render only), converge_total.svg and .png, pictures, report.html.
// Throws FileError.
void write_study(const Study& study, const Analysis& analysis, const std::string& folder);
} // namespace etendue
