// etendue replay as a user calls it, and the command that a render gives for its accidents.
#include "command/replay.h"

#include "compute/device.h"
#include "support/child_process.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <sstream>

#include <json/json.h>

using namespace etendue;
using Catch::Contains;

namespace
{
const std::string ETENDUE = ETENDUE_BINARY_DIR "/etendue";
const std::string SCENE = ETENDUE_SOURCE_DIR "/scenes/course-box/simple_native.json";

using Words = std::vector<std::string>;

// A room of 4 by 2 by 4 metres around (10, 21, 30) whose walls glow; seen from its middle along -z.
const char* const GLOWING_ROOM = R"({
    "camera": {"position": [10, 21, 30], "look_at": [10, 21, 0], "vertical_fov": 1},
    "film": {"size": [4, 4]}, "integrator": {"type": "bsdf", "max_depth": 3, "roulette": "off"},
    "materials": [{"name": "white paint", "type": "diffuse", "albedo": 0.9}],
    "shapes": [{"type": "box", "size": [4, 2, 4], "material": "white paint", "flip_normals": true,
                "emission": {"radiance": 1}, "transform": {"translate": [10, 21, 30]}}]})";

struct SceneFile {
    explicit SceneFile(const std::string& text) : path((folder.path() / "a room.json").string())
    {
        write_file(path, text);
    }
    TemporaryFolder folder;
    std::string path;
};

ChildResult replay_child(const std::string& scene, const Words& words)
{
    Words all{"replay", scene};
    all.insert(all.end(), words.begin(), words.end());
    return run_child(ETENDUE, all);
}

Json::Value parse(const std::string& text)
{
    Json::Value value;
    std::istringstream(text) >> value;
    return value;
}

bool has_double()
{
    return select_devices(list_devices(), "auto").front().has_double;
}
} // namespace

TEST_CASE("the command that replays a sample keeps what matters to the picture", "[command][replay]")
{
    Scene scene;
    scene.sampler.seed = 12;
    RenderArguments arguments;
    arguments.scene = "room.json";
    arguments.outputs = {"x.exr"};
    CHECK(replay_line(arguments, scene, {3, 4, 5}) == "etendue replay room.json --pixel 3,4 --sample 5 --seed 12");
    arguments.scene = "a room.json";
    arguments.samples = 9;
    arguments.overrides = {"film.size=[8,8]", "sampler.seed=3", "camera.note=it's"};
    arguments.size = "64x32";
    arguments.integrator = "bsdf";
    arguments.accelerator = "none";
    arguments.lenient = true;
    arguments.fast_math = true;
    arguments.device = "cpu";
    CHECK(replay_line(arguments, scene, {3, 4, 5}) ==
          "etendue replay 'a room.json' --pixel 3,4 --sample 5 --seed 12 --spp 9 --size 64x32 --integrator bsdf "
          "--accelerator none -D 'film.size=[8,8]' -D sampler.seed=3 -D 'camera.note=it'\\''s' --lenient --fast-math "
          "--device cpu");
}

