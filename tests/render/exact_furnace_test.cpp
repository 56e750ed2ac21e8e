// Furnaces: scenes in which every path, or every mean, is known.
#include "support/device_evaluate.h"
#include "support/render_json.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <fmt/format.h>

using namespace etendue;

namespace
{
constexpr double UNIT_ROUNDOFF_FLOAT = 0x1p-24;

// A closed box of radiance 1 and albedo a, seen from inside.
std::string furnace(double albedo, const std::string& depth, const std::string& roulette, const std::string& integrator,
                    int size, int spp)
{
    return fmt::format(R"({{
        "camera": {{"position": [0.1, 0.2, 0.3], "look_at": [0, 0, -1], "vertical_fov": 90}},
        "film": {{"size": [{4}, {4}]}},
        "integrator": {{"type": "{3}", "max_depth": {1}, "roulette": {2}}},
        "sampler": {{"spp": {5}, "seed": 7}},
        "materials": [{{"name": "wall", "type": "diffuse", "albedo": {0:.17g}}}],
        "shapes": [{{"type": "box", "size": [2, 2, 2], "flip_normals": true, "material": "wall",
                     "emission": {{"radiance": 1}}}}]}})",
                       albedo, depth, roulette, integrator, size, spp);
}

// (1 - a^(D+1)) / (1 - a) for the albedo as a float.
double furnace_radiance(double albedo, int depth)
{
    const double a = static_cast<float>(albedo);
    return a == 1.0 ? depth + 1.0 : -std::expm1((depth + 1.0) * std::log(a)) / (1.0 - a);
}

void check_healthy(const JsonPicture& picture)
{
    CHECK(picture.report.accidents() == 0);
    CHECK(picture.report.rays() > 0);
}
} // namespace

TEST_CASE("every path of a furnace gathers the geometric series, to the rounding of its steps", "[render]")
{
    for (const Device& device : test_devices())
        for (const double albedo : {0.5, 0.8, 0.99, 0.9999})
            for (const int depth : {0, 1, 2, 8, 64, 1000}) {
                const int size = depth <= 8 ? 32 : 6;
                const JsonPicture picture = render_json(
                    device, furnace(albedo, std::to_string(depth), "\"off\"", "bsdf", size, depth <= 8 ? 8 : 2));
                const double expected = furnace_radiance(albedo, depth);
                const double bound = (2.0 * depth + 4.0) * UNIT_ROUNDOFF_FLOAT * expected;
                double worst = 0.0;
                for (const PixelEstimate& p : picture.pixels)
                    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(p.mean[c] - expected));
                INFO("albedo " << albedo << " depth " << depth << " expected " << expected << " worst error " << worst);
                CHECK(worst <= bound);
                check_healthy(picture);
            }
}

TEST_CASE("a furnace of albedo 1 gathers exactly one more than its depth", "[render]")
{
    for (const Device& device : test_devices())
        for (const int depth : {0, 1, 7, 500}) {
            const JsonPicture picture =
                render_json(device, furnace(1.0, std::to_string(depth), "\"off\"", "bsdf", 6, 2));
            for (const PixelEstimate& p : picture.pixels) REQUIRE(p.mean == Vec3(depth + 1.0));
            check_healthy(picture);
        }
}

TEST_CASE("roulette and light sampling leave the mean of a furnace alone", "[render]")
{
    struct Case {
        double albedo;
        const char* roulette;
        const char* integrator;
        int spp;
        double wanted;
    };
    const Case cases[] = {
        {0.5, R"({"type": "constant", "probability": 0.8, "start": 1})", "bsdf", 1024, 0.005},
        {0.5, R"({"type": "throughput", "start": 1})", "bsdf", 4096, 0.005},
        {0.98, R"({"type": "throughput", "start": 1})", "bsdf", 2048, 0.01},
        {0.5, R"({"type": "throughput", "start": 1})", "path", 4096, 0.005},
        {0.8, R"({"type": "throughput", "start": 2})", "light", 8192,
         0.05}, // where wall meets wall its variance is infinite
    };
    for (const Device& device : test_devices())
        for (const Case& c : cases) {
            const JsonPicture picture =
                render_json(device, furnace(c.albedo, "\"unlimited\"", c.roulette, c.integrator, 16, c.spp));
            const double expected = 1.0 / (1.0 - static_cast<float>(c.albedo));
            const Verdict v = judge(picture.mean().y, picture.standard_error().y, expected, std::size(cases), c.wanted);
            INFO(c.albedo << " " << c.roulette << " " << c.integrator << ": " << v.text);
            CHECK(v.passed);
            CHECK(v.has_power);
            check_healthy(picture);
        }
}

