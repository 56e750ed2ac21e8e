// One picture, whatever the way to it: every channel of the film has the same bits for any tree, crop, tile, launch,
// number of lanes, device of the same kind, kernel and cut of the samples.
#include "render/render_settings.h"
#include "render/renderer.h"
#include "render/scene_features.h"
#include "scene/scene_loader.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

using namespace etendue;

namespace
{
constexpr int WIDTH = 9, HEIGHT = 7;
constexpr int SAMPLES = 70; // more than a block

const char* const MATERIALS = R"(
    {"name": "grey", "type": "diffuse", "albedo": [0.7, 0.6, 0.5]},
    {"name": "mirror", "type": "mirror", "reflectance": 0.9},
    {"name": "glass", "type": "dielectric", "ior": 1.5, "tint": [0.9, 1, 1]})";

// A hilly floor of 2 n^2 triangles with vertex normals.
std::string hills(int n)
{
    const auto height = [](double x, double z) { return 0.2 * std::sin(3.0 * x) * std::cos(2.0 * z); };
    std::string positions, normals, indices;
    for (int row = 0; row <= n; ++row)
        for (int column = 0; column <= n; ++column) {
            const double x = -1.5 + 3.0 * column / n, z = -1.5 + 3.0 * row / n;
            const char* comma = positions.empty() ? "" : ",";
            positions += fmt::format("{}[{},{},{}]", comma, x, height(x, z), z);
            normals += fmt::format("{}[{},1,{}]", comma, -0.6 * std::cos(3.0 * x) * std::cos(2.0 * z),
                                   0.4 * std::sin(3.0 * x) * std::sin(2.0 * z));
        }
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column) {
            const int a = row * (n + 1) + column, b = a + n + 1;
            indices += fmt::format("{}[{},{},{}],[{},{},{}]", indices.empty() ? "" : ",", a, b, a + 1, a + 1, b, b + 1);
        }
    return fmt::format(R"({{"type": "triangles", "positions": [{}], "normals": [{}], "indices": [{}],
        "material": "grey"}})",
                       positions, normals, indices);
}

// Every kind of shape, material and light at once.
std::string full_scene(const std::string& film = R"("filter": "tent")",
                       const std::string& integrator = R"("type": "path", "max_depth": "unlimited")")
{
    return fmt::format(R"({{
        "camera": {{"position": [0, 1.2, 5], "look_at": [0, 0.5, 0], "vertical_fov": 30}},
        "film": {{"size": [{}, {}], {}}},
        "integrator": {{{}}},
        "sampler": {{"spp": {}, "seed": 11}},
        "materials": [{}],
        "shapes": [{},
            {{"type": "sphere", "radius": 0.4, "material": "glass", "transform": {{"translate": [0.5, 0.6, 0.5]}}}},
            {{"type": "disk", "radius": 0.6, "material": "mirror", "transform": {{"translate": [-0.4, 0.7, -0.6]}}}},
            {{"type": "box", "size": [0.4, 0.8, 0.4], "material": "grey",
              "transform": {{"translate": [-0.7, 0.5, 0.3]}}}}],
        "lights": [
            {{"type": "sphere", "radius": 0.2, "radiance": [20, 18, 15], "transform": {{"translate": [0, 2, 0.5]}}}},
            {{"type": "rectangle", "size": [0.5, 0.5], "radiance": [3, 5, 9], "two_sided": true,
              "transform": {{"translate": [1.2, 1, -0.5]}}}}],
        "environment": {{"radiance": [0.2, 0.3, 0.4]}}}})",
                       WIDTH, HEIGHT, film, integrator, SAMPLES, MATERIALS, hills(5));
}

// Diffuse triangles alone under one light.
std::string plain_scene(const std::string& integrator, int seed = 11)
{
    return fmt::format(R"({{
        "camera": {{"position": [0, 1.2, 5], "look_at": [0, 0.5, 0], "vertical_fov": 30}},
        "film": {{"size": [{}, {}]}}, "integrator": {{{}}}, "sampler": {{"spp": {}, "seed": {}}},
        "materials": [{{"name": "grey", "type": "diffuse", "albedo": 0.7}}],
        "shapes": [
            {{"type": "rectangle", "size": [4, 4], "material": "grey",
              "transform": {{"rotate": {{"axis": [1, 0, 0], "angle": -90}}}}}},
            {{"type": "box", "size": [0.6, 0.8, 0.6], "material": "grey",
              "transform": {{"translate": [-0.3, 0.4, 0]}}}}],
        "lights": [{{"type": "rectangle", "size": [1, 1], "radiance": 5,
            "transform": [{{"rotate": {{"axis": [1, 0, 0], "angle": 90}}}}, {{"translate": [0, 2, 0]}}]}}]}})",
                       WIDTH, HEIGHT, integrator, SAMPLES, seed);
}

// How to render; the defaults are those of a render without options.
struct Way {
    RenderOptions options;
    std::vector<std::string> overrides;
    bool has_aov = true;
    std::optional<PixelRect> crop;
};

