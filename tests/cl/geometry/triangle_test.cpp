// The triangle test: no cracks in closed meshes, and distances and barycentrics against long double.
#include "check/rays.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numbers>

using namespace etendue;

namespace
{
// Every ray against all triangles up to one with a negative kind: number of hits ahead of the origin, and the nearest.
const DeviceFunctions functions({"geometry/triangle.h"},
                                {{"closest", "Primitive* float float float float float float -> uint float float float",
                                  R"(
    RayShear shear = make_ray_shear(vec3(in4, in5, in6));
    out0 = (Uint)(0u);
    Hit hit = no_hit((Float)(INFINITY));
    for (uint id = 0; in0[id].a.w >= 0.0; id++) {
        Float t, b1, b2;
        Mask met = triangle_hit(in0[id], vec3(in1, in2, in3), shear, &t, &b1, &b2) & (t > 0.0);
        out0 += met ? (Uint)(1u) : (Uint)(0u);
        hit_update(&hit, met & hit_accept(hit, t, (Uint)(id)), t, (Uint)(id), b1, b2);
    }
    out1 = hit.t; out2 = hit.b1; out3 = hit.b2;)"}});

struct Closest {
    std::vector<std::uint32_t> hits;
    std::vector<float> t, b1, b2;
};

Closest closest(const Device& device, std::vector<Primitive> triangles, const RayColumns& rays, std::uint32_t lanes = 0)
{
    triangles.push_back({make_real4(0, 0, 0, -1), {}, {}});
    const DeviceResults out = functions.evaluate(device, "closest", rays.arguments(triangles), lanes);
    return {out.get<std::uint32_t>(0), out.get<float>(1), out.get<float>(2), out.get<float>(3)};
}

// A closed, bumpy sphere of 320 triangles around the origin.
std::vector<Primitive> bumpy_sphere()
{
    constexpr int RINGS = 11, SEGMENTS = 16;
    Randoms randoms;
    std::array<std::array<Long3, SEGMENTS>, RINGS + 1> vertices;
    for (int ring = 0; ring <= RINGS; ++ring)
        for (int segment = 0; segment < SEGMENTS; ++segment) {
            const long double theta = std::numbers::pi_v<long double> * ring / RINGS;
            const long double phi = 2 * std::numbers::pi_v<long double> * segment / SEGMENTS;
            const bool pole = ring == 0 || ring == RINGS;
            const long double radius = 1 + (pole ? 0 : 0.1l * randoms.number());
            const long double across = pole ? 0 : std::sin(theta);
            vertices[ring][segment] = radius * Long3{across * std::cos(phi), across * std::sin(phi), std::cos(theta)};
        }
    std::vector<Primitive> triangles;
    for (int ring = 0; ring < RINGS; ++ring)
        for (int segment = 0; segment < SEGMENTS; ++segment) {
            const int next = (segment + 1) % SEGMENTS;
            const Long3 &a = vertices[ring][segment], &b = vertices[ring + 1][segment];
            const Long3 &c = vertices[ring + 1][next], &d = vertices[ring][next];
            if (ring < RINGS - 1) triangles.push_back(make_triangle(a, b, c));
            if (ring > 0) triangles.push_back(make_triangle(c, d, a));
        }
    return triangles;
}

// Rays from a point to the vertices and edge midpoints of a mesh and in random directions.
RayColumns rays_at(const std::vector<Primitive>& mesh, const Long3& origin, int randoms_count)
{
    RayColumns rays;
    for (const Primitive& triangle : mesh) {
        const Long3 a = to_long(triangle.a), b = to_long(triangle.b), c = to_long(triangle.c);
        for (const Long3& vertex : {a, b, c}) rays.add(origin, vertex - origin);
        for (const Long3& middle : {0.5l * (a + b), 0.5l * (b + c), 0.5l * (c + a)}) rays.add(origin, middle - origin);
    }
    Randoms randoms;
    for (int i = 0; i < randoms_count; ++i) rays.add(origin, randoms.direction());
    return rays;
}

// Solution of origin + t direction = triangle (Cramer's rule), and what float may get wrong of it.
struct Exact {
    long double t, b1, b2, b_error, t_error;

    Exact(const Primitive& triangle, const Long3& o, const Long3& d)
    {
        const Long3 a = to_long(triangle.a) - o, b = to_long(triangle.b) - o, c = to_long(triangle.c) - o;
        const Long3 normal = cross(b - a, c - a);
        const long double determinant = dot(normal, d);
        t = dot(normal, a) / determinant;
        b1 = dot(cross(c, a), d) / determinant;
        b2 = dot(cross(a, b), d) / determinant;
        // Coordinates across the ray are wrong by 4 roundings of the largest; edge functions by that times an edge.
        std::size_t depth = 0;
        for (std::size_t axis = 1; axis < 3; ++axis)
            if (std::abs(d[axis]) > std::abs(d[depth])) depth = axis;
        std::array<long double, 2> size{}, edge{};
        for (std::size_t k = 0; k < 2; ++k) {
            const std::size_t axis = (depth + 1 + k) % 3;
            const long double slope = d[axis] / d[depth];
            for (const Long3& v : {a, b, c})
                size[k] = std::max(size[k], std::abs(v[axis]) + std::abs(slope * v[depth]));
            for (const Long3& e : {b - a, c - b, a - c})
                edge[k] = std::max(edge[k], std::abs(e[axis] - slope * e[depth]));
        }
        const long double across = std::abs(determinant / d[depth]);
        b_error = 8 * UNIT_ROUNDOFF_OF_FLOAT * (1 + 4 * (size[0] * edge[1] + size[1] * edge[0]) / across);
        const auto [least, most] = std::minmax({a[depth] / d[depth], b[depth] / d[depth], c[depth] / d[depth]});
        t_error = 3 * b_error * (most - least) + 8 * UNIT_ROUNDOFF_OF_FLOAT * std::max(std::abs(least), std::abs(most));
    }
    bool clearly_inside() const { return b1 > b_error && b2 > b_error && 1 - b1 - b2 > b_error && t > t_error; }
    bool clearly_outside() const { return b1 < -b_error || b2 < -b_error || 1 - b1 - b2 < -b_error || t < -t_error; }
};

void check_against_exact(const Primitive& triangle, const RayColumns& rays, std::size_t least)
{
    for (Device& device : test_devices()) {
        const Closest found = closest(device, {triangle}, rays);
        std::size_t inside = 0, outside = 0, wrong_side = 0, wrong_t = 0, wrong_b = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Exact exact(triangle, rays.origin(i), rays.direction(i));
            inside += exact.clearly_inside();
            outside += exact.clearly_outside();
            wrong_side += found.hits[i] ? exact.clearly_outside() : exact.clearly_inside();
            if (!found.hits[i]) continue;
            wrong_t += !(std::abs(found.t[i] - exact.t) <= exact.t_error);
            wrong_b += !(std::abs(found.b1[i] - exact.b1) <= exact.b_error) ||
                       !(std::abs(found.b2[i] - exact.b2) <= exact.b_error);
        }
        CHECK(inside >= least);
        CHECK(outside >= least);
        CHECK(wrong_side == 0);
        CHECK(wrong_t == 0);
        CHECK(wrong_b == 0);
    }
}
} // namespace

TEST_CASE("no ray from inside a closed mesh finds a crack at vertices, edges or elsewhere")
{
    const std::vector<Primitive> mesh = bumpy_sphere();
    REQUIRE(mesh.size() == 320);
    for (Device& device : test_devices())
        for (const Long3& origin : {Long3{0, 0, 0}, Long3{0.3l, -0.2l, 0.41l}, Long3{-0.013l, 0.5l, -0.37l}}) {
            const Closest found = closest(device, mesh, rays_at(mesh, origin, 10000));
            CHECK(std::count(found.hits.begin(), found.hits.end(), 0u) == 0);
        }
}

TEST_CASE("a ray through the diagonal of a quad meets it")
{
    RayColumns rays;
    for (int i = -50; i <= 50; ++i) rays.add({0, 0, 10}, {i * 0.0019l, i * 0.0019l, -1});
    const RayColumns narrow = rays;
    // Add a ray known to slip through other tests; it passes beside the smaller quad.
    rays.add({0, 0, 10}, {0.30458447l, 0.30458447l, -0.9024725l});
    for (Device& device : test_devices())
        for (const long double size : {1.0l, 10.0l}) {
            const std::vector<Primitive> quad{make_triangle({-size, -size, 0}, {size, -size, 0}, {size, size, 0}),
                                              make_triangle({size, size, 0}, {-size, size, 0}, {-size, -size, 0})};
            const Closest found = closest(device, quad, size > 1 ? rays : narrow);
            CHECK(std::count(found.hits.begin(), found.hits.end(), 0u) == 0);
        }
}

TEST_CASE("distance and barycentrics of a triangle agree with long double")
{
    Randoms randoms;
    for (int i = 0; i < 8; ++i) {
        const Long3 a = randoms.point(), b = randoms.point(), c = randoms.point();
        RayColumns rays;
        for (int k = 0; k < 1000; ++k) {
            const Long3 origin = 3.0l * randoms.point();
            const long double u = 0.6l + 0.6l * randoms.number(), v = 0.6l + 0.6l * randoms.number();
            const Long3 target = a + u * (b - a) + v * (c - a);
            rays.add(origin, (1.0l + 0.9l * randoms.number()) * (target - origin));
        }
        check_against_exact(make_triangle(a, b, c), rays, 100);
    }
}

TEST_CASE("needles a million times longer than wide are met where they are, and without a crack between two")
{
    const Primitive needle = make_triangle({0, 0, 0}, {1, 0, 0}, {0.5l, 1e-6l, 0});
    Randoms randoms;
    RayColumns rays;
    for (int k = 0; k < 4000; ++k) {
        const long double x = 0.5l + 0.5l * randoms.number(), y = 5e-7l + 5e-7l * randoms.number();
        rays.add({x, y, 1 + randoms.number()}, {0, 0, -1});
    }
    check_against_exact(needle, rays, 1000);
    // Aim between two needles, within the plane of their edge: rounding would turn other rays away from both.
    RayColumns in_plane;
    const Long3 long_a{0, 0, 0}, long_b{1, 0, 0}, above{0.5l, 1e-6l, 0}, below{0.5l, -1e-6l, 0};
    for (int k = 0; k < 1000; ++k) in_plane.add({0.3l, 0, 1}, {0.2l + 0.49l * randoms.number(), 0, -1});
    for (Device& device : test_devices()) {
        const Closest found =
            closest(device, {make_triangle(long_a, long_b, above), make_triangle(long_b, long_a, below)}, in_plane);
        CHECK(std::count(found.hits.begin(), found.hits.end(), 0u) == 0);
    }
}

TEST_CASE("both windings of a triangle are met by the same rays, and a triangle without area by none")
{
    const std::vector<Primitive> mesh = bumpy_sphere();
    std::vector<Primitive> turned;
    for (const Primitive& triangle : mesh) turned.push_back({triangle.a, triangle.c, triangle.b});
    for (Primitive& triangle : turned) triangle.a.s[3] = PRIMITIVE_TRIANGLE;
    const RayColumns rays = rays_at(mesh, {0.3l, -0.2l, 0.41l}, 1000);
    const std::vector<Primitive> flat{make_triangle({-1, 0, 0}, {1, 0, 0}, {0, 0, 0}),
                                      make_triangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0})};
    RayColumns at_flat;
    for (int i = -5; i <= 5; ++i) at_flat.add({0, 0, 1}, {i * 0.1l, 0, -1});
    for (Device& device : test_devices()) {
        CHECK(closest(device, mesh, rays).hits == closest(device, turned, rays).hits);
        CHECK(closest(device, flat, at_flat).hits == std::vector<std::uint32_t>(at_flat.size(), 0u));
    }
}

TEST_CASE("a triangle is met with the same bits at every number of lanes")
{
    const std::vector<Primitive> mesh = bumpy_sphere();
    const RayColumns rays = rays_at(mesh, {0.3l, -0.2l, 0.41l}, 501);
    for (Device& device : test_devices()) {
        const Closest one = closest(device, mesh, rays, 1);
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const Closest several = closest(device, mesh, rays, lanes);
            CAPTURE(lanes);
            CHECK(one.hits == several.hits);
            CHECK(one.t == several.t);
            CHECK(one.b1 == several.b1);
            CHECK(one.b2 == several.b2);
        }
    }
}
