// One launch: samples, sums, counters and accidents, in scenes whose every sample is known.
#include "render/megakernel.h"
#include "render/render_settings.h"
#include "render/scene_features.h"
#include "scene/scene_loader.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

using namespace etendue;

namespace
{
// Behind everything a sky of radiance (1.5, 2, 0.25), in front of the lower half of the picture a dark rectangle: its
// top edge is exactly between the second and the third of four rows.
const char* const SCENE = R"({
    "camera": {"position": [0, 0, 4], "look_at": [0, 0, 0], "vertical_fov": 30},
    "film": {"size": [6, 4]},
    "integrator": {"type": "path", "max_depth": 0},
    "materials": [{"name": "grey", "type": "diffuse", "albedo": 0.5}],
    "shapes": [{"type": "rectangle", "size": [40, 20], "material": "grey", "transform": {"translate": [0, -10, 0]}}],
    "environment": {"radiance": [1.5, 2, 0.25]}
})";

struct Launch {
    std::vector<PixelBlock> blocks;
    std::vector<PixelAov> aovs;
    LaunchCounters counters;
};

// A device with the scene, its geometry changed by `change`, and its kernels.
struct Bench {
    Bench(
        const Device& d, bool aov, const LaunchShape& shape = {}, void (*change)(Geometry&) = [](Geometry&) {})
        : device(d), scene(parse_scene(SCENE, "launch.json").scene), geometry(make_geometry(scene)), has_aov(aov)
    {
        change(geometry);
        settings = make_render_settings(scene, geometry, ACCELERATOR_BRUTE_FORCE);
        device_scene = std::make_unique<DeviceScene>(device, geometry, settings, BvhPlace::host, KernelCache::none());
        const Specialization s = scene_features(scene, geometry, settings, has_aov, device.preferred_lanes(), 0);
        kernel = std::make_unique<Megakernel>(device, false, s, KernelCache::none(), shape);
    }

    Launch trace(const WorkUnit& unit)
    {
        Launch launch;
        launch.blocks.resize(std::size_t{unit.tile_width} * unit.tile_height);
        if (has_aov) launch.aovs.resize(launch.blocks.size());
        launch.counters = kernel->trace(*device_scene, unit, launch.blocks, launch.aovs);
        return launch;
    }

    const Device& device;
    Scene scene;
    Geometry geometry;
    RenderSettings settings{};
    std::unique_ptr<DeviceScene> device_scene;
    std::unique_ptr<Megakernel> kernel;
    bool has_aov;
};
} // namespace

TEST_CASE("a launch adds every sample of its tile to the right pixel", "[render]")
{
    for (const Device& device : test_devices()) {
        Bench bench(device, true);
        const Launch launch = bench.trace({1, 0, 5, 4, 3, 0, 7, 0});
        for (std::size_t i = 0; i < launch.blocks.size(); ++i) {
            const bool sky = i / 5 < 2;
            INFO("pixel " << i);
            CHECK(launch.blocks[i].sum.s[0] == (sky ? 7 * 1.5f : 0.0f));
            CHECK(launch.blocks[i].sum.s[1] == (sky ? 14.0f : 0.0f));
            CHECK(launch.blocks[i].sum.s[2] == (sky ? 7 * 0.25f : 0.0f));
            CHECK(launch.blocks[i].sum.s[3] == 7.0f);
            CHECK(launch.blocks[i].m2.s[1] == 0.0f);
            CHECK(launch.blocks[i].m2.s[3] == 0.0f);
            // Seven hits of a surface of albedo 0.5 that faces the camera, four metres away along the axis.
            CHECK(launch.aovs[i].albedo.s[0] == (sky ? 0.0f : 3.5f));
            CHECK(launch.aovs[i].normal.s[2] == (sky ? 0.0f : 7.0f));
            CHECK(launch.aovs[i].normal.s[3] == (sky ? 0.0f : 7.0f));
            if (sky) continue;
            const double depth = launch.aovs[i].albedo.s[3] / 7.0 / bench.geometry.normalisation.scale;
            CHECK(depth > 4.0);
            CHECK(depth < 4.0 * 1.3);
        }
        CHECK(launch.counters.counts[COUNT_CAMERA_RAYS] == 5 * 4 * 7);
        CHECK(launch.counters.counts[COUNT_INDIRECT_RAYS] == 0);
        CHECK(launch.counters.counts[COUNT_SHADOW_RAYS] == 0);
        CHECK(launch.counters.counts[COUNT_BUSY_LANES] == 5 * 4 * 7);
        CHECK(launch.counters.counts[COUNT_LANE_SLOTS] >= launch.counters.counts[COUNT_BUSY_LANES]);
        for (std::size_t kind = 0; kind < HEALTH_KINDS; ++kind) CHECK(launch.counters.health[kind] == 0);
    }
}

