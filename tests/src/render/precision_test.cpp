// The fp64 twin: structs between the precisions, the parts of the kernels in double, and whole renders.
#include "render/precision.h"

#include "compute/kernel.h"
#include "render/render_settings.h"
#include "render/renderer.h"
#include "scene/scene_loader.h"
#include "support/device_evaluate.h"
#include "support/render_scene.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

using namespace etendue;

namespace
{
const char* const FP64_OPTIONS = "-DREAL_IS_DOUBLE=1 -DLANES=1";

// The tests' devices that know double precision.
std::vector<const Device*> double_devices()
{
    std::vector<const Device*> devices;
    for (const Device& device : test_devices()) {
        if (device.info().has_double)
            devices.push_back(&device);
        else
            WARN(device.info().name << " has no double precision");
    }
    return devices;
}

// A room whose walls glow with radiance 1 and reflect `albedo`, seen from within.
Scene furnace(double albedo, std::uint32_t depth)
{
    Scene scene = empty_scene(IntegratorType::bsdf, depth);
    ShapeDescription& room = add_shape(scene, BoxShape{Vec3(2.0)}, add_diffuse(scene, Vec3(albedo)));
    room.flip_normals = true;
    room.emission = Emission{Vec3(1.0), false};
    look(scene, {0.1, 0.2, -0.3}, {0.5, -0.1, 0.4}, 100, 16, 16);
    scene.sampler.samples_per_pixel = 4;
    return scene;
}

// A room with a light, a box and a glass ball: every kind of path.
const char* const ROOM = R"({
    "camera": {"position": [0, 1, 3.5], "look_at": [0, 0.9, 0], "vertical_fov": 45},
    "film": {"size": [32, 32]},
    "integrator": {"type": "path", "max_depth": 6},
    "materials": [{"name": "white", "type": "diffuse", "albedo": [0.7, 0.6, 0.5]},
                  {"name": "glass", "type": "dielectric", "ior": 1.5},
                  {"name": "mirror", "type": "mirror", "reflectance": 0.8}],
    "shapes": [
        {"type": "box", "size": [4, 4, 8], "material": "white", "flip_normals": true,
         "transform": {"translate": [0, 2, 0]}},
        {"type": "sphere", "radius": 0.4, "material": "glass", "transform": {"translate": [0.5, 0.6, 0.5]}},
        {"type": "disk", "radius": 0.6, "material": "mirror", "transform": {"translate": [-0.4, 0.9, -0.6]}},
        {"type": "box", "size": [0.4, 0.8, 0.4], "material": "white", "transform": {"translate": [-0.7, 0.4, 0.3]}}],
    "lights": [{"type": "sphere", "radius": 0.3, "radiance": 8, "transform": {"translate": [0, 3, 0.5]}}]
})";

struct Rendered {
    std::unique_ptr<Film> film;
    RenderReport report;
};

Rendered render(const Device& device, const Scene& scene, const RenderOptions& wanted, bool has_aov = false)
{
    const Geometry geometry = make_geometry(scene);
    RenderOptions options = wanted;
    options.devices = {device.info()};
    Renderer renderer(scene, geometry, has_aov, options);
    const PixelRect whole{0, 0, scene.film.width, scene.film.height};
    Rendered result{std::make_unique<Film>(whole.width, whole.height, whole, has_aov), {}};
    RenderLimits limits;
    limits.samples_per_pixel = wanted_samples(scene);
    renderer.render(*result.film, limits);
    result.report = renderer.report();
    CHECK(result.report.accidents() == 0);
    return result;
}

RenderOptions in_precision(Precision precision)
{
    RenderOptions options;
    options.precision = precision;
    return options;
}
} // namespace

