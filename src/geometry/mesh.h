// Triangles in double precision, and how they come from polygons and go through a transform.
#pragma once

#include "math/vector.h"

#include <cstdint>
#include <string>
#include <vector>

namespace etendue
{
// Triangles, counter-clockwise as seen from where the normal points.
struct Mesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;                // empty: the mesh is flat
    std::vector<glm::u32vec3> indices;        // three positions per triangle
    std::vector<glm::u32vec3> normal_indices; // three normals per triangle, NO_INDEX for a flat one; empty: as indices
    std::vector<std::string> warnings;        // complete sentences

    // Indices into normals of a triangle's corners; NO_INDEX where it has none.
    glm::u32vec3 normals_of(std::size_t triangle) const;
};

// Faces as files write them: any number of corners, indices not checked yet.
struct PolygonMesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<std::uint32_t> sizes;          // corners of each face
    std::vector<std::uint32_t> corners;        // position indices from 0, face by face
    std::vector<std::uint32_t> normal_corners; // as corners, NO_INDEX where a face has no normals; empty: as corners
    std::vector<std::uint32_t> lines;          // line of each face in a text file; may be empty
    std::uint32_t first_index = 0;             // what the file calls the first vertex: 1 in OBJ, 0 in PLY
    std::vector<std::string> warnings;
};

// Cut each face into the fan of the first corner whose triangles all face the way the polygon does (the first corner,
// with a warning, where there is none). Throws FileError naming the file, face and index: an index that is out of
// range, fewer than three corners, a position that is not finite (allowed with lenient: its triangles are dropped
// later), no face at all.
Mesh triangulate(PolygonMesh&& polygons, const std::string& file, bool lenient);

// Place a mesh: positions by the matrix, normals by its inverse transpose, normalised (zero where that is impossible).
// A mirroring matrix turns the winding round, so that the sides stay what they were.
void transform_mesh(Mesh& mesh, const Mat4& matrix);
} // namespace etendue
