// Scenes that judge themselves like those of scenes/stiff, but are too large to be files: they are written when run.
#pragma once

#include "check/check.h"

#include <vector>

namespace etendue
{
// All long: 99,856 lights, 65,536 triangles in one place, 65,536 with one centroid.
std::vector<Check> large_scene_checks();
} // namespace etendue
