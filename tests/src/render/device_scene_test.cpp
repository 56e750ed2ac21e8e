// What a scene becomes on a device: the arguments of kernels in their order, and no more buffers than it needs.
#include "render/device_scene.h"
#include "render/render_settings.h"
#include "scene/scene_loader.h"
#include "support/device_evaluate.h"
#include "util/error.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

using namespace etendue;
using Catch::Contains;

namespace
{
const char* const SCENE = R"({
    "film": {"size": [40, 30]},
    "materials": [{"name": "grey", "type": "diffuse", "albedo": [0.25, 0.5, 0.75]}],
    "shapes": [{"type": "triangles", "positions": [[0,0,0],[1,0,0],[0,1,0]], "indices": [[0,1,2]],
                "normals": [[0.6,0,0.8],[0,0,1],[0,0,1]], "material": "grey"},
               {"type": "sphere", "radius": 0.25, "material": "grey", "transform": {"translate": [0.5, 0.5, 1]}}],
    "lights": [{"type": "sphere", "radius": 0.1, "radiance": [3, 4, 5], "transform": {"translate": [0, 0, 1]}}]
})";

// One number from every array of the scene; 0 where there is none.
const char* const PROBE = R"(
#include "shared/scene_view.h"
kernel void probe(SCENE_ARGUMENTS, uint marker, global float* out)
{
    out[0] = settings ? (float)settings->width : 0.0f;
    out[1] = nodes ? 1.0f : 0.0f;
    out[2] = leaf_primitives ? (float)leaf_primitives[0] : -1.0f;
    out[3] = primitives ? primitives[1].b.x : 0.0f;
    out[4] = surfaces ? (float)surfaces[2].light : -1.0f;
    out[5] = normals ? normals[0].x : 0.0f;
    out[6] = materials ? (float)materials[0].type : -1.0f;
    out[7] = parameters ? parameters[2] : 0.0f;
    out[8] = lights ? lights[0].radiance.y : 0.0f;
    out[9] = light_table ? (float)light_table[0].alias : -1.0f;
    out[10] = (float)marker;
}
)";

struct Prepared {
    Geometry geometry;
    RenderSettings settings;
};

Prepared prepare(AcceleratorType accelerator, const std::vector<std::string>& overrides = {})
{
    const Scene scene = parse_scene(SCENE, "upload.json", overrides).scene;
    Prepared prepared{make_geometry(scene), {}};
    prepared.settings = make_render_settings(scene, prepared.geometry, accelerator);
    return prepared;
}

std::set<std::string> buffer_names(const Device& device)
{
    std::set<std::string> names;
    for (const auto& [name, bytes] : device.memory().buffers) names.insert(name);
    return names;
}
} // namespace

TEST_CASE("kernels get every array of the scene in the order of SCENE_ARGUMENTS", "[render]")
{
    for (const Device& device : test_devices()) {
        const Prepared scene = prepare(ACCELERATOR_LBVH);
        const DeviceScene device_scene(device, scene.geometry, scene.settings, BvhPlace::host, KernelCache::none());
        const Program program = Program::from_text(device, "probe", PROBE, "-cl-single-precision-constant");
        Kernel probe(program, "probe");
        const Buffer<float> out(device, "probed", 11);
        device_scene.launch(probe, 1, 1, 77u, out);
        const std::vector<float> found = out.read();
        CHECK(found[0] == 40.0f);
        CHECK(found[1] == 1.0f);
        CHECK(found[2] >= 0.0f);
        CHECK(found[3] == static_cast<float>(0.25 * scene.geometry.normalisation.scale));
        CHECK(found[4] == 0.0f);
        CHECK(found[5] == Approx(0.6f));
        CHECK(found[6] == static_cast<float>(BSDF_DIFFUSE));
        CHECK(found[7] == 0.75f);
        CHECK(found[8] == 4.0f);
        CHECK(found[9] == 0.0f);
        CHECK(found[10] == 77.0f);
        CHECK(device_scene.upload_seconds() > 0.0);
        CHECK(device_scene.bvh_seconds() > 0.0);
        CHECK(device_scene.bvh_statistics().primitive_count == 3);
        CHECK(device_scene.bvh_warning().empty());
    }
}

TEST_CASE("only the buffers that a scene needs exist, and they go with it", "[render]")
{
    for (const Device& shared : test_devices()) {
        const Device device(shared.info());
        {
            const Prepared scene =
                prepare(ACCELERATOR_BRUTE_FORCE, {"lights=[]", "shapes.0.normals=[[0,0,1],[0,0,1],[0,0,1]]"});
            DeviceScene device_scene(device, scene.geometry, scene.settings, BvhPlace::host, KernelCache::none());
            CHECK(buffer_names(device) ==
                  std::set<std::string>{"settings", "primitives", "surfaces", "materials", "material parameters"});
            CHECK(device_scene.bvh_seconds() == 0.0);
            CHECK(device_scene.bvh_builder() == nullptr);
            CHECK(device.memory().current == sizeof(RenderSettings) + 2 * sizeof(Primitive) +
                                                 2 * sizeof(PrimitiveSurface) + scene.geometry.materials.size() * 16 +
                                                 scene.geometry.parameters.size() * 4);
        }
        CHECK(device.memory().current == 0);
    }
}

TEST_CASE("a tree that kernels built keeps their builder", "[render]")
{
    const Device& device = test_devices().front();
    const Prepared scene = prepare(ACCELERATOR_LBVH);
    DeviceScene built(device, scene.geometry, scene.settings, BvhPlace::device, KernelCache::none());
    CHECK(built.bvh_builder() != nullptr);
    CHECK(built.bvh_statistics().built_on_device);
}

TEST_CASE("a scene larger than the device's buffers or memory is refused with the numbers", "[render]")
{
    // A box is 12 triangles: more bytes than the settings, which are uploaded before.
    const Prepared scene =
        prepare(ACCELERATOR_BRUTE_FORCE, {R"(shapes=[{"type":"box","material":"grey"}])", "lights=[]"});
    const std::string needed = std::to_string(12 * sizeof(Primitive)),
                      settings = std::to_string(sizeof(RenderSettings));
    const auto upload_to = [&](const Device& device) {
        DeviceScene(device, scene.geometry, scene.settings, BvhPlace::host, KernelCache::none());
    };
    DeviceInfo info = test_devices().front().info();
    info.max_allocation = sizeof(RenderSettings);
    const Device small_buffers(info);
    CHECK_THROWS_AS(upload_to(small_buffers), DeviceError);
    CHECK_THROWS_WITH(upload_to(small_buffers), Contains("the buffer \"primitives\" needs " + needed + " bytes") &&
                                                    Contains("allows is " + settings + " bytes"));
    info = test_devices().front().info();
    info.global_memory = sizeof(RenderSettings) + 10;
    const Device small_memory(info);
    CHECK_THROWS_AS(upload_to(small_memory), DeviceError);
    CHECK_THROWS_WITH(upload_to(small_memory), Contains("the buffer \"primitives\" needs " + needed + " bytes") &&
                                                   Contains(std::to_string(info.global_memory) + " bytes of memory") &&
                                                   Contains(settings + " are taken"));
    // What was uploaded before is given back.
    CHECK(small_memory.memory().current == 0);
}
