// Opening a scene file of any format.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace etendue
{
struct LoadedScene {
    Scene scene;
    std::vector<std::string> warnings; // complete sentences
};

// Read a file in the native or the course's format, told apart by content. An override is path=value (see
// util/json.h). Mesh files are looked for, not read. Throws SceneError, FileError, and UsageError for an override that
// is not path=value.
LoadedScene load_scene(const std::string& path, const std::vector<std::string>& overrides = {});

// The same from a text; `file` is what messages call it, and its folder is where relative files are.
LoadedScene parse_scene(const std::string& text, const std::string& file,
                        const std::vector<std::string>& overrides = {});
} // namespace etendue
