// PLY (the Stanford polygon format): text, and binary of either byte order, any types, order and extra properties.
#pragma once

#include "geometry/mesh.h"

#include <string>
#include <string_view>

namespace etendue
{
// Whether these bytes begin as a PLY file does.
bool is_ply(std::string_view bytes);

// Parse the bytes of a file: element vertex with x, y, z and perhaps nx, ny, nz; element face with a list of vertex
// indices. `file` is its name in messages. Counts are held against the size of the file before anything is allocated.
// Throws FileError naming file and line (header and text) or element and byte (binary).
PolygonMesh parse_ply(std::string_view bytes, const std::string& file);
} // namespace etendue
