// Replayed paths bring what the render's samples bring, to the bit, and their vertices lie where they must.
#include "render/replay.h"

#include "render/megakernel.h"
#include "render/render_settings.h"
#include "render/scene_features.h"
#include "scene/scene_loader.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <numbers>

using namespace etendue;

namespace
{
constexpr int WIDTH = 12, HEIGHT = 9;

// Every kind of material and light, roulette, a filter and a tree.
const char* const SCENE = R"({
    "camera": {"position": [0, 1.2, 5], "look_at": [0, 0.5, 0], "vertical_fov": 30},
    "film": {"size": [12, 9], "filter": "tent"},
    "integrator": {"type": "path", "max_depth": "unlimited"},
    "sampler": {"seed": 4294967307},
    "materials": [{"name": "grey", "type": "diffuse", "albedo": [0.7, 0.6, 0.5]},
                  {"name": "mirror", "type": "mirror", "reflectance": 0.9},
                  {"name": "glass", "type": "dielectric", "ior": 1.5, "tint": [0.9, 1, 1]}],
    "shapes": [
        {"type": "rectangle", "size": [4, 4], "material": "grey",
         "transform": {"rotate": {"axis": [1, 0, 0], "angle": -90}}},
        {"type": "sphere", "radius": 0.4, "material": "glass", "transform": {"translate": [0.5, 0.6, 0.5]}},
        {"type": "disk", "radius": 0.6, "material": "mirror", "transform": {"translate": [-0.4, 0.7, -0.6]}},
        {"type": "box", "size": [0.4, 0.8, 0.4], "material": "grey", "transform": {"translate": [-0.7, 0.5, 0.3]}}],
    "lights": [
        {"type": "sphere", "radius": 0.2, "radiance": [20, 18, 15], "transform": {"translate": [0, 2, 0.5]}},
        {"type": "rectangle", "size": [0.5, 0.5], "radiance": [3, 5, 9], "two_sided": true,
         "transform": {"translate": [1.2, 1, -0.5]}}],
    "environment": {"radiance": [0.2, 0.3, 0.4]}
})";

// Two pixels of a glowing floor seen from above: one vertex a path.
const char* const FLOOR = R"({
    "camera": {"position": [0, 3, 0], "look_at": [0, 0, 0], "up": [0, 0, -1], "vertical_fov": 1},
    "film": {"size": [2, 1]},
    "integrator": {"type": "bsdf", "max_depth": 0},
    "materials": [{"name": "grey", "type": "diffuse", "albedo": 0.5}],
    "shapes": [{"type": "rectangle", "size": [4, 4], "material": "grey", "emission": {"radiance": [1, 2, 3]},
                "transform": {"rotate": {"axis": [1, 0, 0], "angle": -90}}}]
})";

struct Loaded {
    explicit Loaded(const char* text, const std::vector<std::string>& overrides = {})
        : scene(parse_scene(text, "replay.json", overrides).scene), geometry(make_geometry(scene))
    {
    }
    Scene scene;
    Geometry geometry;
};

// What the render's kernel gives for sample `sample` of every pixel, row by row.
std::vector<Vec3> rendered(const Device& device, const Loaded& loaded, Precision precision, std::uint64_t sample)
{
    const std::uint32_t lanes = precision == Precision::fp64 ? 1 : device.preferred_lanes();
    const RenderSettings settings = make_render_settings(loaded.scene, loaded.geometry, ACCELERATOR_LBVH);
    const DeviceScene scene(device, loaded.geometry, settings, BvhPlace::host, KernelCache::none(), precision);
    Specialization s =
        scene_features(loaded.scene, loaded.geometry, settings, false, lanes, scene.bvh_statistics().depth);
    s.precision = precision;
    Megakernel kernel(device, false, s, KernelCache::none(), {});
    std::vector<PixelBlock> blocks(WIDTH * HEIGHT);
    std::vector<PixelAov> aovs;
    kernel.trace(
        scene,
        {0, 0, WIDTH, HEIGHT, static_cast<std::uint32_t>(sample), static_cast<std::uint32_t>(sample >> 32), 1, 0},
        blocks, aovs);
    std::vector<Vec3> samples;
    for (const PixelBlock& b : blocks)
        samples.emplace_back(double(b.sum.s[0]) - double(b.compensation.s[0]),
                             double(b.sum.s[1]) - double(b.compensation.s[1]),
                             double(b.sum.s[2]) - double(b.compensation.s[2]));
    return samples;
}

