// report.json and the metadata of pictures.
#include "render/report.h"
#include "scene/scene_loader.h"

#include <catch2/catch.hpp>

#include <limits>
#include <sstream>

#include <json/json.h>

using namespace etendue;

namespace
{
const char* const SCENE = R"({
    "film": {"size": [4, 4]},
    "sampler": {"type": "sobol", "seed": 9007199254740993},
    "materials": [{"name": "grey", "type": "diffuse", "albedo": 0.5}],
    "shapes": [{"type": "box", "size": [1, 1, 1], "material": "grey"}],
    "lights": [{"type": "sphere", "radius": 0.1, "radiance": 1, "transform": {"translate": [0, 2, 0]}}]
})";

DeviceReport device_report(const std::string& name)
{
    DeviceReport device;
    device.info.name = name;
    device.info.platform_name = "Platform";
    device.info.platform_version = "OpenCL 3.0";
    device.info.driver_version = "7.5";
    device.info.device_version = "OpenCL 1.2";
    device.info.type = "cpu";
    device.info.global_memory = std::uint64_t{1} << 40;
    device.info.max_allocation = 1000;
    device.compute_units = 2;
    device.specialization.lanes = 8;
    device.specialization.stack_size = 64;
    device.specialization.set(Feature::SPHERE);
    BuildReport build;
    build.program = "path_megakernel.cl";
    build.options = "-DLANES=8";
    build.log = "a remark";
    build.from_cache = true;
    build.seconds = 0.5;
    build.source_bytes = 10;
    build.binary_bytes = 20;
    device.builds = {build};
    device.canary = {false, {{"fma", true, "0 of 8"}, {"division", false, "errs"}}, true, 0.25};
    device.bvh = {13, 12, 13, 5, std::numeric_limits<double>::infinity(), true, {{"sort", 0.25}, {"sort", 0.5}}};
    device.upload_seconds = 0.125;
    device.first_launch_seconds = 0.75;
    device.units = 3;
    device.samples = 640;
    device.memory.peak = 300;
    device.memory.buffers = {{"primitives", 200}, {"lights", 100}};
    return device;
}

struct Rendered {
    Scene scene = parse_scene(SCENE, "scenes/report.json").scene;
    Geometry geometry = make_geometry(scene);
    RenderReport report;
    Phases phases{{"parse", 0.5}, {"render", 2.0}};

    Rendered()
    {
        report.devices = {device_report("First"), device_report("Second")};
        report.samples_per_pixel = 40;
        report.error_estimate = ErrorEstimate::halves;
        report.render_seconds = 2.0;
        report.counts = {100, 200, 300, 30, 40};
        report.health[HEALTH_NEGATIVE_PDF] = {4, AccidentPlace{std::uint64_t{1} << 33, 3, 2, 1}, "etendue replay x"};
        report.precision = Precision::fp64;
        report.warnings = {"First warning."};
        geometry.warnings = {"Second warning."};
    }
};

Json::Value parse(const std::string& text)
{
    Json::Value value;
    std::istringstream(text) >> value;
    return value;
}

Json::Value json_of(const Rendered& r, double relative_error = 0.25)
{
    return parse(report_json(r.scene, r.geometry, r.report, r.phases, relative_error, "etendue render x"));
}
} // namespace

