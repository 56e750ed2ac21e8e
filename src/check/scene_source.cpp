// Finding scenes on disk and in the executable.
#include "check/scene_source.h"

#include "util/error.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace etendue
{
namespace
{
const char* const EMBEDDED_FOLDER = "scenes/stiff";

std::string embedded_text(const std::string& file)
{
    const std::string name = std::filesystem::path(file).filename().string();
    for (const EmbeddedFile& scene : embedded_stiff_scenes())
        if (scene.name == name) return std::string(scene.text);
    throw FileError(file, "there is no such scene in the program.");
}

SceneSource source_of(const std::filesystem::path& path, bool is_embedded)
{
    return {path.stem().string(), path.generic_string(), is_embedded, {}};
}
} // namespace

LoadedScene SceneSource::load(const std::vector<std::string>& overrides) const
{
    if (text) return parse_scene(*text, file, overrides);
    return is_embedded ? parse_scene(embedded_text(file), file, overrides) : load_scene(file, overrides);
}

SceneSource SceneSource::neighbour(const std::string& file_name) const
{
    return source_of(std::filesystem::path(file).parent_path() / file_name, is_embedded);
}

std::vector<SceneSource> stiff_scenes()
{
    std::vector<SceneSource> scenes;
    for (const EmbeddedFile& scene : embedded_stiff_scenes())
        scenes.push_back(source_of(std::filesystem::path(EMBEDDED_FOLDER) / scene.name, true));
    return scenes;
}

std::vector<SceneSource> scenes_at(const std::string& path)
{
    if (!std::filesystem::exists(path)) throw FileError(path, "there is no such file or folder.");
    if (!std::filesystem::is_directory(path)) return {source_of(path, false)};
    std::vector<SceneSource> scenes;
    for (const auto& entry : std::filesystem::directory_iterator(path))
        if (entry.path().extension() == ".json") scenes.push_back(source_of(entry.path(), false));
    if (scenes.empty()) throw UsageError(fmt::format("The folder {} holds no scenes (*.json).", path));
    std::sort(scenes.begin(), scenes.end(), [](const SceneSource& a, const SceneSource& b) { return a.file < b.file; });
    return scenes;
}
} // namespace etendue
