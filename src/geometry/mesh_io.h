// Mesh files.
#pragma once

#include "geometry/mesh.h"

#include <cstdint>
#include <string>

namespace etendue
{
struct MeshReadOptions {
    bool lenient = false;           // keep positions that are not finite
    std::uint64_t* bytes = nullptr; // where to add the size of the file
};

// Read a mesh in double precision. PLY (text or binary of either byte order) is told by its content, OBJ by its name.
// Faces with more than three corners are cut into triangles. Throws FileError that names the file and the line, byte
// or element.
Mesh read_mesh(const std::string& file, const MeshReadOptions& options = {});

// The same from bytes in memory; `file` is the name.
Mesh parse_mesh(std::string_view bytes, const std::string& file, bool lenient = false);
} // namespace etendue
