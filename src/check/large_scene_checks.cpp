// The catalogue's large cases, as JSON made of loops.
#include "check/large_scene_checks.h"

#include "check/scene_checks.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace etendue
{
namespace
{
std::string triangles(const std::string& positions, const std::string& indices, const std::string& more)
{
    return fmt::format(R"({{"type": "triangles", "positions": [{}], "indices": [{}], {}}})", positions, indices, more);
}

void append(std::string& list, const std::string& element)
{
    list += (list.empty() ? "" : ",") + element;
}

// The unit square 1 above a floor, cut into columns x rows rectangles of very unequal size: two triangles, two lights
// each.
std::string many_lights()
{
    constexpr int COLUMNS = 316, ROWS = 158;
    std::string positions, indices;
    for (int row = 0; row <= ROWS; ++row)
        for (int column = 0; column <= COLUMNS; ++column) {
            const double x = static_cast<double>(column) / COLUMNS, y = static_cast<double>(row) / ROWS;
            append(positions, fmt::format("[{},{},0]", x * x - 0.5, y * y - 0.5));
        }
    for (int row = 0; row < ROWS; ++row)
        for (int column = 0; column < COLUMNS; ++column) {
            const int a = row * (COLUMNS + 1) + column, b = a + COLUMNS + 1;
            append(indices, fmt::format("[{},{},{}],[{},{},{}]", a, a + 1, b + 1, a, b + 1, b));
        }
    const std::string light = triangles(
        positions, indices,
        R"("radiance": 3, "transform": [{"rotate": {"axis": [1, 0, 0], "angle": 90}}, {"translate": [0, 1, 0]}])");
    return R"json({
"expect": {"group": "analytic", "because": "A unit square 1 above the point, cut into 99,856 triangles: the same light.",
           "where": {"rho": "float(0.6)", "A": 0.5, "F": "4*A/sqrt(1+A^2)*atan(A/sqrt(1+A^2))/pi"},
           "facts": [{"subject": "mean", "rule": "stat", "value": "rho*3*F"}]},
"camera": {"position": [3, 0.2, 0.1], "look_at": [0, 0, 0], "vertical_fov": 1e-7},
"film": {"size": [128, 128]},
"integrator": {"type": "path", "max_depth": 4, "roulette": "off"},
"sampler": {"type": "independent", "spp": 32},
"materials": [{"name": "floor", "type": "diffuse", "albedo": 0.6}],
"shapes": [{"type": "rectangle", "size": [10, 10], "material": "floor",
            "transform": {"rotate": {"axis": [1, 0, 0], "angle": -90}}}],
"lights": [)json" +
           light + "]}";
}

std::string under_sky(const std::string& expect, const std::string& camera, const std::string& shape)
{
    return fmt::format(R"({{
"expect": {{"group": "stiff", {}}},
"camera": {}, "film": {{"size": [32, 32]}},
"integrator": {{"type": "bsdf", "max_depth": 8, "roulette": "off"}},
"sampler": {{"type": "independent", "spp": 1}},
"materials": [{{"name": "body", "type": "diffuse", "albedo": 0.8}}],
"shapes": [{}], "environment": {{"radiance": 1}}, "accelerator": "lbvh"}})",
                       expect, camera, shape);
}

std::string identical_triangles()
{
    std::string indices;
    for (int i = 0; i < 32768; ++i) append(indices, "[0,1,2],[0,2,3]");
    return under_sky(
        R"json("because": "Triangles in one place are one, the first.",
           "facts": [{"subject": "pixels", "rule": "round", "value": "float(0.8)", "tolerance": 4},
                     {"subject": "same", "rule": "exact", "overrides": ["accelerator=none"]}])json",
        R"({"position": [0.1, 2, 0.3], "look_at": [0, 0, 0], "vertical_fov": 20})",
        triangles("[-1,0,1],[1,0,1],[1,0,-1],[-1,0,-1]", indices, R"("material": "body")"));
}

// Around one vertex, from above: 10^4 slivers of 6e-4 radians.
std::string fan()
{
    constexpr int SLIVERS = 10000;
    std::string positions = "[0,0,0]", indices;
    for (int i = 0; i < SLIVERS; ++i) {
        const double angle = 2 * std::numbers::pi * i / SLIVERS;
        append(positions, fmt::format("[{},0,{}]", std::cos(angle), std::sin(angle)));
        append(indices, fmt::format("[0,{},{}]", 1 + (i + 1) % SLIVERS, 1 + i));
    }
    return under_sky(
        R"json("because": "Bodies without hollows, albedo a, under a sky of radiance 1: a where the fan is, else 1; the tree finds what testing everything finds.",
           "facts": [{"subject": "pixels", "rule": "round", "value": "float(0.8)", "tolerance": 4, "or": 1,
                      "or_share": [0.4, 0.95]},
                     {"subject": "same", "rule": "exact", "overrides": ["accelerator=none"]}])json",
        R"({"position": [0.1, 3, 0.2], "look_at": [0, 0, 0], "vertical_fov": 45})",
        triangles(positions, indices, R"("material": "body")"));
}

std::string nested_triangles()
{
    std::string positions, indices;
    for (int i = 0; i < 65536; ++i) {
        const double size = 1.0 + i / 65536.0;
        append(positions, fmt::format("[{},{},0],[{},{},0],[0,{},0]", -size, -0.5 * size, size, -0.5 * size, size));
        append(indices, fmt::format("[{},{},{}]", 3 * i, 3 * i + 1, 3 * i + 2));
    }
    return under_sky(
        R"("because": "Nested triangles have one centroid: the tree is split all the same.",
           "facts": [{"subject": "same", "rule": "exact", "overrides": ["accelerator=none"]}])",
        R"({"position": [0, 0, 4], "look_at": [0, 0, 0], "vertical_fov": 45})",
        triangles(positions, indices, R"("material": "body")"));
}

Check large_scene(const char* group, const char* name, std::size_t statistical_tests, std::string (*text)())
{
    Check check;
    check.group = group;
    check.name = name;
    check.is_long = true;
    check.statistical_tests = statistical_tests;
    check.run = [name, text](const CheckContext& context) {
        SceneSource source;
        source.name = name;
        source.file = std::string(name) + ".json";
        source.text = text();
        return scene_check(source)->run(context);
    };
    return check;
}
} // namespace

std::vector<Check> large_scene_checks()
{
    return {large_scene("analytic", "L7-99856-triangles", 1, many_lights), large_scene("stiff", "G1-fan-10000", 0, fan),
            large_scene("stiff", "G3-65536-identical-triangles", 0, identical_triangles),
            large_scene("stiff", "B2-65536-nested-triangles", 0, nested_triangles)};
}
} // namespace etendue