TEST_CASE("a second launch goes on with the sums of the first", "[render]")
{
    for (const Device& device : test_devices()) {
        Bench bench(device, false);
        Launch launch = bench.trace({0, 0, 2, 2, 0, 0, 5, 0});
        bench.kernel->trace(*bench.device_scene, {0, 0, 2, 2, 5, 0, 4, 0}, launch.blocks, launch.aovs);
        for (const PixelBlock& block : launch.blocks) {
            CHECK(block.sum.s[1] == 18.0f);
            CHECK(block.sum.s[3] == 9.0f);
        }
    }
}

TEST_CASE("samples of other numbers, in their low or high word, are others", "[render]")
{
    // Where a ray passes through its pixel is random, and with it the depth that it meets.
    for (const Device& device : test_devices()) {
        Bench bench(device, true);
        const auto depth = [&](std::uint32_t first_sample, std::uint32_t first_sample_high) {
            return bench.trace({3, 3, 1, 1, first_sample, first_sample_high, 1, 0}).aovs[0].albedo.s[3];
        };
        const float first = depth(0, 0);
        CHECK(depth(0, 0) == first);
        for (const std::uint32_t sample : {1u, 63u, 64u, 128u, ~0u}) CHECK(depth(sample, 0) != first);
        CHECK(depth(0, 1) != first);
    }
}

TEST_CASE("samples that are infinite or negative count as zero and are told with their first place", "[render]")
{
    struct Fault {
        void (*change)(Geometry&);
        std::size_t kind;
    };
    const Fault faults[] = {
        {[](Geometry& g) { g.lights.back().radiance.s[1] = std::numeric_limits<float>::infinity(); },
         HEALTH_NON_FINITE_RADIANCE},
        {[](Geometry& g) { g.lights.back().radiance.s[2] = -1.0f; }, HEALTH_NEGATIVE_RADIANCE}};
    for (const Device& device : test_devices())
        for (const Fault& fault : faults) {
            // Tiles that begin below the sky, so that the first accident is not the first sample.
            Bench bench(device, false, {}, fault.change);
            const Launch clean = bench.trace({0, 2, 6, 2, 0, 0, 3, 0});
            CHECK(clean.counters.health[fault.kind] == 0);
            CHECK(clean.counters.health_first[fault.kind] == NO_INDEX);

            const Launch launch = bench.trace({0, 0, 6, 4, 0, 0, 3, 0});
            for (std::size_t kind = 0; kind < HEALTH_KINDS; ++kind)
                CHECK(launch.counters.health[kind] == (kind == fault.kind ? 2u * 6 * 3 : 0u));
            CHECK(launch.counters.health_first[fault.kind] == 0);
            CHECK(bench.kernel->accident_code(0) == fault.kind + 1);
            CHECK(bench.kernel->accident_code(12) == 0);
            for (std::size_t i = 0; i < 12; ++i) {
                CHECK(launch.blocks[i].sum.s[0] == 0.0f);
                CHECK(launch.blocks[i].m2.s[3] == 3.0f);
            }
            CHECK(launch.blocks[12].m2.s[3] == 0.0f);
        }
}

TEST_CASE("a launch shape is completed as suits the device, and buffers have its size", "[render]")
{
    for (const Device& shared : test_devices()) {
        const Device device(shared.info());
        LaunchShape shape;
        shape.max_samples = 640;
        const Bench bench(device, true, shape);
        if (device.is_cpu()) CHECK(bench.kernel->shape().local_size == 1);
        CHECK(bench.kernel->shape().local_size > 0);
        std::map<std::string, std::uint64_t> bytes;
        for (const auto& [name, size] : device.memory().buffers) bytes[name] += size;
        CHECK(bytes["sample results"] == 640 * sizeof(SampleResult));
        CHECK(bytes["pixel sums"] == 640 * sizeof(PixelBlock));
        CHECK(bytes["sample AOVs"] == 640 * sizeof(SampleAov));
        CHECK(bytes["pixel AOVs"] == 640 * sizeof(PixelAov));
        CHECK(bytes["counters"] == sizeof(LaunchCounters));
    }
}

TEST_CASE("the programs of a launch are reported with their options", "[render]")
{
    const Bench bench(test_devices().front(), false);
    CHECK(bench.kernel->path_report().program == "path_megakernel.cl");
    CHECK(bench.kernel->path_report().options.find("-DHAS_ENVIRONMENT=1") != std::string::npos);
    CHECK(bench.kernel->film_report().program == "film.cl");
    CHECK(bench.kernel->film_report().options.find("-DHAS_AOV=0") != std::string::npos);
    CHECK(bench.kernel->specialization().has(Feature::ENVIRONMENT));
}
