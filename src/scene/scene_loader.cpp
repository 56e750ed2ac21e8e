// From text to a checked Scene, whatever the format.
#include "scene/scene_loader.h"

#include "scene/importers/course.h"
#include "scene/scene_check.h"
#include "scene/scene_parser.h"
#include "util/file.h"
#include "util/json.h"
#include "util/sha256.h"

#include <filesystem>

namespace etendue
{
LoadedScene load_scene(const std::string& path, const std::vector<std::string>& overrides)
{
    return parse_scene(read_file(path, json::MAX_FILE_SIZE), path, overrides);
}

LoadedScene parse_scene(const std::string& text, const std::string& file, const std::vector<std::string>& overrides)
{
    const json::Document document(text, file, overrides);
    const json::Value root = document.root();
    if (!root.is_object()) root.fail("a scene is a JSON object { ... }, this is " + root.description());
    const std::string folder = std::filesystem::path(file).parent_path().string();

    LoadedScene loaded;
    if (is_course_scene(root))
        loaded.scene = parse_course_scene(root, folder, loaded.warnings);
    else
        loaded.scene = parse_native_scene(root, folder);
    loaded.scene.file = file;
    loaded.scene.folder = folder;
    loaded.scene.sha256 = sha256(document.canonical());
    for (std::string& warning : check_scene(loaded.scene)) loaded.warnings.push_back(std::move(warning));
    return loaded;
}
} // namespace etendue
