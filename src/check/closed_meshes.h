// Closed meshes around points that are inside them, for tests that no ray gets out.
#pragma once

#include "check/rays.h"

#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace etendue
{
struct ClosedMesh {
    std::string name;
    std::vector<Primitive> triangles;
    // A point well inside.
    std::function<Long3(Randoms&)> inside;
};

// Where a mesh is moved to before it is rounded to floats.
struct Placement {
    long double scale = 1.0l;
    Long3 offset{0, 0, 0};

    Long3 operator()(const Long3& p) const { return scale * p + offset; }
};

namespace closed_meshes
{
inline Primitive triangle(const Placement& place, const Long3& a, const Long3& b, const Long3& c)
{
    return make_triangle(place(a), place(b), place(c));
}

// Split a triangle of the unit sphere `levels` times; the midpoint of an edge is the same from both sides.
inline void split(std::vector<std::array<Long3, 3>>& out, const Long3& a, const Long3& b, const Long3& c, int levels)
{
    if (levels == 0) {
        out.push_back({a, b, c});
        return;
    }
    const Long3 ab = unit(a + b), bc = unit(b + c), ca = unit(c + a);
    split(out, a, ab, ca, levels - 1);
    split(out, ab, b, bc, levels - 1);
    split(out, ca, bc, c, levels - 1);
    split(out, ab, bc, ca, levels - 1);
}

// An octahedron, split, with every vertex at radius(direction).
inline std::vector<Primitive> round_mesh(const Placement& place, int levels,
                                         const std::function<long double(const Long3&)>& radius)
{
    std::vector<std::array<Long3, 3>> triangles;
    for (const long double x : {-1.0l, 1.0l})
        for (const long double y : {-1.0l, 1.0l})
            for (const long double z : {-1.0l, 1.0l}) split(triangles, {x, 0, 0}, {0, y, 0}, {0, 0, z}, levels);
    std::vector<Primitive> mesh;
    for (const auto& [a, b, c] : triangles)
        mesh.push_back(triangle(place, radius(a) * a, radius(b) * b, radius(c) * c));
    return mesh;
}

inline std::vector<Primitive> box(const Placement& place)
{
    std::vector<Primitive> mesh;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const long double side : {-1.0l, 1.0l}) {
            const auto corner = [&](long double u, long double v) {
                Long3 p;
                p[axis] = side;
                p[(axis + 1) % 3] = u;
                p[(axis + 2) % 3] = v;
                return p;
            };
            mesh.push_back(triangle(place, corner(-1, -1), corner(1, -1), corner(1, 1)));
            mesh.push_back(triangle(place, corner(1, 1), corner(-1, 1), corner(-1, -1)));
        }
    return mesh;
}

// A torus of radius 1 whose tube has radius 0.4.
inline Long3 on_torus(long double turn, long double around, long double tube)
{
    const long double phi = 2 * std::numbers::pi_v<long double> * turn;
    const long double theta = 2 * std::numbers::pi_v<long double> * around, r = 1 + tube * std::cos(theta);
    return {r * std::cos(phi), r * std::sin(phi), tube * std::sin(theta)};
}
inline std::vector<Primitive> torus(const Placement& place)
{
    constexpr int TURNS = 24, SIDES = 12;
    const auto vertex = [](int i, int k) {
        return on_torus(static_cast<long double>(i % TURNS) / TURNS, static_cast<long double>(k % SIDES) / SIDES, 0.4l);
    };
    std::vector<Primitive> mesh;
    for (int i = 0; i < TURNS; ++i)
        for (int k = 0; k < SIDES; ++k) {
            mesh.push_back(triangle(place, vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1)));
            mesh.push_back(triangle(place, vertex(i + 1, k + 1), vertex(i, k + 1), vertex(i, k)));
        }
    return mesh;
}
} // namespace closed_meshes

inline std::vector<ClosedMesh> make_closed_meshes(const Placement& place)
{
    namespace cm = closed_meshes;
    const auto in_ball = [place](Randoms& randoms) { return place(0.4l * randoms.point()); };
    const auto in_tube = [place](Randoms& randoms) {
        const long double turn = randoms.number(), around = randoms.number();
        return place(cm::on_torus(turn, around, 0.1l * std::abs(randoms.number())));
    };
    const auto bumps = [](const Long3& d) {
        return 1 + 0.1l * std::sin(13 * d[0]) * std::sin(17 * d[1] + 1) * std::sin(11 * d[2] + 2);
    };
    return {{"box", cm::box(place), in_ball},
            {"sphere", cm::round_mesh(place, 2, [](const Long3&) { return 1.0l; }), in_ball},
            {"displaced sphere", cm::round_mesh(place, 3, bumps), in_ball},
            {"torus", cm::torus(place), in_tube}};
}
} // namespace etendue