std::vector<ReplaySample> every_pixel(std::uint64_t sample)
{
    std::vector<ReplaySample> samples;
    for (std::uint32_t y = 0; y < HEIGHT; ++y)
        for (std::uint32_t x = 0; x < WIDTH; ++x) samples.push_back({x, y, sample});
    return samples;
}

std::vector<Precision> precisions_of(const Device& device)
{
    if (!device.info().has_double) return {Precision::single};
    return {Precision::single, Precision::fp64};
}
} // namespace

TEST_CASE("a replayed path brings the render's radiance, bit for bit", "[render][replay]")
{
    const Loaded loaded(SCENE);
    for (const Device& device : test_devices())
        for (const Precision precision : precisions_of(device)) {
            Replayer specialised(device, loaded.scene, loaded.geometry, precision, {});
            std::size_t bright = 0;
            for (const std::uint64_t sample : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{63},
                                               std::uint64_t{1000}, (std::uint64_t{1} << 32) + 5}) {
                const auto expected = rendered(device, loaded, precision, sample);
                const auto paths = specialised.replay(every_pixel(sample), 4);
                REQUIRE(paths.size() == expected.size());
                for (std::size_t i = 0; i < paths.size(); ++i) {
                    INFO(precision_name(precision) << " sample " << sample << " pixel " << i);
                    for (int c = 0; c < 3; ++c) {
                        // Doubles come back from the film with 48 bits.
                        if (precision == Precision::single)
                            CHECK(paths[i].radiance[c] == expected[i][c]);
                        else
                            CHECK(std::abs(paths[i].radiance[c] - expected[i][c]) <= 0x1p-48 * expected[i][c]);
                    }
                    CHECK(paths[i].accident == 0);
                    bright += paths[i].radiance.x > 0.0;
                }
            }
            CHECK(bright > 100);
        }
}

TEST_CASE("the general kernel replays the path of the specialised one", "[render][replay]")
{
    const Loaded loaded(SCENE);
    for (const Device& device : test_devices()) {
        const auto with = [&](bool specialize) {
            return replay(device, loaded.scene, loaded.geometry, Precision::single, every_pixel(63), 4,
                          {specialize, {}});
        };
        const auto special = with(true), general = with(false);
        REQUIRE(special.size() == general.size());
        for (std::size_t i = 0; i < special.size(); ++i) CHECK(special[i].radiance == general[i].radiance);
    }
}

TEST_CASE("the vertices of a path tell its whole story", "[render][replay]")
{
    const Loaded loaded(SCENE);
    for (const Device& device : test_devices())
        for (const Precision precision : precisions_of(device)) {
            const double u = precision == Precision::fp64 ? 0x1p-53 : 0x1p-24;
            std::map<std::uint32_t, std::size_t> bsdfs;
            for (const PathRecord& path :
                 replay(device, loaded.scene, loaded.geometry, precision, every_pixel(7), 1000)) {
                REQUIRE(path.vertices.size() == path.vertex_count);
                REQUIRE(path.vertex_count > 0);
                const fp64::PathVertex& last = path.vertices.back();
                CHECK(last.goes_on == 0);
                for (int c = 0; c < 3; ++c) CHECK(last.radiance.s[c] == path.radiance[c]);
                for (std::size_t i = 0; i < path.vertices.size(); ++i) {
                    const fp64::PathVertex& v = path.vertices[i];
                    ++bsdfs[v.bsdf];
                    if (v.primitive == NO_INDEX) continue;
                    CHECK(v.bsdf == loaded.geometry.materials.at(v.material).type);
                    CHECK(v.material == loaded.geometry.surfaces.at(v.primitive).material);
                    CHECK(v.position.s[3] > 0.0);
                    CHECK(v.position.s[3] < 64.0 * u);
                    if (v.delta) CHECK(v.shading_normal.s[3] == 1.0);
                    if (i + 1 == path.vertices.size()) continue;
                    // The next vertex lies along the direction, as far as it says.
                    const fp64::PathVertex& next = path.vertices[i + 1];
                    CHECK(v.goes_on == 1);
                    CHECK(v.shading_normal.s[3] > 0.0);
                    if (next.primitive == NO_INDEX) continue;
                    for (int c = 0; c < 3; ++c)
                        CHECK(std::abs(v.position.s[c] + next.geometric_normal.s[3] * v.direction.s[c] -
                                       next.position.s[c]) < 256.0 * u);
                }
            }
            for (const uint bsdf : {BSDF_DIFFUSE, BSDF_MIRROR, BSDF_DIELECTRIC}) CHECK(bsdfs[bsdf] > 0);
            CHECK(bsdfs[NO_INDEX] > 0);
        }
}

