// Solid angles and cases.
#include "check/light_cases.h"

#include <cmath>
#include <numbers>

namespace etendue
{
namespace
{
constexpr double PI = std::numbers::pi;

// Of the triangle's vertices as seen from a point.
double triangle_solid_angle(const Point& a, const Point& b, const Point& c)
{
    const double la = length(a), lb = length(b), lc = length(c);
    // The determinant from edges, so that it keeps its digits for small triangles.
    const double determinant = dot(a, cross(b - a, c - a));
    return std::abs(2 * std::atan2(determinant, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb));
}

Primitive triangle(const Point& a, const Point& b, const Point& c)
{
    return {make_real4(a[0], a[1], a[2], PRIMITIVE_TRIANGLE), make_real4(b[0], b[1], b[2]),
            make_real4(c[0], c[1], c[2])};
}
} // namespace

Point point_of(const real4& v)
{
    return {v.s[0], v.s[1], v.s[2]};
}

Primitive disk_light(const Point& centre, const Point& normal, double radius)
{
    return {make_real4(centre[0], centre[1], centre[2], PRIMITIVE_DISK), make_real4(normal[0], normal[1], normal[2]),
            make_real4(radius, 0, 0)};
}

Primitive ceiling_light(double height, double size)
{
    return triangle({-size, height, -size}, {2 * size, height, 0}, {0, height, 1.5 * size});
}

Primitive sphere_light(const Point& centre, double radius)
{
    return {make_real4(centre[0], centre[1], centre[2], PRIMITIVE_SPHERE), make_real4(radius, 0, 0), {}};
}

std::vector<LightCase> light_cases()
{
    using Kind = LightCase::Kind;
    const Primitive slanted = triangle({1, 0.2, 1}, {1.5, 1, 0.5}, {2, 0.1, -1});
    return {{"triangle", ceiling_light(1, 0.5)},
            {"triangle, tiny", ceiling_light(1, 1e-4), {0, 0, 0}, 0, Kind::tiny},
            {"triangle, of 1e-12 steradian", ceiling_light(1, 6e-7), {0, 0, 0}, 0, Kind::tiny},
            {"triangle, huge", ceiling_light(1, 5)},
            {"triangle, of almost 2 pi", ceiling_light(1e-3, 1), {0, 0, 0}, 0, Kind::lopsided},
            {"triangle, near", ceiling_light(0.1, 0.5)},
            {"triangle, far", ceiling_light(1000, 0.5)},
            {"triangle, aslant", slanted, {0, 0, 0}, 0, Kind::typical},
            {"disk", disk_light({0, 1, 0}, {0, -1, 0}, 0.5)},
            {"disk, tiny", disk_light({0.1, 1, 0}, {0, -1, 0}, 1e-4), {0, 0, 0}, 0, Kind::tiny},
            {"disk, of 1e-12 steradian", disk_light({0, 1, 0}, {0, -1, 0}, 6e-7), {0, 0, 0}, 0, Kind::tiny},
            {"disk, huge", disk_light({1, 1, 0}, {0, -1, 0}, 5)},
            {"disk, aslant", disk_light({0.5, 1, 0}, {-0.6, -0.8, 0}, 0.5), {0, 0, 0}, 0, Kind::typical},
            {"sphere", sphere_light({1, 0.5, 0}, 0.5), {0, 0, 0}, 0, Kind::typical},
            {"sphere by area", sphere_light({1, 0.5, 0}, 0.5), {0, 0, 0}, 0, Kind::plain, true},
            {"sphere, tiny", sphere_light({1, 0.5, 0}, 1e-4), {0, 0, 0}, 0, Kind::tiny},
            {"sphere, huge", sphere_light({0, 101, 0}, 100)},
            {"sphere, near", sphere_light({0, 1.001, 0}, 1)},
            {"sphere, far", sphere_light({0, 1000, 0}, 1)},
            {"sphere from inside", sphere_light({0.3, 0.2, 0.1}, 1), {0, 0, 0}, SURFACE_FLIP_NORMAL, Kind::typical}};
}

LightScene light_of(const Primitive& primitive, uint light_flags, uint surface_flags)
{
    LightScene scene;
    scene.add_area(primitive, LIGHT_RADIANCE, 1, light_flags, surface_flags);
    return scene;
}

double solid_angle(const Primitive& p, const Point& from)
{
    const Point a = point_of(p.a) - from;
    if (p.a.s[3] == PRIMITIVE_SPHERE) {
        const double sine = p.b.s[0] / length(a);
        return sine >= 1 ? 4 * PI : 2 * PI * sine * sine / (1 + std::sqrt(1 - sine * sine));
    }
    if (p.a.s[3] == PRIMITIVE_TRIANGLE) return triangle_solid_angle(a, point_of(p.b) - from, point_of(p.c) - from);
    constexpr int SIDES = 8192;
    const std::array<Point, 2> frame = complete_frame(unit(point_of(p.b)));
    const auto rim = [&](int i) {
        const double angle = 2 * PI * i / SIDES;
        return a + p.c.s[0] * (std::cos(angle) * frame[0] + std::sin(angle) * frame[1]);
    };
    double sum = 0;
    for (int i = 0; i < SIDES; ++i) sum += triangle_solid_angle(a, rim(i), rim(i + 1));
    return sum;
}
} // namespace etendue
