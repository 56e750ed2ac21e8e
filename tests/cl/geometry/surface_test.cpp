// Shading points: position, error bound, normals and area against long double.
#include "check/rays.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numbers>

using namespace etendue;

namespace
{
// Inputs 7 to 9: t, b1, b2 of a hit of primitive 0.
const DeviceFunctions
    functions({"geometry/surface.h"},
              {{"surface",
                "Primitive* float float float float float float float float float PrimitiveSurface* real4* -> "
                "float float float float float float float float float float float float float uint uint float",
                R"(
    Ray ray = {vec3(in1, in2, in3), vec3(in4, in5, in6), (Float)(INFINITY), (Uint)(NO_INDEX), (Uint)(NO_INDEX)};
    Hit hit = {in7, (Uint)(0u), in8, in9};
    Surface s = make_surface(in0, in10, in11, to_mask(1), ray, hit);
    out0 = s.p.x; out1 = s.p.y; out2 = s.p.z; out3 = s.ng.x; out4 = s.ng.y; out5 = s.ng.z;
    out6 = s.ns.x; out7 = s.ns.y; out8 = s.ns.z; out9 = s.wo.x; out10 = s.wo.y; out11 = s.wo.z;
    out12 = s.p_error; out13 = s.material; out14 = s.light; out15 = s.area;)"}});

constexpr long double U = UNIT_ROUNDOFF_OF_FLOAT;

struct Hits {
    RayColumns rays;
    std::vector<float> t, b1, b2;

    void add(const Long3& origin, const Long3& direction, long double distance, long double u = 0, long double v = 0)
    {
        rays.add(origin, direction);
        t.push_back(static_cast<float>(distance));
        b1.push_back(static_cast<float>(u));
        b2.push_back(static_cast<float>(v));
    }
};

struct Surfaces {
    DeviceResults out;

    Long3 vector(std::size_t first, std::size_t i) const
    {
        return {number(first, i), number(first + 1, i), number(first + 2, i)};
    }
    float number(std::size_t output, std::size_t i) const
    {
        float value;
        std::memcpy(&value, &out.outputs[output][i], 4);
        return value;
    }
    Long3 p(std::size_t i) const { return vector(0, i); }
    Long3 ng(std::size_t i) const { return vector(3, i); }
    Long3 ns(std::size_t i) const { return vector(6, i); }
    Long3 wo(std::size_t i) const { return vector(9, i); }
    long double p_error(std::size_t i) const { return number(12, i); }
    long double area(std::size_t i) const { return number(15, i); }
};

Surfaces surfaces_of(const Device& device, const Primitive& primitive, const Hits& hits,
                     PrimitiveSurface look = {7, 9, NO_INDEX, 0}, std::vector<real4> normals = {},
                     std::uint32_t lanes = 0)
{
    normals.resize(std::max<std::size_t>(normals.size(), 3));
    return {functions.evaluate(device, "surface",
                               hits.rays.arguments({primitive}, {hits.t, hits.b1, hits.b2, std::vector{look}, normals}),
                               lanes)};
}

// Hits of a triangle all over it, seen from random directions.
Hits hits_of_triangle(std::size_t count)
{
    Randoms randoms;
    Hits hits;
    while (hits.t.size() < count) {
        const long double u = 0.5l + 0.5l * randoms.number(), v = 0.5l + 0.5l * randoms.number();
        if (u + v <= 1) hits.add({}, randoms.direction(), 1, u, v);
    }
    return hits;
}

const Primitive TILTED = make_triangle({-0.4l, 0.3l, 0.9l}, {0.7l, 0.1l, -0.5l}, {0.2l, -0.8l, 0.6l});
} // namespace

TEST_CASE("the point of a triangle is off its plane by no more than its error bound")
{
    Randoms randoms;
    const Hits hits = hits_of_triangle(2000);
    for (int k = 0; k < 8; ++k) {
        const Primitive triangle = make_triangle(randoms.point(), randoms.point(), randoms.point());
        const Long3 a = to_long(triangle.a), b = to_long(triangle.b), c = to_long(triangle.c);
        const Long3 normal = cross(b - a, c - a);
        const long double edge = std::max({length(b - a), length(c - a)});
        const long double slenderness = edge * edge / length(normal);
        for (Device& device : test_devices()) {
            const Surfaces found = surfaces_of(device, triangle, hits);
            std::size_t beyond_bound = 0, loose = 0, elsewhere = 0, wrong_normal = 0, wrong_area = 0;
            for (std::size_t i = 0; i < hits.t.size(); ++i) {
                const Long3 p =
                    a + static_cast<long double>(hits.b1[i]) * (b - a) + static_cast<long double>(hits.b2[i]) * (c - a);
                beyond_bound += !(std::abs(dot(found.p(i) - p, unit(normal))) <= found.p_error(i));
                loose += !(found.p_error(i) <= 8 * U);
                elsewhere += !(length(found.p(i) - p) <= 3 * found.p_error(i));
                wrong_normal += !(length(found.ng(i) - unit(normal)) <= 8 * U * (1 + slenderness));
                wrong_area += !(std::abs(found.area(i) * 2 / length(normal) - 1) <= 8 * U * (1 + slenderness));
            }
            CHECK(beyond_bound == 0);
            CHECK(loose == 0);
            CHECK(elsewhere == 0);
            CHECK(wrong_normal == 0);
            CHECK(wrong_area == 0);
        }
    }
}

TEST_CASE("points of spheres and disks lie on them within the error bound, with normal and area")
{
    Randoms randoms;
    for (const long double radius : {1e-3l, 0.8l}) {
        const Primitive sphere = make_sphere({0.3l, -0.2l, 0.1l}, radius);
        const Primitive disk = make_disk({0.3l, -0.2l, 0.1l}, unit({1, 2, -3}), radius);
        const Long3 centre = to_long(sphere.a), normal = to_long(disk.b);
        const long double r = sphere.b.s[0], pi = std::numbers::pi_v<long double>;
        Hits on_sphere, on_disk;
        for (int i = 0; i < 2000; ++i) {
            const Long3 side = randoms.direction();
            const Long3 origin = centre + 2.0l * randoms.direction();
            const auto aim = [&](Hits& hits, const Long3& target) {
                hits.add(origin, unit(target - origin), length(target - origin));
            };
            aim(on_sphere, centre + r * side);
            aim(on_disk, centre + r * std::abs(randoms.number()) * unit(cross(side, normal)));
        }
        for (Device& device : test_devices()) {
            const Surfaces spheres = surfaces_of(device, sphere, on_sphere), disks = surfaces_of(device, disk, on_disk);
            std::size_t off = 0, loose = 0, wrong_normal = 0, wrong_area = 0;
            for (std::size_t i = 0; i < on_sphere.t.size(); ++i) {
                const Long3 from_centre = spheres.p(i) - centre;
                off += !(std::abs(length(from_centre) - r) <= spheres.p_error(i));
                off += !(std::abs(dot(disks.p(i) - centre, unit(normal))) <= disks.p_error(i));
                loose += !(spheres.p_error(i) <= 16 * U * (r + 0.3l)) + !(disks.p_error(i) <= 16 * U * (r + 0.3l));
                // The point is rounded by as much as the bound, the hit by that of the ray.
                wrong_normal += !(length(spheres.ng(i) - unit(from_centre)) <= 8 * U + 2 * spheres.p_error(i) / r);
                wrong_normal += !(length(disks.ng(i) - normal) == 0);
                wrong_area += !(std::abs(spheres.area(i) / (4 * pi * r * r) - 1) <= 8 * U);
                wrong_area += !(std::abs(disks.area(i) / (pi * r * r) - 1) <= 8 * U);
            }
            CHECK(off == 0);
            CHECK(loose == 0);
            CHECK(wrong_normal == 0);
            CHECK(wrong_area == 0);
        }
    }
}

TEST_CASE("along the rim of a sphere a ray meets the side on which it starts")
{
    Randoms randoms;
    const Primitive sphere = make_sphere({0.6l, 0.2l, 0.1l}, 0.4l);
    const Long3 centre = to_long(sphere.a);
    const long double r = sphere.b.s[0];
    Hits outside, inside;
    for (int i = 0; i < 20000; ++i) {
        const Long3 axis = randoms.direction(), along = unit(cross(axis, randoms.direction()));
        // Past the point centre + r axis, at a distance within some roundings; from within along a short chord.
        const Long3 rim = centre + r * (1.0l + 4 * U * randoms.number()) * axis;
        outside.add(rim - 3.0l * along, along, 3.0l);
        const long double depth = 16 * U;
        inside.add(centre + r * (1.0l - depth) * axis, along, r * std::sqrt(2 * depth));
    }
    for (Device& device : test_devices()) {
        const Surfaces from_outside = surfaces_of(device, sphere, outside),
                       from_inside = surfaces_of(device, sphere, inside);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < outside.t.size(); ++i) {
            // The kernels' own product rounds.
            wrong += !(dot(from_outside.wo(i), from_outside.ng(i)) > -2 * U);
            wrong += !(dot(from_inside.wo(i), from_inside.ng(i)) < 2 * U);
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("a surface looks back along the ray, and knows its material and light")
{
    Hits hits;
    hits.add({0, 0, 3}, {0, 3, -4}, 1);
    for (Device& device : test_devices()) {
        const Surfaces found = surfaces_of(device, TILTED, hits);
        CHECK(static_cast<double>(length(found.wo(0) - Long3{0, -0.6l, 0.8l})) < 1e-6);
        CHECK(found.out.get<std::uint32_t>(13)[0] == 7);
        CHECK(found.out.get<std::uint32_t>(14)[0] == 9);
    }
}

TEST_CASE("a flipped surface has the opposite normals and nothing else is different")
{
    Hits hits;
    hits.add({0, 0, 3}, {0.1l, 0.2l, -1}, 2.5l, 0.25l, 0.25l);
    for (Device& device : test_devices())
        for (const Primitive& primitive :
             {TILTED, make_sphere({0, 0, 0}, 0.5l), make_disk({0, 0, 0.5l}, {0, 0, 1}, 2)}) {
            const Surfaces plain = surfaces_of(device, primitive, hits);
            const Surfaces flipped = surfaces_of(device, primitive, hits, {7, 9, NO_INDEX, SURFACE_FLIP_NORMAL});
            CHECK(flipped.ng(0) == -1.0l * plain.ng(0));
            CHECK(plain.ns(0) == plain.ng(0));
            CHECK(flipped.ns(0) == flipped.ng(0));
            CHECK(flipped.p(0) == plain.p(0));
            CHECK(flipped.p_error(0) == plain.p_error(0));
            CHECK(flipped.area(0) == plain.area(0));
        }
}

TEST_CASE("vertex normals are interpolated, kept on the side of ng, and given up where they face away")
{
    const std::vector<real4> normals{round_to_float(unit({0.9l, 0.1l, 0.8l})), round_to_float(unit({0.2l, 0.9l, 0.4l})),
                                     round_to_float(unit({-0.7l, 0.3l, 0.6l}))};
    const Hits hits = hits_of_triangle(2000);
    for (const std::uint32_t flags : {0u, SURFACE_FLIP_NORMAL})
        for (Device& device : test_devices()) {
            const Surfaces found = surfaces_of(device, TILTED, hits, {7, 9, 0, flags}, normals);
            std::size_t smooth = 0, fallen_back = 0, wrong = 0;
            for (std::size_t i = 0; i < hits.t.size(); ++i) {
                const long double b1 = hits.b1[i], b2 = hits.b2[i];
                const Long3 sum =
                    (1 - b1 - b2) * to_long(normals[0]) + b1 * to_long(normals[1]) + b2 * to_long(normals[2]);
                const Long3 ng = found.ng(i), n = (dot(sum, ng) < 0 ? -1.0l : 1.0l) * unit(sum);
                const long double product = dot(n, found.wo(i)) * dot(ng, found.wo(i));
                if (std::abs(product) < 1e-6l || std::abs(dot(n, ng)) < 1e-6l) continue;
                ++(product > 0 ? smooth : fallen_back);
                wrong += !(length(found.ns(i) - (product > 0 ? n : ng)) <= 16 * U / length(sum));
                wrong += dot(found.ns(i), ng) <= 0;
            }
            CHECK(smooth > 500);
            CHECK(fallen_back > 50);
            CHECK(wrong == 0);
        }
    // Vertex normals that cancel leave the geometric normal.
    Hits middle;
    middle.add({0, 0, 3}, {0, 0, -1}, 1, 0.5l, 0.0l);
    for (Device& device : test_devices()) {
        const std::vector<real4> opposite{make_real4(0, 0, 1), make_real4(0, 0, -1), make_real4(0, 1, 0)};
        const Surfaces found = surfaces_of(device, TILTED, middle, {7, 9, 0, 0}, opposite);
        CHECK(found.ns(0) == found.ng(0));
    }
}

TEST_CASE("a surface has the same bits at every number of lanes")
{
    const Hits hits = hits_of_triangle(501);
    const std::vector<real4> normals{make_real4(0, 0, 1), make_real4(0, 1, 0), make_real4(1, 0, 0)};
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const bool same_bits = surfaces_of(device, TILTED, hits, {7, 9, 0, 0}, normals, 1).out.outputs ==
                                   surfaces_of(device, TILTED, hits, {7, 9, 0, 0}, normals, lanes).out.outputs;
            CAPTURE(lanes);
            CHECK(same_bits);
        }
}