TEST_CASE("densities of a vertex weigh the light that it gathers", "[render][replay]")
{
    // One two-sided light over a diffuse floor: f cos is albedo times the BSDF's density, and every throughput a power
    // of the albedo.
    constexpr double ALBEDO = 0.5, RADIANCE = 3.0;
    const Loaded loaded(R"({
        "camera": {"position": [0.3, 0.8, 1.8], "look_at": [0, 0.3, 0], "vertical_fov": 60},
        "film": {"size": [12, 9]},
        "integrator": {"type": "path", "max_depth": 3, "roulette": "off"},
        "materials": [{"name": "grey", "type": "diffuse", "albedo": 0.5}],
        "shapes": [{"type": "box", "size": [4, 4, 4], "material": "grey", "flip_normals": true,
                    "transform": {"translate": [0, 2, 0]}}],
        "lights": [{"type": "disk", "radius": 1, "radiance": 3, "two_sided": true,
                    "transform": [{"rotate": {"axis": [1, 0, 0], "angle": 90}}, {"translate": [0, 1.5, 0]}]}]
    })");
    for (const Device& device : test_devices())
        for (const Precision precision : precisions_of(device)) {
            const double tolerance = precision == Precision::fp64 ? 1e-12 : 1e-5;
            std::size_t sampled = 0, met = 0;
            for (const PathRecord& path : replay(device, loaded.scene, loaded.geometry, precision, every_pixel(5), 8)) {
                double throughput = 1.0, pdf = 0.0;
                for (std::size_t i = 0; i < path.vertices.size(); ++i) {
                    const fp64::PathVertex& v = path.vertices[i];
                    const double before = i == 0 ? 0.0 : path.vertices[i - 1].radiance.s[0];
                    const double emission = v.emission.s[0] - before, light = v.radiance.s[0] - v.emission.s[0];
                    const double sum = 1.0 + v.radiance.s[0];
                    const auto [of_sample, of_bsdf, of_emission, unused] = v.light_pdfs.s;
                    CHECK((of_emission > 0.0) == (v.light != NO_INDEX));
                    if (emission > 0.0 && i > 0) {
                        ++met;
                        const double weight = pdf * pdf / (pdf * pdf + of_emission * of_emission);
                        CHECK(std::abs(emission - throughput * RADIANCE * weight) < tolerance * sum);
                    }
                    if (light > 0.0) {
                        ++sampled;
                        const double weight = of_sample * of_sample / (of_sample * of_sample + of_bsdf * of_bsdf);
                        const double expected = throughput * ALBEDO * RADIANCE * of_bsdf / of_sample * weight;
                        CHECK(std::abs(light - expected) < tolerance * sum);
                    }
                    throughput *= ALBEDO;
                    pdf = v.shading_normal.s[3];
                }
            }
            CHECK(sampled > 50);
            CHECK(met > 5);
        }
}