TEST_CASE("constant roulette has the variance of its closed form", "[render]")
{
    // Var = (1 + a) / ((1 - a) (1 - a^2 / q)) - 1 / (1 - a)^2; here .363636, the fourth moment exists as a^4 < q^3.
    for (const Device& device : test_devices()) {
        const JsonPicture picture =
            render_json(device, furnace(0.5, "\"unlimited\"", R"({"type": "constant", "probability": 0.8, "start": 1})",
                                        "bsdf", 32, 1024));
        double variance = 0.0;
        for (const PixelEstimate& p : picture.pixels)
            variance += p.standard_error.y * p.standard_error.y * static_cast<double>(p.samples);
        variance /= static_cast<double>(picture.pixels.size());
        CHECK(picture.samples() == 1048576);
        CHECK(variance == Approx(0.363636).epsilon(0.05));
    }
}

TEST_CASE("a convex body under a uniform sky shows its albedo, and the sky itself", "[render]")
{
    for (const Device& device : test_devices()) {
        const JsonPicture picture = render_json(device, R"({
            "camera": {"position": [0, 0, 5], "look_at": [0, 0, 0], "vertical_fov": 40},
            "film": {"size": [24, 24]}, "integrator": {"type": "bsdf", "max_depth": 8, "roulette": "off"},
            "sampler": {"spp": 4}, "materials": [{"name": "m", "type": "diffuse", "albedo": 0.7}],
            "shapes": [{"type": "box", "size": [1, 1, 1], "material": "m",
                        "transform": {"rotate": {"axis": [1, 1, 0.3], "angle": 40}}},
                       {"type": "sphere", "radius": 0.6, "material": "m", "transform": {"translate": [-1.3, 0, 0]}}],
            "environment": {"radiance": 1}})");
        const double albedo = static_cast<float>(0.7);
        int body = 0, sky = 0;
        for (const PixelEstimate& p : picture.pixels) {
            // Pixels on a border, and where one body is lit by the other, mix both.
            if (std::abs(p.mean.x - albedo) <= 4.0 * UNIT_ROUNDOFF_FLOAT * albedo) ++body;
            if (p.mean.x == 1.0) ++sky;
            REQUIRE(p.mean.x <= 1.0);
            REQUIRE(p.mean.x >= albedo * albedo * 0.9);
        }
        CHECK(body > 60);
        CHECK(sky > 250);
        check_healthy(picture);
    }
}

TEST_CASE("a furnace inside a sphere is exact at every radius, wherever it lies", "[render]")
{
    for (const Device& device : test_devices())
        for (const double radius : {1e-4, 1.0, 1e4})
            for (const double offset : {0.0, 131072.0}) {
                const double x = offset * radius;
                const JsonPicture picture = render_json(device, fmt::format(R"({{
                    "camera": {{"position": [{0:.17g}, 0, 0], "look_at": [{0:.17g}, 0, {1}], "vertical_fov": 90}},
                    "film": {{"size": [12, 12]}}, "sampler": {{"spp": 8}},
                    "integrator": {{"type": "bsdf", "max_depth": 16, "roulette": "off"}},
                    "materials": [{{"name": "m", "type": "diffuse", "albedo": 0.9}}],
                    "shapes": [{{"type": "sphere", "radius": {2:.17g}, "material": "m", "flip_normals": true,
                                 "emission": {{"radiance": 1}}, "transform": {{"translate": [{0:.17g}, 0, 0]}}}}]}})",
                                                                            x, -radius, radius));
                const double expected = furnace_radiance(0.9, 16);
                INFO("radius " << radius << " offset " << x);
                for (const PixelEstimate& p : picture.pixels)
                    REQUIRE(std::abs(p.mean.x - expected) <= 36.0 * UNIT_ROUNDOFF_FLOAT * expected);
                check_healthy(picture);
            }
}

TEST_CASE("glass under a uniform sky is invisible", "[render]")
{
    for (const Device& device : test_devices())
        for (const double ior : {1.0, 1.0000001, 1.33, 1.5, 2.4, 1.0 / 1.5}) {
            const JsonPicture picture = render_json(device, fmt::format(R"({{
                "camera": {{"position": [0.1, 0.2, 5], "look_at": [0, 0, 0], "vertical_fov": 30}},
                "film": {{"size": [16, 16]}}, "sampler": {{"spp": 16}},
                "integrator": {{"type": "path", "max_depth": 2000, "roulette": "off"}},
                "materials": [{{"name": "g", "type": "dielectric", "ior": {:.17g}}}],
                "shapes": [{{"type": "sphere", "radius": 1, "material": "g"}}], "environment": {{"radiance": 1}}}})",
                                                                        ior));
            INFO("ior " << ior);
            // Light inside may need many reflections to leave; each crossing rounds the weight a little.
            for (const PixelEstimate& p : picture.pixels)
                REQUIRE(std::abs(p.mean.x - 1.0) <= 64.0 * UNIT_ROUNDOFF_FLOAT);
            check_healthy(picture);
        }
}
