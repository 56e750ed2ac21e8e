// The pictures of a study: what was rendered, against what, and where they differ.
#pragma once

#include "converge/study.h"

#include <string>
#include <vector>

namespace etendue
{
struct StudyPicture {
    std::string caption;
    std::string file; // within the folder
    int width = 0, height = 0;
};

// Write, for each configuration that has finished a run, the mean over its seeds as EXR and PNG, the reference, the
// signed error and the p-values of the tiles as PNG; returns the PNG files by configuration. Throws FileError.
std::vector<std::vector<StudyPicture>> write_pictures(const Study& study, const std::string& folder);
} // namespace etendue
