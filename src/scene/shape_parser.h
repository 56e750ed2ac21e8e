// Shapes and lights of a scene file.
#pragma once

#include "scene/scene.h"
#include "util/json.h"

#include <string>
#include <vector>

namespace etendue
{
// Add the shapes and then the lights of the file to scene.shapes; scene.materials and scene.folder are there already. A
// light without a material gets a black one, added to the materials. Throws SceneError.
void parse_shapes(const std::vector<json::Value>& shapes, const std::vector<json::Value>& lights, Scene& scene);

// Index of a black diffuse material, added when there is none yet.
std::uint32_t black_material(Scene& scene);
} // namespace etendue