TEST_CASE("replay prints places of the scene, in float and in double", "[command][replay]")
{
    const SceneFile file(GLOWING_ROOM);
    const ChildResult result = replay_child(file.path, {"--pixel", "2,2", "--sample", "1", "--json"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const Json::Value json = parse(result.output);
    CHECK(json["pixel"][0] == 2);
    CHECK(json["sample"] == 1);
    for (const char* precision : {"fp32", "fp64"}) {
        if (precision == std::string("fp64") && !has_double()) {
            CHECK(json["fp64"].isNull());
            continue;
        }
        const double u = precision == std::string("fp64") ? 0x1p-53 : 0x1p-24;
        const Json::Value& path = json[precision];
        INFO(path.toStyledString());
        CHECK(path["vertex_count"] == 4); // three scatterings
        REQUIRE(path["vertices"].size() == 4);
        const Json::Value& first = path["vertices"][0];
        // The wall two metres away.
        CHECK(first["distance"].asDouble() == Approx(2.0).epsilon(1e-3));
        CHECK(first["position"][0].asDouble() == Approx(10.0).margin(0.05));
        CHECK(first["position"][1].asDouble() == Approx(21.0).margin(0.05));
        CHECK(std::abs(first["position"][2].asDouble() - 28.0) < 64 * u);
        CHECK(first["geometric_normal"][2].asDouble() == 1.0);
        CHECK(first["error_bound"].asDouble() > 0.0);
        CHECK(first["error_bound"].asDouble() < 64 * u);
        CHECK(first["material"] == "white paint");
        CHECK(first["bsdf"] == "diffuse");
        CHECK(first["throughput"][0].asDouble() == Approx(0.9));
        // A cosine's density about the wall's normal.
        CHECK(first["its_pdf"].asDouble() ==
              Approx(first["next_direction"][2].asDouble() / std::numbers::pi).epsilon(1e-5));
        CHECK(path["vertices"][3]["goes_on"] == false);
        CHECK(path["radiance"][0].asDouble() == Approx(1.0 + 0.9 + 0.81 + 0.729));
    }
    if (has_double()) {
        CHECK(json["parts_at"].isNull());
        CHECK(json["largest_difference"]["value"].asDouble() > 0.0);
        CHECK(json["largest_difference"]["value"].asDouble() < 1e-3);
    }

    const ChildResult text = replay_child(file.path, {"--pixel", "2,2", "--sample", "1"});
    CHECK(text.exit_code == 0);
    CHECK_THAT(text.output, Contains("pixel 2,2 sample 1 seed 0") && Contains("\nvertex 0\n") &&
                                Contains("\nvertex 3\n") && Contains("diffuse material \"white paint\"") &&
                                Contains("error bound"));
    CHECK_THAT(text.output, has_double() ? Contains("The paths meet the same primitives; the largest relative")
                                         : Contains("no double precision"));
}

TEST_CASE("options of the picture change the replayed path", "[command][replay]")
{
    const auto radiance = [](const Words& words) {
        Words all{"--pixel", "4,5", "--sample", "0", "--json"};
        all.insert(all.end(), words.begin(), words.end());
        const ChildResult result = replay_child(SCENE, all);
        INFO(result.errors);
        REQUIRE(result.exit_code == 0);
        return parse(result.output)["fp32"]["vertices"][0]["position"][0].asDouble();
    };
    const double plain = radiance({"--size", "8x8"});
    CHECK(radiance({"-D", "film.size=[8,8]"}) == plain);
    CHECK(radiance({"--size", "8x8", "--seed", "1"}) != plain);
    CHECK(radiance({"--size", "16x16"}) != plain);
}

TEST_CASE("a replay that cannot be is refused", "[command][replay]")
{
    const auto refused = [](const Words& words, int code, const std::string& message) {
        const ChildResult result = replay_child(SCENE, words);
        INFO(result.errors);
        CHECK(result.exit_code == code);
        CHECK(result.output.empty());
        CHECK_THAT(result.errors, Contains(message));
    };
    refused({"--pixel", "8,0", "--sample", "0", "--size", "8x8"}, 1, "--pixel 8,0 is outside the film of 8x8 pixels.");
    refused({"--pixel", "-1,0", "--sample", "0", "--size", "8x8"}, 1, "outside the film");
    refused({"--pixel", "1", "--sample", "0"}, 1, "--pixel must be X,Y");
    refused({"--pixel", "1,1", "--sample", "-3"}, 1, "must be a whole number");
    refused({"--pixel", "1,1"}, 1, "--sample");
    refused({"--pixel", "1,1", "--sample", "0", "--integrator", "normals"}, 1, "normals");
}

TEST_CASE("a render's first accident of each kind comes with the command that replays it", "[command][replay]")
{
    // Between white walls roulette ends no path, so that each becomes too long.
    const SceneFile file(GLOWING_ROOM);
    const std::string report = (file.folder.path() / "r.json").string();
    const ChildResult rendered =
        run_child(ETENDUE, {"render", file.path, "-o", (file.folder.path() / "x.png").string(), "--spp", "1", "--size",
                            "2x1", "-D", "materials.0.albedo=1", "-D", "integrator.max_depth=\"unlimited\"", "-D",
                            "integrator.roulette=\"throughput\"", "--lenient", "--report", report});
    INFO(rendered.errors);
    REQUIRE(rendered.exit_code == 0);
    const Json::Value health = parse(read_file(report))["health"]["path_too_long"];
    REQUIRE(health["count"] == 2);
    const std::string line = health["replay"].asString();
    CHECK_THAT(line, Contains("--pixel 0,0 --sample 0 --seed 0") && Contains(" --lenient") &&
                         Contains("-D materials.0.albedo=1 -D 'integrator.max_depth=\"unlimited\"'"));
    CHECK_THAT(rendered.errors, Contains(line));

    const ChildResult replayed = run_child("/bin/sh", {"-c", ETENDUE_BINARY_DIR "/" + line});
    INFO(line << '\n' << replayed.errors);
    CHECK(replayed.exit_code == 0);
    CHECK_THAT(replayed.output, Contains("fp32 counts as zero because of path_too_long") &&
                                    Contains("\nvertex 1023\n") && Contains("and 64512 more vertices"));
}