Image render(const Device& device, const std::string& text, Way way = {})
{
    const Scene scene = parse_scene(text, "equivalence.json", way.overrides).scene;
    const Geometry geometry = make_geometry(scene);
    if (way.options.devices.empty()) way.options.devices = {device.info()};
    Renderer renderer(scene, geometry, way.has_aov, way.options);
    const PixelRect whole{0, 0, scene.film.width, scene.film.height};
    Film film(scene.film.width, scene.film.height, way.crop.value_or(whole), way.has_aov);
    RenderLimits limits;
    limits.samples_per_pixel = wanted_samples(scene);
    renderer.render(film, limits);
    CHECK(renderer.report().accidents() == 0);
    CHECK(film.min_samples() == limits.samples_per_pixel);
    return film.resolve(1.0);
}

bool same_bits(const Image& a, const Image& b)
{
    return a.width == b.width && a.height == b.height && a.channels == b.channels && a.data.size() == b.data.size() &&
           std::memcmp(a.data.data(), b.data.data(), a.data.size() * sizeof(float)) == 0;
}

// The pixels of a rectangle.
Image cut_out(const Image& image, const PixelRect& crop)
{
    Image part = image;
    part.width = crop.width;
    part.height = crop.height;
    part.data.clear();
    for (int y = 0; y < crop.height; ++y)
        for (int x = 0; x < crop.width; ++x)
            for (std::size_t c = 0; c < image.channels.size(); ++c)
                part.data.push_back(image.at(crop.x + x, crop.y + y, c));
    return part;
}

Way with_shape(std::uint32_t max_samples, std::uint32_t pool_size, std::uint32_t local_size)
{
    Way way;
    way.options.shape = {max_samples, pool_size, local_size};
    return way;
}
} // namespace

TEST_CASE("the full scene's picture has light and shade in every channel", "[render][equivalence]")
{
    // What is compared below could differ.
    const Image image = render(test_devices().front(), full_scene());
    REQUIRE(image.channels.size() == 14);
    for (std::size_t c = 0; c + 1 < image.channels.size(); ++c) {
        INFO(image.channels[c]);
        float least = std::numeric_limits<float>::max(), most = std::numeric_limits<float>::lowest();
        for (int y = 0; y < HEIGHT; ++y)
            for (int x = 0; x < WIDTH; ++x) {
                least = std::min(least, image.at(x, y, c));
                most = std::max(most, image.at(x, y, c));
            }
        CHECK(std::isfinite(least));
        CHECK(std::isfinite(most));
        CHECK(least < most);
    }
}

TEST_CASE("every tree and none give the same picture", "[render][equivalence]")
{
    for (const Device& device : test_devices()) {
        const auto with = [&](const std::string& accelerator) {
            Way way;
            way.overrides = {"accelerator=" + accelerator};
            return render(device, full_scene(), way);
        };
        const Image host_tree = with(R"({"type":"lbvh","build":"host"})");
        CHECK(same_bits(host_tree, with(R"({"type":"lbvh","build":"device"})")));
        CHECK(same_bits(host_tree, with(R"({"type":"none"})")));
    }
}

TEST_CASE("1, 4, 8 and 16 lanes give the same picture", "[render][equivalence]")
{
    for (const Device& device : test_devices()) {
        const auto with = [&](std::uint32_t lanes, const std::string& accelerator) {
            Way way;
            way.options.lanes = lanes;
            way.overrides = {"accelerator=" + accelerator};
            return render(device, full_scene(), way);
        };
        const Image scalar = with(1, "lbvh");
        for (const std::uint32_t lanes : LANE_COUNTS) {
            INFO(lanes << " lanes");
            CHECK(same_bits(scalar, with(lanes, "lbvh")));
        }
        CHECK(same_bits(scalar, with(1, "none")));
        CHECK(same_bits(scalar, with(8, "none")));
    }
}

TEST_CASE("the size of launches, pools and work-groups changes nothing", "[render][equivalence]")
{
    for (const Device& device : test_devices()) {
        const Image expected = render(device, full_scene());
        const std::uint32_t largest = static_cast<std::uint32_t>(device.info().max_work_group_size);
        for (const std::uint32_t max_samples : {1u, 64u, 1000u, 1u << 19})
            CHECK(same_bits(expected, render(device, full_scene(), with_shape(max_samples, 0, 0))));
        for (const std::uint32_t pool_size : {1u, 7u, 101u, 100000u})
            CHECK(same_bits(expected, render(device, full_scene(), with_shape(1000, pool_size, 0))));
        for (const std::uint32_t local_size : {7u, 64u}) // 1 is the default of a CPU
            if (local_size <= largest)
                CHECK(same_bits(expected, render(device, full_scene(), with_shape(1000, 3, local_size))));
    }
}

TEST_CASE("a crop is the same pixels as in the whole picture", "[render][equivalence]")
{
    for (const Device& device : test_devices()) {
        const Image whole = render(device, full_scene());
        for (const PixelRect& crop :
             {PixelRect{0, 0, WIDTH, HEIGHT}, PixelRect{0, 0, 1, 1}, PixelRect{WIDTH - 1, HEIGHT - 1, 1, 1},
              PixelRect{2, 1, 5, 3}, PixelRect{4, 0, 1, HEIGHT}, PixelRect{0, 5, WIDTH, 2}}) {
            Way way = with_shape(300, 0, 0);
            way.crop = crop;
            INFO("crop " << crop.x << ',' << crop.y << ',' << crop.width << ',' << crop.height);
            const Image part = render(device, full_scene(), way);
            CHECK(part.x == crop.x);
            CHECK(part.full_height == HEIGHT);
            CHECK(same_bits(part, cut_out(whole, crop)));
        }
    }
}

