// Direct light against closed forms: Lambert's rectangle by four estimators, several lights, occluders, lights from
// behind and lights very near.
#include "support/device_evaluate.h"
#include "support/form_factors.h"
#include "support/render_json.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <fmt/format.h>

using namespace etendue;

namespace
{
constexpr double ALBEDO = 0.6;

// One point of a floor, at the origin, with 8 spp samples in each of 64 pixels, seen obliquely from below any light;
// `lights` and `shapes` are JSON lists.
std::string floor_point(const std::string& integrator, int spp, const std::string& lights,
                        const std::string& shapes = "", double eye = 0.3)
{
    return fmt::format(R"({{
        "camera": {{"position": [0, {5}, {5}], "look_at": [0, 0, 0], "vertical_fov": 1e-6}},
        "film": {{"size": [8, 8]}},
        "integrator": {{"type": "{0}", "max_depth": 1, "roulette": "off"}},
        "sampler": {{"spp": {1}, "seed": 3}},
        "materials": [{{"name": "floor", "type": "diffuse", "albedo": {4}}},
                      {{"name": "black", "type": "diffuse", "albedo": 0}}],
        "shapes": [{{"type": "rectangle", "size": [8, 8], "material": "floor",
                     "transform": {{"rotate": {{"axis": [1, 0, 0], "angle": -90}}}}}}{3}],
        "lights": [{2}]}})",
                       integrator, 8 * spp, lights, shapes, ALBEDO, eye);
}

// A rectangle in the plane y = height that looks down, from (x0, z0) to (x1, z1).
std::string ceiling_light(double x0, double x1, double z0, double z1, double height, double radiance)
{
    return fmt::format(R"({{"type": "triangles", "radiance": {5:.17g}, "indices": [[0,1,2],[0,2,3]],
        "positions": [[{0:.17g},{4:.17g},{2:.17g}],[{1:.17g},{4:.17g},{2:.17g}],[{1:.17g},{4:.17g},{3:.17g}],[{0:.17g},{4:.17g},{3:.17g}]]}})",
                       x0, x1, z0, z1, height, radiance);
}

double rectangle_factor(double x0, double x1, double z0, double z1, double height)
{
    return polygon_form_factor(Vec3(0), Vec3(0, 1, 0),
                               {{x0, height, z0}, {x1, height, z0}, {x1, height, z1}, {x0, height, z1}});
}

void check_mean(const JsonPicture& picture, double expected, std::size_t tests, double wanted, const std::string& what)
{
    const Verdict v = judge(picture.mean().x, picture.standard_error().x, expected, tests, wanted);
    INFO(what << ": " << v.text);
    CHECK(v.passed);
    CHECK(v.has_power);
    CHECK(picture.report.accidents() == 0);
}
} // namespace

TEST_CASE("four estimators agree with Lambert on a rectangle", "[render]")
{
    const double expected = static_cast<float>(ALBEDO) * 5.0 * rectangle_factor(-0.3, 0.9, -0.5, 0.4, 0.8);
    const std::pair<const char*, int> estimators[] = {
        {"hemisphere", 24576}, {"bsdf", 16384}, {"light", 1024}, {"path", 1024}};
    for (const Device& device : test_devices())
        for (const auto& [integrator, spp] : estimators)
            check_mean(render_json(device, floor_point(integrator, spp, ceiling_light(-0.3, 0.9, -0.5, 0.4, 0.8, 5.0))),
                       expected, 4, 0.005, integrator);
}

TEST_CASE("disk and sphere lights agree with their closed forms", "[render]")
{
    const std::string disk = R"({"type": "disk", "radius": 0.6, "radiance": 4,
        "transform": [{"rotate": {"axis": [1, 0, 0], "angle": 90}}, {"translate": [0.9, 0.8, 0]}]})";
    const std::string sphere =
        R"({"type": "sphere", "radius": 0.5, "radiance": 4, "transform": {"translate": [0.6, 0.8, 0]}})";
    const double albedo = static_cast<float>(ALBEDO);
    const double from_disk = albedo * 4.0 * disk_form_factor(0.6, 0.8, 0.9);
    const double from_sphere = albedo * 4.0 * sphere_form_factor(0.5, 1.0, std::acos(0.8));
    for (const Device& device : test_devices())
        for (const char* integrator : {"bsdf", "light", "path"}) {
            const int spp = std::string(integrator) == "bsdf" ? 16384 : 1024;
            check_mean(render_json(device, floor_point(integrator, spp, disk)), from_disk, 6, 0.01, integrator);
            check_mean(render_json(device, floor_point(integrator, spp, sphere)), from_sphere, 6, 0.01, integrator);
        }
}

TEST_CASE("two lights of unequal area and radiance add up", "[render]")
{
    const std::string lights =
        ceiling_light(-1.5, -0.5, -0.5, 0.5, 1.0, 1.0) + "," + ceiling_light(0.5, 0.6, 0.0, 0.1, 0.7, 300.0);
    const double expected = static_cast<float>(ALBEDO) * (rectangle_factor(-1.5, -0.5, -0.5, 0.5, 1.0) +
                                                          300.0 * rectangle_factor(0.5, 0.6, 0.0, 0.1, 0.7));
    for (const Device& device : test_devices())
        for (const char* integrator : {"light", "path"})
            check_mean(render_json(device, floor_point(integrator, 4096, lights)), expected, 2, 0.005, integrator);
}

