// The fuzzers' entries in the normal build: every input to start from, and every input that once broke a rule.
#include "support/fuzz_targets.h"

#include "util/file.h"

#include <catch2/catch.hpp>
#include <filesystem>

using namespace etendue;
namespace fs = std::filesystem;

namespace
{
using FuzzTarget = void (*)(std::string_view);

// Run every file of a folder of this target; the number of files.
int run_files(const std::string& folder, const std::string& name, FuzzTarget target)
{
    int count = 0;
    for (const auto& entry : fs::directory_iterator(ETENDUE_SOURCE_DIR "/tests/fuzz/" + folder + "/" + name)) {
        if (entry.path().filename() == ".gitkeep") continue;
        INFO(entry.path().string());
        CHECK_NOTHROW(target(read_file(entry.path().string())));
        ++count;
    }
    return count;
}
} // namespace

TEST_CASE("what the fuzzers found stays repaired", "[host]")
{
    CHECK(run_files("findings", "scene", fuzz_scene) >= 4);
    CHECK(run_files("findings", "obj", fuzz_obj) >= 1);
    run_files("findings", "ply", fuzz_ply);
}

TEST_CASE("a bad scene breaks no rule either", "[host]")
{
    for (const auto& entry : fs::directory_iterator(ETENDUE_SOURCE_DIR "/tests/bad_input")) {
        INFO(entry.path().string());
        CHECK_NOTHROW(fuzz_scene(read_file(entry.path().string())));
    }
}

TEST_CASE("no input of the fuzzers' corpus breaks a rule", "[host]")
{
    CHECK(run_files("corpus", "scene", fuzz_scene) >= 7);
    CHECK(run_files("corpus", "obj", fuzz_obj) >= 8);
    CHECK(run_files("corpus", "ply", fuzz_ply) >= 7);
}
