// Triangles together leave no crack: closed meshes from inside, fans, grids; and triangles that are none are not met.
#include "check/closed_meshes.h"
#include "support/device_lanes.h"

#include <algorithm>
#include <limits>

using namespace etendue;

namespace
{
// Input 7: the number of triangles. Output: how many the ray meets ahead of its origin.
const DeviceFunctions functions({"geometry/triangle.h"},
                                {{"count_hits", "Primitive* float float float float float float uint* -> uint", R"(
    Vec3 origin = vec3(in1, in2, in3);
    RayShear shear = make_ray_shear(vec3(in4, in5, in6));
    out0 = (Uint)(0u);
    for (uint id = 0; id < in7[0]; id++) {
        Float t, b1, b2;
        Mask met = triangle_hit(in0[id], origin, shear, &t, &b1, &b2) & (t > 0.0);
        out0 += met ? (Uint)(1u) : (Uint)(0u);
    })"}});

std::vector<DeviceArgument> arguments(const std::vector<Primitive>& mesh, const RayColumns& rays)
{
    return rays.arguments(mesh, {std::vector<std::uint32_t>{static_cast<std::uint32_t>(mesh.size())}});
}

std::size_t misses(const Device& device, const std::vector<Primitive>& mesh, const RayColumns& rays)
{
    const auto hits = functions.evaluate<std::uint32_t>(device, "count_hits", arguments(mesh, rays));
    return static_cast<std::size_t>(std::count(hits.begin(), hits.end(), 0u));
}

enum class Target { VERTEX, EDGE_MIDDLE, ANYWHERE };

// Rays from inside; the origin is rounded first, so that the direction aims from where the ray begins.
RayColumns rays_from_inside(const ClosedMesh& mesh, Target target, std::size_t count)
{
    Randoms randoms;
    RayColumns rays;
    for (std::size_t i = 0; i < count; ++i) {
        const Long3 origin = to_long(round_to_float(mesh.inside(randoms)));
        const Primitive& triangle = mesh.triangles[i % mesh.triangles.size()];
        const std::size_t which = i / mesh.triangles.size() % 3;
        const Long3 vertices[] = {to_long(triangle.a), to_long(triangle.b), to_long(triangle.c)};
        const Long3 middle = 0.5l * (vertices[which] + vertices[(which + 1) % 3]);
        if (target == Target::VERTEX) rays.add(origin, vertices[which] - origin);
        if (target == Target::EDGE_MIDDLE) rays.add(origin, middle - origin);
        if (target == Target::ANYWHERE) rays.add(origin, randoms.direction());
    }
    return rays;
}

void check_no_cracks(const std::vector<ClosedMesh>& meshes, std::size_t count)
{
    for (const ClosedMesh& mesh : meshes)
        for (const Target target : {Target::VERTEX, Target::EDGE_MIDDLE, Target::ANYWHERE}) {
            const RayColumns rays = rays_from_inside(mesh, target, count);
            CAPTURE(mesh.name, static_cast<int>(target), count);
            for (Device& device : test_devices()) CHECK(misses(device, mesh.triangles, rays) == 0);
        }
}
} // namespace

TEST_CASE("of 100000 rays from inside to vertices, to edges and anywhere, none leaves a closed mesh")
{
    check_no_cracks(make_closed_meshes({}), 100000);
}

TEST_CASE("closed meshes far from the origin, whose vertices are rounded coarsely, have no cracks either")
{
    check_no_cracks(make_closed_meshes({1.0l, {148376.0l / 65536, 1234, -223423.0l / 65536}}), 10000);
    check_no_cracks(make_closed_meshes({1000.0l, {148376, 1234, -223423}}), 10000);
}

TEST_CASE("a fan of 10000 triangles around one vertex has no crack at the vertex or along its edges")
{
    constexpr int COUNT = 10000;
    const auto rim = [](int i) {
        const long double phi = 2 * std::numbers::pi_v<long double> * (i % COUNT) / COUNT;
        return Long3{std::cos(phi), std::sin(phi), 0.1l * std::sin(5 * phi)};
    };
    const Long3 apex{0, 0, 0.25l};
    std::vector<Primitive> fan;
    for (int i = 0; i < COUNT; ++i) fan.push_back(make_triangle(apex, rim(i), rim(i + 1)));
    Randoms randoms;
    RayColumns rays;
    for (int i = 0; i < 2000; ++i) {
        const Long3 origin{0.3l * randoms.number(), 0.3l * randoms.number(), 3};
        const Long3 on_edge = apex + (0.5l + 0.4l * randoms.number()) * (rim(i * 5) - apex);
        rays.add(origin, (i % 4 == 0 ? apex : on_edge) - origin);
    }
    for (Device& device : test_devices()) CHECK(misses(device, fan, rays) == 0);
}

TEST_CASE("vertical rays at the vertices, edges and diagonals of an integer grid meet it")
{
    std::vector<Primitive> grid;
    for (int x = 0; x < 8; ++x)
        for (int y = 0; y < 8; ++y) {
            const auto at = [&](int dx, int dy) {
                return Long3{static_cast<long double>(x + dx), static_cast<long double>(y + dy),
                             static_cast<long double>((x + dx) * (y + dy) % 3)};
            };
            grid.push_back(make_triangle(at(0, 0), at(1, 0), at(1, 1)));
            grid.push_back(make_triangle(at(1, 1), at(0, 1), at(0, 0)));
        }
    RayColumns rays;
    for (int x = 0; x <= 32; ++x)
        for (int y = 0; y <= 32; ++y)
            for (const long double zero : {0.0l, -0.0l}) {
                rays.add({x / 4.0l, y / 4.0l, 10}, {zero, zero, -1});
                rays.add({x / 4.0l, y / 4.0l, -10}, {zero, zero, 1});
            }
    for (Device& device : test_devices()) CHECK(misses(device, grid, rays) == 0);
}

TEST_CASE("rays to the shared vertices of a turned grid of 32 x 32 quads meet it")
{
    // Two turns about different axes, so that no coordinate is round.
    const auto turned = [](long double x, long double y) {
        const long double c = std::cos(0.7l), s = std::sin(0.7l), k = std::cos(0.4l), h = std::sin(0.4l);
        const long double x1 = c * x - s * y, y1 = s * x + c * y;
        return Long3{x1, k * y1, h * y1};
    };
    std::vector<Primitive> grid;
    for (int x = -16; x < 16; ++x)
        for (int y = -16; y < 16; ++y) {
            const Long3 a = turned(x / 16.0l, y / 16.0l), b = turned((x + 1) / 16.0l, y / 16.0l);
            const Long3 c = turned((x + 1) / 16.0l, (y + 1) / 16.0l), d = turned(x / 16.0l, (y + 1) / 16.0l);
            grid.push_back(make_triangle(a, b, c));
            grid.push_back(make_triangle(c, d, a));
        }
    RayColumns rays;
    for (int x = -15; x <= 15; ++x)
        for (int y = -15; y <= 15; ++y) {
            const Long3 origin{0.25l, -0.5l, 5}, vertex = to_long(round_to_float(turned(x / 16.0l, y / 16.0l)));
            rays.add(origin, vertex - origin);
            rays.add(vertex + Long3{0, 0, 4}, {0, 0, -1});
        }
    for (Device& device : test_devices()) CHECK(misses(device, grid, rays) == 0);
}

TEST_CASE("a triangle with a coordinate that is not finite, or with two equal vertices, is met by no ray")
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const Primitive good = make_triangle({-1, -1, 0}, {1.1l, -0.9l, 0.1l}, {0, 1, -0.2l});
    std::vector<Primitive> bad;
    for (const float value : {nan, inf, -inf})
        for (const std::size_t axis : {0u, 1u, 2u})
            for (const std::size_t vertex : {0u, 1u, 2u}) {
                bad.push_back(good);
                (vertex == 0 ? bad.back().a : vertex == 1 ? bad.back().b : bad.back().c).s[axis] = value;
            }
    bad.push_back({good.a, good.a, good.c});
    bad.push_back({good.a, good.b, good.b});
    bad.push_back({good.a, good.b, good.a});
    bad.push_back({good.a, good.a, good.a});
    Randoms randoms;
    RayColumns rays;
    for (int i = 0; i < 5000; ++i) {
        const Long3 origin = to_long(round_to_float(2.0l * randoms.direction()));
        const Long3 vertices[] = {to_long(good.a), to_long(good.b), to_long(good.c)};
        const Long3 target = i % 4 < 3 ? vertices[i % 4] : 0.3l * randoms.point();
        rays.add(origin, target - origin);
    }
    for (Device& device : test_devices()) {
        CHECK(misses(device, {good}, rays) < rays.size());
        CHECK(misses(device, bad, rays) == rays.size());
    }
}

TEST_CASE("the same rays meet as many triangles at every number of lanes")
{
    const ClosedMesh torus = make_closed_meshes({}).back();
    const RayColumns rays = rays_from_inside(torus, Target::VERTEX, 501);
    for (Device& device : test_devices())
        evaluate_in_all_lanes(functions, device, "count_hits", arguments(torus.triangles, rays));
}
