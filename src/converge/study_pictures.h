// The pictures of a study: what was rendered, against what, and where they differ.
#pragma once

#include "converge/study.h"
#include "util/html.h"

#include <string>
#include <vector>

namespace etendue
{
// The mean over the seeds, the reference, the signed error and the p-values of the tiles; nothing before a run is
// complete.
std::vector<HtmlPicture> study_pictures(const StudiedConfiguration& studied);

// Write the means over the seeds as NAME.exr and the references as NAME_reference.exr, with stderr.R/G/B. Throws
// FileError.
void write_study_images(const Study& study, const std::string& folder);
} // namespace etendue