TEST_CASE("a vertex of a known scene holds the known numbers", "[render][replay]")
{
    const Loaded loaded(FLOOR);
    const double scale = loaded.geometry.normalisation.scale;
    for (const Device& device : test_devices())
        for (const Precision precision : precisions_of(device)) {
            const std::vector<ReplaySample> samples{{1, 0, 3}};
            const auto paths = replay(device, loaded.scene, loaded.geometry, precision, samples, 8);
            REQUIRE(paths.size() == 1);
            REQUIRE(paths[0].vertices.size() == 1);
            const fp64::PathVertex& v = paths[0].vertices[0];
            CHECK(v.geometric_normal.s[3] == Approx(3.0 * scale).epsilon(1e-3));
            CHECK(v.geometric_normal.s[1] == 1.0);
            CHECK(v.shading_normal.s[1] == 1.0);
            CHECK(v.shading_normal.s[3] == 0.0); // the path may not go on
            CHECK(v.goes_on == 0);
            CHECK(v.inside == 0);
            CHECK(v.light != NO_INDEX);
            for (int c = 0; c < 3; ++c) {
                CHECK(v.throughput.s[c] == 1.0);
                CHECK(v.emission.s[c] == c + 1.0);
                CHECK(v.radiance.s[c] == c + 1.0);
                CHECK(paths[0].radiance[c] == c + 1.0);
            }
        }
}

TEST_CASE("the vertices beyond the limit are counted and not stored", "[render][replay]")
{
    const Loaded loaded(SCENE);
    const Device& device = test_devices().front();
    const auto whole = replay(device, loaded.scene, loaded.geometry, Precision::single, every_pixel(0), 1000);
    for (const std::uint32_t limit : {0u, 2u}) {
        const auto cut = replay(device, loaded.scene, loaded.geometry, Precision::single, every_pixel(0), limit);
        for (std::size_t i = 0; i < whole.size(); ++i) {
            CHECK(cut[i].vertex_count == whole[i].vertex_count);
            CHECK(cut[i].vertices.size() == std::min(limit, whole[i].vertex_count));
            CHECK(cut[i].radiance == whole[i].radiance);
            if (!cut[i].vertices.empty())
                CHECK(cut[i].vertices.back().radiance.s[1] ==
                      whole[i].vertices[cut[i].vertices.size() - 1].radiance.s[1]);
        }
    }
}

TEST_CASE("an accident is replayed with its kind and vertex", "[render][replay]")
{
    Loaded loaded(FLOOR);
    for (Light& light : loaded.geometry.lights) light.radiance.s[1] = std::numeric_limits<float>::infinity();
    for (const Device& device : test_devices())
        for (const Precision precision : precisions_of(device)) {
            const auto paths = replay(device, loaded.scene, loaded.geometry, precision,
                                      std::vector<ReplaySample>{{0, 0, 0}, {1, 0, 9}}, 8);
            for (const PathRecord& path : paths) {
                CHECK(path.accident == HEALTH_NON_FINITE_RADIANCE + 1);
                CHECK(path.radiance == Vec3(0.0));
                CHECK(std::isinf(path.vertices.at(0).radiance.s[1]));
            }
        }
}

TEST_CASE("what cannot be replayed is refused in a sentence", "[render][replay]")
{
    const Loaded loaded(FLOOR), normals(FLOOR, {"integrator.type=\"normals\""});
    const Device& device = test_devices().front();
    CHECK_THROWS_WITH(
        replay(device, loaded.scene, loaded.geometry, Precision::single, std::vector<ReplaySample>{{2, 0, 0}}, 8),
        "The pixel 2,0 is outside the film of 2x1 pixels.");
    CHECK_THROWS_AS(
        replay(device, loaded.scene, loaded.geometry, Precision::single, std::vector<ReplaySample>{{0, 1, 0}}, 8),
        UsageError);
    CHECK_THROWS_AS(
        replay(device, normals.scene, normals.geometry, Precision::single, std::vector<ReplaySample>{{0, 0, 0}}, 8),
        UsageError);
    DeviceInfo info = device.info();
    info.has_double = false;
    const Device without(info);
    CHECK_THROWS_AS(
        replay(without, loaded.scene, loaded.geometry, Precision::fp64, std::vector<ReplaySample>{{0, 0, 0}}, 8),
        DeviceError);
}
