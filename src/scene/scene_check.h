// What no single key can say: rules about a scene as a whole, for every format.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace etendue
{
// Throws SceneError: an empty scene, a camera without a direction, paths that may never end. Returns warnings, complete
// sentences.
std::vector<std::string> check_scene(const Scene& scene);

// Whether anything emits light: a shape or the environment.
bool is_lit(const Scene& scene);
} // namespace etendue
