// scenes/stiff is what scripts/gen_stiff writes, and every one of its scenes says what it must look like.
#include "check/scene_checks.h"
#include "support/child_process.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <set>

using namespace etendue;

namespace
{
const std::string SCRIPT = ETENDUE_SOURCE_DIR "/scripts/gen_stiff";
const std::string FOLDER = ETENDUE_SOURCE_DIR "/scenes/stiff";
} // namespace

TEST_CASE("the stiff scenes are what their generator writes, byte for byte", "[host]")
{
    const TemporaryFolder folder;
    const ChildResult written = run_child(SCRIPT, {folder.path().string()});
    INFO(written.errors);
    REQUIRE(written.exit_code == 0);
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        const std::string name = entry.path().filename().string();
        names.insert(name);
        INFO(name);
        CHECK(read_file(entry.path().string()) == read_file(FOLDER + "/" + name));
    }
    for (const auto& entry : std::filesystem::directory_iterator(FOLDER))
        CHECK(names.contains(entry.path().filename().string()));
}

TEST_CASE("the generator finds a scene that somebody has edited, removed or added", "[host]")
{
    const TemporaryFolder folder;
    const std::string path = folder.path().string();
    REQUIRE(run_child(SCRIPT, {path}).exit_code == 0);
    CHECK(run_child(SCRIPT, {"--check", path}).exit_code == 0);
    write_file(path + "/F5-depth-8.json", "{}");
    CHECK(run_child(SCRIPT, {"--check", path}).exit_code == 1);
    REQUIRE(run_child(SCRIPT, {path}).exit_code == 0);
    std::filesystem::remove(path + "/F5-depth-8.json");
    CHECK(run_child(SCRIPT, {"--check", path}).exit_code == 1);
    REQUIRE(run_child(SCRIPT, {path}).exit_code == 0);
    write_file(path + "/mine.json", "{}");
    CHECK(run_child(SCRIPT, {"--check", path}).exit_code == 1);
}

TEST_CASE("the executable holds the stiff scenes, and each is a check of its own name", "[host]")
{
    const std::vector<SceneSource> sources = stiff_scenes(), files = scenes_at(FOLDER);
    REQUIRE(sources.size() == files.size());
    std::set<std::string> names;
    for (const SceneSource& source : sources) {
        INFO(source.file);
        const std::optional<Check> check = scene_check(source);
        REQUIRE(check.has_value());
        CHECK(names.insert(check->name).second);
        CHECK(source.load().scene.sha256 ==
              scenes_at(FOLDER + "/" + source.name + ".json").front().load().scene.sha256);
    }
}