TEST_CASE("every shared struct of double reals has the same size and places on host and device", "[render][precision]")
{
    std::string text = "#include \"shared/structs.h\"\nkernel void sizes(global uint* out)\n{\n    uint i = 0;\n";
    std::vector<std::string> names;
    std::vector<std::uint32_t> expected;
#define ADD_STRUCT(name)                                                                                               \
    text += "    out[i++] = (uint)sizeof(" #name ");\n";                                                               \
    names.push_back(#name);                                                                                            \
    expected.push_back(sizeof(fp64::name));
    SHARED_STRUCTS(ADD_STRUCT)
#undef ADD_STRUCT
    for (const auto& [member, offset] : std::vector<std::pair<std::string, std::size_t>>{
             {"RenderSettings, width", offsetof(fp64::RenderSettings, width)},
             {"RenderSettings, filter_parameters", offsetof(fp64::RenderSettings, filter_parameters)},
             {"RenderSettings, scene_bounds", offsetof(fp64::RenderSettings, scene_bounds)},
             {"Light, radiance", offsetof(fp64::Light, radiance)},
             {"PathVertex, primitive", offsetof(fp64::PathVertex, primitive)}}) {
        text += "    out[i++] = (uint)__builtin_offsetof(" + member + ");\n";
        names.push_back(member);
        expected.push_back(static_cast<std::uint32_t>(offset));
    }
    for (const Device* device : double_devices()) {
        const Program program = Program::from_text(*device, "struct sizes", text + "}\n", FP64_OPTIONS);
        const Buffer<std::uint32_t> out(*device, "sizes", expected.size());
        Kernel(program, "sizes").run(1, 0, out);
        const auto found = out.read();
        for (std::size_t i = 0; i < names.size(); ++i) {
            INFO(names[i]);
            CHECK(found[i] == expected[i]);
        }
    }
}

TEST_CASE("settings keep every number on their way to double", "[render][precision]")
{
    const Scene scene = parse_scene(ROOM, "room.json", {"film.filter=\"gaussian\"", "sampler.seed=123456789012"}).scene;
    const Geometry geometry = make_geometry(scene);
    const RenderSettings s = make_render_settings(scene, geometry, ACCELERATOR_LBVH);
    const fp64::RenderSettings wide = widen(s);
    const auto same = [](const real4& a, const fp64::real4& b) {
        for (int c = 0; c < 4; ++c)
            if (double(a.s[c]) != b.s[c]) return false;
        return true;
    };
    CHECK(same(s.camera.position, wide.camera.position));
    CHECK(same(s.camera.up, wide.camera.up));
    CHECK(same(s.filter_parameters, wide.filter_parameters));
    CHECK(same(s.roulette_parameters, wide.roulette_parameters));
    CHECK(same(s.scene_bounds, wide.scene_bounds));
    CHECK(wide.width == s.width);
    CHECK(wide.seed_low == s.seed_low);
    CHECK(wide.seed_high == s.seed_high);
    CHECK(wide.accelerator == s.accelerator);
    CHECK(wide.primitive_count == s.primitive_count);
    CHECK(wide.environment_light == s.environment_light);
}

TEST_CASE("a sum in double survives the film's floats to 48 bits", "[render][precision]")
{
    fp64::PixelBlock block{};
    block.sum = {{0.1, 1e10 / 3.0, std::numbers::pi, 17.0}};
    block.compensation = {{1e-19, 0.0, 0.0, 0.0}};
    block.m2 = {{2.0, 3.0, 4.0, 1.0}};
    const fp64::PixelBlock back = widen(narrow(block));
    for (int c = 0; c < 3; ++c) {
        CHECK(std::abs(back.sum.s[c] - block.sum.s[c]) <= 0x1p-47 * block.sum.s[c]);
        CHECK(back.compensation.s[c] == 0.0);
        CHECK(back.m2.s[c] == block.m2.s[c]);
    }
    CHECK(back.sum.s[3] == 17.0);
    CHECK(back.m2.s[3] == 1.0);
}

TEST_CASE("the parts of the kernels keep the precision of a double", "[render][precision]")
{
    const char* const text = R"(
#include "sampling/random.h"
#include "sampling/warp.h"
kernel void probe(global const double* x, global double* out)
{
    size_t i = get_global_id(0);
    Float s, c;
    sin_cos_two_pi(x[i], &s, &c);
    out[i * 5] = s;
    out[i * 5 + 1] = c;
    out[i * 5 + 2] = log_of(x[i] + 1e-300);
    out[i * 5 + 3] = length3(normalize3(vec3(x[i], 2.0, -3.0)));
    out[i * 5 + 4] = uniform_float((Uint)(i * 0x9e3779b9u));
}
kernel void edges(global double* out)
{
    double zero = out[0];
    out[0] = is_finite(1.0 / zero) ? 1.0 : 0.0;
    out[1] = is_finite(zero / zero) ? 1.0 : 0.0;
    out[2] = is_finite(-1.0 / zero) ? 1.0 : 0.0;
    out[3] = is_finite(0x1.fffffffffffffp1023 + zero) ? 1.0 : 0.0;
    out[4] = is_finite(-4e38 + zero) ? 1.0 : 0.0;
    out[5] = UNIT_ROUNDOFF;
    out[6] = copy_sign(3.0, -zero);
    out[7] = abs_of(-1e300);
    out[8] = 0.1;
})";
    constexpr std::size_t COUNT = 1000;
    std::vector<double> x(COUNT);
    for (std::size_t i = 0; i < COUNT; ++i) x[i] = static_cast<double>(i) / COUNT * 2.0;
    for (const Device* device : double_devices()) {
        const Program program = Program::from_text(*device, "double probe", text, FP64_OPTIONS);
        const Buffer<double> in(*device, "x", x), out(*device, "out", COUNT * 5);
        Kernel(program, "probe").run(COUNT, 0, in, out);
        const auto found = out.read();
        double worst_sin = 0.0, worst_cos = 0.0, worst_log = 0.0, worst_length = 0.0;
        for (std::size_t i = 0; i < COUNT; ++i) {
            const long double angle = 2.0L * std::numbers::pi_v<long double> * x[i];
            worst_sin = std::max(worst_sin, double(std::abs(found[i * 5] - std::sin(angle))));
            worst_cos = std::max(worst_cos, double(std::abs(found[i * 5 + 1] - std::cos(angle))));
            const long double log = std::log(static_cast<long double>(x[i] + 1e-300));
            worst_log = std::max(worst_log, double(std::abs(found[i * 5 + 2] - log) / std::max(1.0L, std::abs(log))));
            worst_length = std::max(worst_length, std::abs(found[i * 5 + 3] - 1.0));
            // The same 24 bits as in float.
            const auto bits = static_cast<std::uint32_t>(i) * 0x9e3779b9u;
            CHECK(found[i * 5 + 4] == double(float(bits >> 8) * 0x1p-24f));
        }
        CHECK(worst_sin < 0x1p-50);
        CHECK(worst_cos < 0x1p-50);
        CHECK(worst_log < 0x1p-50);
        CHECK(worst_length < 0x1p-51);

        const Buffer<double> edges(*device, "edges", std::vector<double>(9, 0.0));
        Kernel(program, "edges").run(1, 0, edges);
        CHECK(edges.read() == std::vector<double>{0, 0, 0, 1, 1, 0x1p-53, -3, 1e300, 0.1});
    }
}