TEST_CASE("the report has everything about the render as a whole")
{
    const Rendered rendered;
    const Json::Value json = json_of(rendered);
    CHECK(json["etendue"].asString() == ETENDUE_VERSION);
    CHECK(json["command"].asString() == "etendue render x");
    CHECK(json["seed"].asUInt64() == 9007199254740993u);
    CHECK(json["samples_per_pixel"].asUInt64() == 40);
    CHECK(json["interrupted"] == Json::Value(false));
    CHECK(json["relative_error"].asDouble() == 0.25);
    CHECK(json["sampler"].asString() == "sobol");
    CHECK(json["error_estimate"].asString() == "halves");
    CHECK_FALSE(json.isMember("error_target"));
    CHECK(json["precision"] == "fp64");
    CHECK(json["accelerator"].asString() == "lbvh");
    CHECK(json["seconds"]["parse"].asDouble() == 0.5);
    CHECK(json["seconds"]["render"].asDouble() == 2.0);
    CHECK(json["warnings"] == parse(R"(["First warning.", "Second warning."])"));
    CHECK(json["rays"] == parse(R"({"camera": 100, "indirect": 200, "shadow": 300, "total": 600, "per_second": 300.0,
                                    "busy_lanes": 0.75})"));
    const Json::Value& scene = json["scene"];
    CHECK(scene["file"].asString() == "scenes/report.json");
    CHECK(scene["sha256"].asString() == rendered.scene.sha256);
    CHECK(scene["sha256"].asString().size() == 64);
    CHECK(scene["format"].asString() == "native");
    CHECK(scene["triangles"] == 12);
    CHECK(scene["spheres"] == 1);
    CHECK(scene["disks"] == 0);
    CHECK(scene["lights"] == 1);
    for (const char* member : {"materials", "mesh_bytes", "dropped_triangles"}) CHECK(scene[member].isUInt64());
    CHECK(scene["normalisation"]["scale"].asDouble() == rendered.geometry.normalisation.scale);
    CHECK(scene["normalisation"]["centre"].size() == 3);
}

TEST_CASE("every device has its own part of the report")
{
    const Json::Value devices = json_of(Rendered())["devices"];
    REQUIRE(devices.size() == 2);
    CHECK(devices[1]["name"].asString() == "Second");
    const Json::Value& device = devices[0];
    CHECK(device["name"].asString() == "First");
    CHECK(device["platform"].asString() == "Platform");
    CHECK(device["platform_version"].asString() == "OpenCL 3.0");
    CHECK(device["driver_version"].asString() == "7.5");
    CHECK(device["device_version"].asString() == "OpenCL 1.2");
    CHECK(device["type"].asString() == "cpu");
    CHECK(device["compute_units"] == 2);
    CHECK(device["lanes"] == 8);
    CHECK(device["stack_size"] == 64);
    CHECK(device["samples"].asUInt64() == 640);
    CHECK(device["launches"].asUInt64() == 3);
    CHECK(device["features"]["in"] == parse(R"(["sphere"])"));
    CHECK(device["features"]["out"].size() == static_cast<unsigned>(Feature::COUNT) - 1);
    CHECK(device["seconds"]["upload"].asDouble() == 0.125);
    CHECK(device["seconds"]["first_launch"].asDouble() == 0.75);
    for (const char* phase : {"bvh", "compile", "render"}) CHECK(device["seconds"][phase].isDouble());
    CHECK(device["builds"] == parse(R"([{"program": "path_megakernel.cl", "options": "-DLANES=8", "log": "a remark",
        "from_cache": true, "stored_in_cache": false, "seconds": 0.5, "source_bytes": 10, "binary_bytes": 20}])"));
}

TEST_CASE("every device tells what its canary found")
{
    const Json::Value canary = json_of(Rendered())["devices"][0]["canary"];
    CHECK_FALSE(canary["passed"].asBool());
    CHECK(canary["from_cache"].asBool());
    CHECK(canary["seconds"].asDouble() == 0.25);
    REQUIRE(canary["findings"].size() == 2);
    CHECK(canary["findings"][0]["name"] == "fma");
    CHECK(canary["findings"][0]["passed"].asBool());
    CHECK_FALSE(canary["findings"][1]["passed"].asBool());
    CHECK(canary["findings"][1]["detail"] == "errs");
}

TEST_CASE("relaxed floating point is named in the report and in the picture, strict is not")
{
    Rendered rendered;
    CHECK_FALSE(json_of(rendered)["fast_math"].asBool());
    CHECK(image_metadata(rendered.scene, rendered.report, {}).count("etendue:fast_math") == 0);
    rendered.report.fast_math = true;
    CHECK(json_of(rendered)["fast_math"].asBool());
    CHECK(image_metadata(rendered.scene, rendered.report, {}).at("etendue:fast_math").rfind("yes", 0) == 0);
}

