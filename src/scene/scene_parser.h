// The native scene format: a JSON document as a Scene.
#pragma once

#include "scene/scene.h"
#include "util/json.h"

#include <string>

namespace etendue
{
// Read the whole scene; relative files are looked for in `folder`. Throws SceneError.
Scene parse_native_scene(const json::Value& root, const std::string& folder);
} // namespace etendue
