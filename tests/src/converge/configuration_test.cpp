// Configurations from text, along axes, and as scenes of both formats.
#include "converge/configuration.h"

#include "util/error.h"

#include <catch2/catch.hpp>

using namespace etendue;
using Catch::Contains;

namespace
{
const std::string COURSE_SCENE = ETENDUE_SOURCE_DIR "/scenes/course-box/simple.json";
const std::string NATIVE_SCENE = ETENDUE_SOURCE_DIR "/scenes/furnace/furnace.json";

std::vector<std::string> names_of(const std::vector<Configuration>& configurations)
{
    std::vector<std::string> names;
    for (const Configuration& configuration : configurations) names.push_back(configuration.name);
    return names;
}
} // namespace

TEST_CASE("a configuration has a name, overrides of the scene and settings of the renderer", "[converge]")
{
    const Configuration c = parse_configuration(
        R"(a-1:integrator.type=bsdf,film.size=[8,6],name={"x": "1,2"},render.specialize=off,render.lanes=4,)"
        "render.device=cpu,render.precision=fp64,render.fast_math=on");
    CHECK(c.name == "a-1");
    CHECK(c.overrides == std::vector<std::string>{"integrator.type=bsdf", "film.size=[8,6]", R"(name={"x": "1,2"})"});
    CHECK_FALSE(c.specialize);
    CHECK(c.lanes == 4);
    CHECK(c.device == "cpu");
    CHECK(c.precision == "fp64");
    CHECK(c.fast_math);
    CHECK(parse_configuration(c.text()).text() == c.text());

    CHECK(parse_configuration("plain").overrides.empty());
    CHECK(parse_configuration("plain:").specialize);
}

TEST_CASE("configurations that cannot be are refused with what is wrong with them", "[converge]")
{
    CHECK_THROWS_WITH(parse_configuration("a b:x=1"), Contains("does not begin with a name"));
    CHECK_THROWS_WITH(parse_configuration(":x=1"), Contains("does not begin with a name"));
    CHECK_THROWS_WITH(parse_configuration("a:x"), Contains("has \"x\" without path="));
    CHECK_THROWS_WITH(parse_configuration("a:x=1,,y=2"), Contains("has \"\" without path="));
    CHECK_THROWS_WITH(parse_configuration("a:render.specialise=off"), Contains("render.specialize"));
    CHECK_THROWS_WITH(parse_configuration("a:render.specialize=no"), Contains("must be on or off, is \"no\""));
    CHECK_THROWS_WITH(parse_configuration("a:render.lanes=3"), Contains("0, 1, 4, 8 or 16, is \"3\""));
    CHECK_THROWS_WITH(parse_configuration("a:render.precision=half"), Contains("single or fp64, is \"half\""));
    CHECK_THROWS_WITH(check_names({parse_configuration("a"), parse_configuration("b"), parse_configuration("a")}),
                      Contains("Two configurations are called \"a\""));
}

TEST_CASE("every axis gives its configurations", "[converge]")
{
    Scene scene;
    const auto along = [&](const std::string& axis) { return names_of(configurations_along(axis, scene, {})); };
    CHECK(along("integrators") == std::vector<std::string>{"hemisphere", "bsdf", "light", "path"});
    CHECK(along("heuristics") == std::vector<std::string>{"power", "balance"});
    CHECK(configurations_along("heuristics", scene, {})[1].text() ==
          "balance:integrator.type=path,integrator.heuristic=balance");
    CHECK(along("sphere_lights") == std::vector<std::string>{"cone", "area"});
    CHECK(along("roulette") == std::vector<std::string>{"off", "constant", "throughput"});
    CHECK(along("accelerators") == std::vector<std::string>{"none", "lbvh"});
    CHECK(along("specialization") == std::vector<std::string>{"specialised", "general"});
    CHECK(along("precision") == std::vector<std::string>{"single", "fp64"});
    CHECK(along("fast_math") == std::vector<std::string>{"strict", "fast-math"});
    CHECK_FALSE(along("samplers").empty());
    CHECK_THROWS_WITH(along("integrator"), Contains("integrators"));
    // Nothing else would end the paths.
    scene.integrator.max_depth.reset();
    CHECK(along("roulette") == std::vector<std::string>{"constant", "throughput"});

    DeviceInfo device;
    device.index = 3;
    const auto devices = configurations_along("devices", scene, {device});
    REQUIRE(devices.size() == 1);
    CHECK(devices[0].device == "3");
}

TEST_CASE("settings are overridden in scenes of both formats alike", "[converge]")
{
    for (const std::string& file : {COURSE_SCENE, NATIVE_SCENE}) {
        INFO(file);
        const Scene plain = load_configured(file, {}).scene;
        const Scene scene = load_configured(file, {"integrator.type=light", "integrator.roulette=constant",
                                                   "/sampler/seed=7", "accelerator=lbvh"})
                                .scene;
        CHECK(scene.integrator.type == IntegratorType::light);
        CHECK(scene.integrator.roulette == RouletteType::constant);
        CHECK(scene.integrator.max_depth == plain.integrator.max_depth);
        CHECK(scene.sampler.seed == 7);
        CHECK(scene.sampler.samples_per_pixel == plain.sampler.samples_per_pixel);
        CHECK(scene.accelerator.type == ACCELERATOR_LBVH);
        CHECK(scene.shapes.size() == plain.shapes.size());
        CHECK(scene.sha256 != plain.sha256);
    }
    // What the course's format has itself is overridden as ever.
    CHECK(load_configured(COURSE_SCENE, {"max_depth=3", "integrator.type=bsdf"}).scene.integrator.max_depth == 3u);
    CHECK_THROWS_AS(load_configured(COURSE_SCENE, {"integrator.type=bidirectional"}), SceneError);
}
