// Wavefront OBJ: the statements v, vn and f; colours, texture coordinates, groups, materials, lines and points are
// skipped.
//
// Our own reader, because the well-known ones read "nan" as 0 and "1,5" as 1 without a word, or keep floats only.
#pragma once

#include "geometry/mesh.h"

#include <string>
#include <string_view>

namespace etendue
{
// Parse the text of a file. `file` is its name in messages. Faces may have any number of corners, written i, i/j, i//k
// or i/j/k, with negative numbers counting back from the last vertex so far. Throws FileError naming file and line.
PolygonMesh parse_obj(std::string_view text, const std::string& file);
} // namespace etendue
