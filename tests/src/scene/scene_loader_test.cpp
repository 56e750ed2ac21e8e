// Whole files: the scenes that come with the project, every file of tests/bad_input, and thousands of damaged ones.
#include "scene/scene_loader.h"
#include "util/file.h"

#include <filesystem>
#include <random>

using namespace etendue;
namespace fs = std::filesystem;

namespace
{
const std::string SCENES = ETENDUE_SOURCE_DIR "/scenes/";

std::string message_of(const std::string& text, const std::string& file, const std::vector<std::string>& overrides = {})
{
    try {
        parse_scene(text, file, overrides);
    } catch (const Error& e) {
        return std::string(e.what()) + "\n";
    }
    return "no error\n";
}

// One byte or stretch of the text changed, added, removed or copied.
std::string damage(std::string text, std::mt19937& random)
{
    const auto position = [&] { return random() % (text.size() + 1); };
    const std::string bytes = "{}[]\",:.-+eE0123456789/*\\ \n\0\x80\xff"
                              "nt";
    for (std::size_t n = 1 + random() % 3; n > 0 && !text.empty(); --n) {
        const std::size_t at = position();
        switch (random() % 5) {
        case 0:
            text.insert(at, 1, bytes[random() % bytes.size()]);
            break;
        case 1:
            text.erase(at, 1 + random() % 8);
            break;
        case 2:
            text.insert(at, text.substr(position(), random() % 40));
            break;
        case 3:
            text.resize(at);
            break;
        default:
            text.replace(at, 1, 1, static_cast<char>(random()));
        }
    }
    return text;
}
} // namespace

TEST_CASE("every file of tests/bad_input gives exactly its message", "[host]")
{
    const fs::path folder = ETENDUE_SOURCE_DIR "/tests/bad_input";
    int count = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".json") continue;
        const std::string name = entry.path().filename().string();
        const std::string expected = read_file(fs::path(entry.path()).replace_extension(".txt").string());
        CHECK(message_of(read_file(entry.path().string()), "bad_input/" + name) == expected);
        ++count;
    }
    CHECK(count > 80);
}

TEST_CASE("the scenes of the project load without a warning", "[host]")
{
    for (const char* name : {"course-box/simple_native.json", "glass/glass.json", "furnace/furnace.json",
                             "environment/environment.json"}) {
        INFO(name);
        const LoadedScene loaded = load_scene(SCENES + name);
        CHECK(loaded.warnings.empty());
        CHECK_FALSE(loaded.scene.course_format);
        CHECK(loaded.scene.file == SCENES + name);
        CHECK(loaded.scene.shapes.size() >= 1);
    }
    // The knot is made by a script: put a box in its place.
    const LoadedScene room =
        load_scene(SCENES + "large-mesh/room.json", {R"(shapes.5={"type": "box", "material": "clay"})"});
    CHECK(room.scene.shapes.size() == 7);
}

TEST_CASE("the example of FORMAT.md is a scene without a warning", "[host]")
{
    const std::string text = read_file(SCENES + "FORMAT.md"), mark = "```json\n";
    const std::size_t start = text.find(mark) + mark.size();
    const LoadedScene loaded = parse_scene(text.substr(start, text.find("```", start) - start), "FORMAT.md");
    CHECK(loaded.warnings.empty());
    CHECK(loaded.scene.shapes.size() == 3);
}

TEST_CASE("the walls of the furnace face inwards", "[host]")
{
    const Scene scene = load_scene(SCENES + "furnace/furnace.json").scene;
    const auto& mesh = std::get<InlineTriangles>(scene.shapes[0].geometry);
    REQUIRE(mesh.indices.size() == 12);
    double area = 0.0;
    for (const glm::u32vec3& t : mesh.indices) {
        const Vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        const Vec3 normal = glm::cross(b - a, c - a);
        CHECK(glm::dot(normal, -(a + b + c)) > 0.0);
        area += 0.5 * glm::length(normal);
    }
    CHECK(area == 24.0);
}

TEST_CASE("an override gives the scene of the edited file", "[host]")
{
    const std::string before = R"({"film": {"size": [8, 8]}, "environment": {"radiance": 1}})";
    const std::string after = R"({"environment": {"radiance": 1}, "film": {"size": [4, 2]}, "sampler": {"spp": 3}})";
    const Scene overridden = parse_scene(before, "a.json", {"film.size=[4,2]", "sampler.spp=3"}).scene;
    const Scene edited = parse_scene(after, "b.json").scene;
    CHECK(overridden.film.width == 4);
    CHECK(overridden.sampler.samples_per_pixel == 3);
    CHECK(overridden.sha256 == edited.sha256);
    CHECK(overridden.sha256 != parse_scene(before, "a.json").scene.sha256);
    CHECK(edited.sha256.size() == 64);
}

TEST_CASE("an override is checked like the scene", "[host]")
{
    const std::string scene = R"({"environment": {"radiance": 1}})";
    CHECK(message_of(scene, "a.json", {"film.size=[0,64]"}) ==
          "command line: /film/size/0: must be between 1 and 65536, is 0\n  -D film.size=[0,64]\n                ^\n");
    CHECK(
        message_of(scene, "a.json", {"film.siz=3"}) ==
        "command line: /film/siz: unknown film key \"siz\"; did you mean \"size\"? there are: size, filter, tone_map, "
        "exposure\n  -D film.siz=3\n              ^\n");
    CHECK(message_of(scene, "a.json", {"integrator=pat"}) ==
          "command line: /integrator: unknown integrator type \"pat\"; did you mean \"path\"? there are: normals, "
          "hemisphere, bsdf, light, path\n  -D integrator=pat\n                ^\n");
}

TEST_CASE("a missing scene and a directory say so", "[host]")
{
    CHECK_THROWS_WITH(load_scene("no/such/scene.json"), "no/such/scene.json: there is no such file.");
    CHECK_THROWS_WITH(load_scene(SCENES), SCENES + ": this is a directory, not a file.");
}

TEST_CASE("a damaged scene is a scene or an error, never a crash", "[host]")
{
    const std::string native = read_file(SCENES + "glass/glass.json");
    const std::string course = read_file(SCENES + "course-box/simple.json");
    std::mt19937 random(20240229);
    int scenes = 0, errors = 0;
    for (int i = 0; i < 4000; ++i) {
        const std::string text = damage(i % 2 ? native : course, random);
        try {
            parse_scene(text, SCENES + "course-box/damaged.json");
            ++scenes;
        } catch (const Error& e) {
            ++errors;
            if (std::string(e.what()).size() > 4000) FAIL_CHECK("the message is too long: " << e.what());
        }
    }
    CHECK(scenes + errors == 4000);
    CHECK(scenes > 50);
    CHECK(errors > 2000);
}
