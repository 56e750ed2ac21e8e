// The shapes that are meshes by nature, before their transform.
#pragma once

#include "geometry/mesh.h"
#include "scene/scene.h"

namespace etendue
{
// Two triangles, normal +z.
Mesh make_mesh(const RectangleShape& rectangle);
// Twelve triangles, normals outward.
Mesh make_mesh(const BoxShape& box);
// As given; the scene's parser has checked the indices.
Mesh make_mesh(const InlineTriangles& triangles);
} // namespace etendue
