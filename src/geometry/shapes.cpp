// Triangles of rectangles and boxes.
#include "geometry/shapes.h"

namespace etendue
{
Mesh make_mesh(const RectangleShape& rectangle)
{
    const double x = rectangle.size.x / 2, y = rectangle.size.y / 2;
    Mesh mesh;
    mesh.positions = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
    mesh.indices = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

Mesh make_mesh(const BoxShape& box)
{
    Mesh mesh;
    // Corner i has the upper x, y, z where bit 0, 1, 2 of i is set.
    for (unsigned i = 0; i < 8; ++i)
        mesh.positions.push_back(box.size * Vec3(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5));
    constexpr unsigned FACES[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& face : FACES) {
        mesh.indices.emplace_back(face[0], face[1], face[2]);
        mesh.indices.emplace_back(face[0], face[2], face[3]);
    }
    return mesh;
}

Mesh make_mesh(const InlineTriangles& triangles)
{
    Mesh mesh;
    mesh.positions = triangles.positions;
    mesh.normals = triangles.normals;
    mesh.indices = triangles.indices;
    return mesh;
}
} // namespace etendue