TEST_CASE("a light gives the same from each of the four quadrants", "[render]")
{
    for (const Device& device : test_devices())
        for (const double sx : {-1.0, 1.0})
            for (const double sz : {-1.0, 1.0}) {
                const double x0 = std::min(sx * 0.2, sx), x1 = std::max(sx * 0.2, sx);
                const double z0 = std::min(sz * 0.1, sz * 0.7), z1 = std::max(sz * 0.1, sz * 0.7);
                const double expected = static_cast<float>(ALBEDO) * 2.0 * rectangle_factor(x0, x1, z0, z1, 0.9);
                for (const char* integrator : {"bsdf", "path"})
                    check_mean(
                        render_json(device, floor_point(integrator, std::string(integrator) == "bsdf" ? 16384 : 1024,
                                                        ceiling_light(x0, x1, z0, z1, 0.9, 2.0))),
                        expected, 8, 0.01, integrator);
            }
}

TEST_CASE("an occluder close to a light hides what is behind it and nothing else", "[render]")
{
    // A plate just below the light covers x > 0.
    for (const Device& device : test_devices())
        for (const double gap : {1e-3, 1e-5}) {
            const std::string plate = fmt::format(R"(, {{"type": "rectangle", "size": [2, 4], "material": "black",
                "transform": [{{"rotate": {{"axis": [1, 0, 0], "angle": 90}}}}, {{"translate": [1, {:.17g}, 0]}}]}})",
                                                  0.8 - gap);
            const double expected = static_cast<float>(ALBEDO) * 3.0 * rectangle_factor(-0.5, 0.0, -0.4, 0.4, 0.8);
            for (const char* integrator : {"light", "path"})
                check_mean(render_json(device, floor_point(integrator, 4096,
                                                           ceiling_light(-0.5, 0.5, -0.4, 0.4, 0.8, 3.0), plate)),
                           expected, 4, 0.01, fmt::format("{} gap {}", integrator, gap));
        }
}

TEST_CASE("a light seen from behind, below the horizon or behind a ceiling gives exactly nothing", "[render]")
{
    const std::string behind = R"({"type": "rectangle", "size": [1, 1], "radiance": 5,
        "transform": [{"rotate": {"axis": [1, 0, 0], "angle": -90}}, {"translate": [0, 0.8, 0]}]})";
    const std::string below = ceiling_light(-0.5, 0.5, -0.5, 0.5, -0.5, 5.0);
    const std::string above = ceiling_light(-0.5, 0.5, -0.5, 0.5, 0.8 + 1e-5, 5.0);
    const std::string ceiling = R"(, {"type": "rectangle", "size": [6, 6], "material": "black",
        "transform": [{"rotate": {"axis": [1, 0, 0], "angle": 90}}, {"translate": [0, 0.8, 0]}]})";
    for (const Device& device : test_devices())
        for (const char* integrator : {"hemisphere", "bsdf", "light", "path"}) {
            INFO(integrator);
            CHECK(render_json(device, floor_point(integrator, 256, behind)).mean() == Vec3(0));
            CHECK(render_json(device, floor_point(integrator, 256, below)).mean() == Vec3(0));
            CHECK(render_json(device, floor_point(integrator, 256, above, ceiling, 0.3)).mean() == Vec3(0));
        }
}

TEST_CASE("a very near light is bounded with multiple importance sampling and lawfully noisy without", "[render]")
{
    const double albedo = static_cast<float>(ALBEDO);
    for (const Device& device : test_devices())
        for (const double e : {1.0, 0.1, 0.01, 1e-3}) {
            const std::string light = ceiling_light(-0.5, 0.5, -0.5, 0.5, e, 1.0);
            const double expected = albedo * rectangle_factor(-0.5, 0.5, -0.5, 0.5, e);
            const JsonPicture mis = render_json(device, floor_point("path", 4096, light, "", e / 2));
            check_mean(mis, expected, 4, 0.01, fmt::format("distance {}", e));
            // Light sampling alone: relative variance A / (3 pi e^2), within what 64 x 16384 samples can tell of it.
            if (e != 0.1) continue;
            const JsonPicture noisy = render_json(device, floor_point("light", 16384, light, "", e / 2));
            double variance = 0.0;
            for (const PixelEstimate& p : noisy.pixels)
                variance += p.standard_error.x * p.standard_error.x * static_cast<double>(p.samples) / 64.0;
            CHECK(variance / (expected * expected) == Approx(1.0 / (3.0 * 3.14159265 * e * e)).epsilon(0.1));
        }
}

TEST_CASE("multiple importance sampling keeps Veach's bound on its variance", "[render]")
{
    const std::string light = ceiling_light(-0.6, 0.6, -0.5, 0.7, 0.5, 2.0);
    const auto variance = [](const JsonPicture& picture) {
        double sum = 0.0;
        for (const PixelEstimate& p : picture.pixels)
            sum += p.standard_error.x * p.standard_error.x * static_cast<double>(p.samples);
        return sum / static_cast<double>(picture.pixels.size());
    };
    for (const Device& device : test_devices()) {
        const JsonPicture bsdf = render_json(device, floor_point("bsdf", 4096, light));
        const JsonPicture lights = render_json(device, floor_point("light", 4096, light));
        const JsonPicture mis = render_json(device, floor_point("path", 4096, light));
        const double mu = static_cast<float>(ALBEDO) * 2.0 * rectangle_factor(-0.6, 0.6, -0.5, 0.7, 0.5);
        INFO(variance(bsdf) << " " << variance(lights) << " " << variance(mis) << " mu " << mu);
        CHECK(variance(mis) <= std::min(variance(bsdf), variance(lights)) + mu * mu / 2.0);
        CHECK(variance(mis) < 1.05 * std::min(variance(bsdf), variance(lights)));
    }
}
