// Sets of primitives on which builders go wrong.
#pragma once

#include "math/shared.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace etendue
{
inline Primitive make_triangle(const real4& a, const real4& b, const real4& c)
{
    Primitive p{a, b, c};
    p.a.s[3] = PRIMITIVE_TRIANGLE;
    return p;
}

// A triangle of this size around a point.
inline Primitive triangle_at(double x, double y, double z, double size = 0.01)
{
    return make_triangle(make_real4(x - size, y - size, z), make_real4(x + size, y, z - size),
                         make_real4(x, y + size, z + size));
}

inline Primitive make_sphere(double x, double y, double z, double radius)
{
    return {make_real4(x, y, z, PRIMITIVE_SPHERE), make_real4(radius, 0, 0), make_real4(0, 0, 0)};
}

inline Primitive make_disk(double x, double y, double z, double radius)
{
    return {make_real4(x, y, z, PRIMITIVE_DISK), make_real4(0.6, 0.8, 0), make_real4(radius, 0, 0)};
}

inline std::vector<Primitive> random_triangles(std::size_t count, unsigned seed = 1)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<Primitive> set;
    for (std::size_t i = 0; i < count; ++i) set.push_back(triangle_at(u(random), u(random), u(random)));
    return set;
}

struct PrimitiveSet {
    std::string name;
    std::vector<Primitive> primitives;
};

inline std::vector<PrimitiveSet> primitive_sets()
{
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<PrimitiveSet> sets;
    const auto add = [&](const char* name, std::size_t count, auto make) {
        sets.push_back({name, {}});
        for (std::size_t i = 0; i < count; ++i) sets.back().primitives.push_back(make(static_cast<double>(i)));
    };
    for (const std::size_t count : {0, 1, 2, 3, 4, 5, 64, 65, 1000, 20000})
        sets.push_back({std::to_string(count) + " random triangles", random_triangles(count)});
    add("identical", 1u << 16, [](double) { return triangle_at(0.25, 0.5, -0.5); });
    add("five identical", 5, [](double) { return triangle_at(0.25, 0.5, -0.5); });
    add("collinear", 3000, [](double i) { return triangle_at(i / 1500 - 1, 0, 0, 1e-4); });
    add("on a diagonal", 3000, [](double i) { return triangle_at(i / 3000, i / 3000, i / 3000, 1e-5); });
    add("coplanar", 5000, [&](double) {
        const double x = u(random), z = u(random);
        return make_triangle(make_real4(x, 0, z), make_real4(x + 0.1, 0, z), make_real4(x, 0, z + 0.1));
    });
    add("nested around one centre", 4096, [](double i) { return triangle_at(0, 0, 0, std::ldexp(1 + i / 4096, -8)); });
    add("clustered", 8000, [&](double i) {
        const double size = i < 7900 ? 1e-6 : 1.0;
        return triangle_at(0.3 + size * u(random), 0.3 + size * u(random), 0.3 + size * u(random), size * 0.1);
    });
    add("centres at 2^-i", 120, [](double i) {
        const double x = std::ldexp(1.0, -static_cast<int>(i));
        return make_triangle(make_real4(x, 0, 0), make_real4(x, x / 8, 0), make_real4(x, 0, x / 8));
    });
    add("split at every bit of the code", 64, [](double i) {
        const int bit = static_cast<int>(i) / 3, axis = static_cast<int>(i) % 3;
        const double x = i < 63 ? std::ldexp(1.0, -bit) : 0.0;
        const double c[3] = {axis == 0 ? x : 0, axis == 1 ? x : 0, axis == 2 ? x : 0};
        return triangle_at(c[0], c[1], c[2], 0);
    });
    add("all kinds", 3000, [&](double i) {
        const double x = u(random), y = u(random), z = u(random);
        if (i < 1000) return triangle_at(x, y, z);
        return i < 2000 ? make_sphere(x, y, z, 0.02) : make_disk(x, y, z, 0.02);
    });
    add("kinds on one spot", 12, [](double i) {
        if (i < 4) return triangle_at(0, 0, 0);
        return i < 8 ? make_sphere(0, 0, 0, 0.01) : make_disk(0, 0, 0, 0.01);
    });
    add("some not finite", 2000, [&](double i) {
        Primitive p = triangle_at(u(random), u(random), u(random));
        const double bad[] = {nan, infinity, -infinity};
        if (static_cast<int>(i) % 7 == 0)
            (static_cast<int>(i) % 2 ? p.b : p.c).s[static_cast<int>(i) % 3] =
                static_cast<float>(bad[static_cast<int>(i) % 3]);
        return p;
    });
    add("none finite", 9, [&](double i) {
        return i < 4 ? triangle_at(nan, 0, infinity) : i < 7 ? make_sphere(0, 0, 0, nan) : make_disk(infinity, 0, 0, 1);
    });
    add("one not finite", 1, [&](double) { return triangle_at(nan, 0, 0); });
    add("huge and tiny", 500, [&](double) {
        const double size = std::ldexp(1.0, static_cast<int>(60 * u(random)));
        return triangle_at(size * u(random), size * u(random), size * u(random), size * 0.1);
    });
    add("as large as numbers go", 50,
        [&](double) { return triangle_at(3.3e38 * u(random), 3.3e38 * u(random), 3.3e38 * u(random), 1e37); });
    add("zeros of both signs", 40, [&](double i) {
        const double zero = static_cast<int>(i) % 2 ? -0.0 : 0.0;
        return make_triangle(make_real4(zero, -zero, i), make_real4(-zero, zero, i), make_real4(zero, zero, i));
    });
    return sets;
}
} // namespace etendue