TEST_CASE("the report has the tree's statistics and what each kernel of it took")
{
    // What is not finite is not known; the times of one name add up.
    CHECK(json_of(Rendered())["devices"][0]["bvh"] ==
          parse(R"({"primitives": 13, "nodes": 12, "leaves": 13, "depth": 5, "sah_cost": null, "built_on": "device",
                    "seconds": {"sort": 0.75}})"));
}

TEST_CASE("the report sets the memory of each buffer against the device's limits")
{
    CHECK(json_of(Rendered())["devices"][0]["memory"] ==
          parse(R"({"peak_bytes": 300, "global_bytes": 1099511627776, "max_allocation_bytes": 1000,
                    "buffers": [{"name": "primitives", "bytes": 200}, {"name": "lights", "bytes": 100}]})"));
}

TEST_CASE("every health counter is in the report, with the first place of what happened")
{
    const Json::Value health = json_of(Rendered())["health"];
    REQUIRE(health.size() == HEALTH_KINDS);
    for (std::size_t kind = 0; kind < HEALTH_KINDS; ++kind) {
        INFO(health_name(kind));
        if (kind != HEALTH_NEGATIVE_PDF) CHECK(health[health_name(kind)] == parse(R"({"count": 0})"));
    }
    CHECK(health["negative_pdf"] == parse(R"({"count": 4, "first": {"pixel": [3, 2], "sample": 8589934592, "vertex": 1},
                                             "replay": "etendue replay x"})"));
}

TEST_CASE("an unknown error is null, and the report stays JSON")
{
    const Json::Value json = json_of(Rendered(), std::numeric_limits<double>::infinity());
    CHECK(json.isMember("relative_error"));
    CHECK(json["relative_error"].isNull());
}

TEST_CASE("the report says how a wanted error was estimated and how well it is known")
{
    const Rendered r;
    ErrorTarget::Report target{0.25, 0.9, true, 7, {0.125, 0.0625, 0.1875, 0.75}};
    const auto json_with = [&] {
        return parse(report_json(r.scene, r.geometry, r.report, r.phases, 0.125, "etendue render x", target));
    };
    CHECK(json_with()["error_target"] ==
          parse(R"({"wanted": 0.25, "reached": true, "looks": 7, "confidence": 0.9, "relative_error": 0.125,
                    "low": 0.0625, "high": 0.1875, "top_share": 0.75, "heavy_tail": true})"));
    target.error.high = std::numeric_limits<double>::infinity();
    target.error.top_share = 0.5;
    CHECK(json_with()["error_target"]["high"].isNull());
    CHECK(json_with()["error_target"]["heavy_tail"] == Json::Value(false));
}

TEST_CASE("a picture knows where it comes from")
{
    Rendered rendered;
    const auto metadata = image_metadata(rendered.scene, rendered.report, rendered.phases);
    CHECK(metadata.at("etendue:version") == ETENDUE_VERSION);
    CHECK(metadata.at("etendue:scene") == "scenes/report.json");
    CHECK(metadata.at("etendue:scene_sha256") == rendered.scene.sha256);
    CHECK(metadata.at("etendue:seed") == "9007199254740993");
    CHECK(metadata.at("etendue:precision") == "fp64");
    CHECK(metadata.at("etendue:spp") == "40");
    CHECK(metadata.at("etendue:sampler") == "sobol");
    CHECK(metadata.at("etendue:error_estimate") == "halves");
    CHECK(metadata.at("etendue:device") == "First, Second");
    CHECK(metadata.at("etendue:driver") == "OpenCL 3.0 / 7.5, OpenCL 3.0 / 7.5");
    CHECK(metadata.at("etendue:seconds") == "parse 0.500000, render 2.000000");
    CHECK(metadata.at("etendue:accidents") == "4");
    CHECK(metadata.at("etendue:interrupted") == "no");
    rendered.report.interrupted = true;
    CHECK(image_metadata(rendered.scene, rendered.report, {}).at("etendue:interrupted") == "yes");
}