TEST_CASE("one device, the same one twice and a part of it give the same picture", "[render][equivalence]")
{
    for (const Device& device : test_devices()) {
        const Image expected = render(device, full_scene());
        Way twice = with_shape(100, 0, 0);
        twice.options.devices = {device.info(), device.info()};
        CHECK(same_bits(expected, render(device, full_scene(), twice)));
        // Only CPUs can be divided everywhere.
        if (!device.is_cpu()) continue;
        Way part;
        part.options.threads = 1;
        CHECK(same_bits(expected, render(device, full_scene(), part)));
    }
}

TEST_CASE("the general kernel gives the picture of the specialised one", "[render][equivalence]")
{
    const std::pair<std::string, bool> scenes[] = {
        {full_scene(), true},
        {full_scene(R"("filter": {"type": "gaussian", "radius": 1.5, "sigma": 0.6})",
                    R"("type": "hemisphere", "max_depth": 6, "roulette": {"type": "constant", "probability": 0.7})"),
         true},
        {plain_scene(R"("type": "light", "max_depth": 4, "roulette": "off")"), false},
        {plain_scene(R"("type": "bsdf", "max_depth": 3)"), true},
        {full_scene(R"("filter": "box")", R"("type": "normals")"), true}};
    for (const Device& device : test_devices())
        for (const auto& [text, has_aov] : scenes) {
            Way special;
            special.has_aov = has_aov;
            Way general = special;
            general.options.specialize = false;
            INFO(text);
            CHECK(same_bits(render(device, text, special), render(device, text, general)));
        }
}

TEST_CASE("a value set on the command line is one written in the file", "[render][equivalence]")
{
    const Device& device = test_devices().front();
    const std::string edited = plain_scene(R"("type": "bsdf", "max_depth": 2)", 12);
    const std::string original = plain_scene(R"("type": "bsdf", "max_depth": 3)");
    Way way;
    way.overrides = {"integrator.max_depth=2", "/sampler/seed=12"};
    const Image expected = render(device, edited);
    CHECK(same_bits(expected, render(device, original, way)));
    CHECK_FALSE(same_bits(expected, render(device, original)));
}

TEST_CASE("the same seed gives the same bits twice, another seed another picture", "[render][equivalence]")
{
    const Device& device = test_devices().front();
    const auto seeded = [&](const std::string& seed) {
        Way way;
        way.overrides = {"sampler.seed=" + seed};
        return render(device, full_scene(), way);
    };
    const Image first = seeded("11");
    CHECK(same_bits(first, seeded("11")));
    CHECK_FALSE(same_bits(first, seeded("12")));
    // 2^32 + 11: the high word of the seed counts.
    CHECK_FALSE(same_bits(first, seeded("4294967307")));
}

TEST_CASE("a block of samples can be cut at any point", "[render][equivalence]")
{
    const Device& device = test_devices().front();
    const Scene scene = parse_scene(full_scene(), "equivalence.json").scene;
    const Geometry geometry = make_geometry(scene);
    const std::uint32_t lanes = device.preferred_lanes();
    const RenderSettings settings = make_render_settings(scene, geometry, ACCELERATOR_LBVH);
    const DeviceScene device_scene(device, geometry, settings, BvhPlace::host, KernelCache::none());
    Megakernel kernel(device, false,
                      scene_features(scene, geometry, settings, true, lanes, device_scene.bvh_statistics().depth),
                      KernelCache::none(), {});

    const PixelRect whole{0, 0, WIDTH, HEIGHT};
    const auto render_passes = [&](const std::vector<std::uint32_t>& passes) {
        Film film(WIDTH, HEIGHT, whole, true);
        film.set_error_estimate(error_estimate_of(scene));
        std::vector<PixelBlock> blocks;
        std::vector<PixelAov> aovs;
        std::uint32_t first = 0;
        for (const std::uint32_t count : passes) {
            film.load_tile(whole, blocks, aovs);
            kernel.trace(device_scene, {0, 0, WIDTH, HEIGHT, first, 0, count, 0}, blocks, aovs);
            film.store_tile(whole, blocks, aovs);
            first += count;
        }
        REQUIRE(film.min_samples() == SAMPLES);
        return film.resolve(1.0);
    };
    const Image expected = render_passes({64, 6});
    CHECK(same_bits(expected, render(device, full_scene())));
    CHECK(same_bits(expected, render_passes({1, 63, 6})));
    CHECK(same_bits(expected, render_passes({63, 1, 1, 5})));
    CHECK(same_bits(expected, render_passes({17, 30, 17, 2, 4})));
    CHECK(same_bits(expected, render_passes(std::vector<std::uint32_t>(SAMPLES, 1))));
}