TEST_CASE("a glowing room is exact to the roundings of a double", "[render][precision]")
{
    for (const Device* device : double_devices())
        for (const bool specialize : {true, false})
            for (const std::uint32_t depth : {1u, 8u, 64u}) {
                const double albedo = double(0.8f);
                double expected = 0.0;
                for (std::uint32_t k = 0; k <= depth; ++k) expected = 1.0 + albedo * (k ? expected : 0.0);
                RenderOptions options = in_precision(Precision::fp64);
                options.specialize = specialize;
                const Rendered rendered = render(*device, furnace(0.8, depth), options);
                CHECK(rendered.report.precision == Precision::fp64);
                double worst = 0.0;
                for (int y = 0; y < 16; ++y)
                    for (int x = 0; x < 16; ++x)
                        worst = std::max(worst, std::abs(rendered.film->estimate(x, y).mean.x / expected - 1.0));
                INFO("depth " << depth << ", off by " << worst);
                // 2 roundings a vertex, and 48 bits of the sum.
                CHECK(worst <= 2.0 * depth * 0x1p-53 + 0x1p-47);
            }
}

TEST_CASE("pictures in float and double are the same but for rounding", "[render][precision]")
{
    Scene scene = parse_scene(ROOM, "room.json").scene;
    scene.sampler.samples_per_pixel = 4;
    for (const Device* device : double_devices()) {
        const Rendered single = render(*device, scene, in_precision(Precision::single), true);
        for (const BuildPlace place : {BuildPlace::host, BuildPlace::device}) {
            scene.accelerator.build = place;
            const Rendered twin = render(*device, scene, in_precision(Precision::fp64), true);
            // Few paths part, so most pixels agree closely.
            std::size_t close = 0;
            double sum_single = 0.0, sum_twin = 0.0, largest = 0.0;
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 32; ++x) {
                    const double a = single.film->estimate(x, y).mean.y, b = twin.film->estimate(x, y).mean.y;
                    close += std::abs(a - b) <= 1e-4 * std::abs(b);
                    largest = std::max(largest, std::abs(a - b));
                    sum_single += a;
                    sum_twin += b;
                }
            CHECK(close > 32 * 32 * 95 / 100);
            CHECK(largest > 0.0); // else the twin were no twin
            CHECK(sum_single == Approx(sum_twin).epsilon(0.02));
            // The normals, albedos and depths of the first hits as well.
            const Image a = single.film->resolve(1.0), b = twin.film->resolve(1.0);
            for (std::size_t c = 6; c < 13; ++c)
                for (int i : {3, 15, 28}) CHECK(a.at(i, i, c) == Approx(b.at(i, i, c)).epsilon(1e-3).margin(1e-5));
        }
    }
}

TEST_CASE("double precision is refused with more than one lane, and by devices without it", "[render][precision]")
{
    const Scene scene = furnace(0.5, 1);
    const Geometry geometry = make_geometry(scene);
    for (const Device* device : double_devices()) {
        RenderOptions options = in_precision(Precision::fp64);
        options.devices = {device->info()};
        options.lanes = 8;
        CHECK_THROWS_AS(Renderer(scene, geometry, false, options), UsageError);
        options.lanes = 0;
        options.devices.front().has_double = false;
        CHECK_THROWS_AS(Renderer(scene, geometry, false, options), DeviceError);
        CHECK_THROWS_WITH(Renderer(scene, geometry, false, options), Catch::Contains("no double precision"));
    }
}
