// The scene format of the course that the project comes from: cam_config, light_config, materials, objects.
#pragma once

#include "scene/scene.h"
#include "util/json.h"

#include <string>
#include <vector>

namespace etendue
{
// A top-level cam_config or light_config tells.
bool is_course_scene(const json::Value& root);

// Missing keys have the course's defaults; unknown ones are listed in one warning. Mesh files are looked for in the
// scene's folder, in the working directory, and without leading "../" in every folder above both. Throws SceneError.
Scene parse_course_scene(const json::Value& root, const std::string& folder, std::vector<std::string>& warnings);
} // namespace etendue
