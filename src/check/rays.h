// Rays and primitives for the tests of cl/geometry, and the arithmetic of their oracles in long double.
#pragma once

#include "check/device_functions.h"
#include "math/shared.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace etendue
{
using Long3 = std::array<long double, 3>;

inline constexpr long double UNIT_ROUNDOFF_OF_FLOAT = 0x1p-24l;

inline Long3 operator+(const Long3& a, const Long3& b)
{
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Long3 operator-(const Long3& a, const Long3& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Long3 operator*(long double s, const Long3& a)
{
    return {s * a[0], s * a[1], s * a[2]};
}
inline long double dot(const Long3& a, const Long3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Long3 cross(const Long3& a, const Long3& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline long double length(const Long3& a)
{
    return std::sqrt(dot(a, a));
}
inline Long3 unit(const Long3& a)
{
    return (1.0l / length(a)) * a;
}
inline Long3 to_long(const real4& v)
{
    return {v.s[0], v.s[1], v.s[2]};
}

// Rounds to the coordinates that the device gets.
inline real4 round_to_float(const Long3& v, int w = 0)
{
    return make_real4(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]), w);
}

inline Primitive make_triangle(const Long3& a, const Long3& b, const Long3& c)
{
    return {round_to_float(a, PRIMITIVE_TRIANGLE), round_to_float(b), round_to_float(c)};
}
inline Primitive make_sphere(const Long3& centre, long double radius)
{
    return {round_to_float(centre, PRIMITIVE_SPHERE), round_to_float({radius, 0, 0}), {}};
}
inline Primitive make_disk(const Long3& centre, const Long3& normal, long double radius)
{
    return {round_to_float(centre, PRIMITIVE_DISK), round_to_float(normal), round_to_float({radius, 0, 0})};
}

// Rays as the columns that device functions take: origin in inputs 0 to 2, direction in 3 to 5.
struct RayColumns {
    std::array<std::vector<float>, 6> columns;

    void add(const Long3& origin, const Long3& direction)
    {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            columns[axis].push_back(static_cast<float>(origin[axis]));
            columns[axis + 3].push_back(static_cast<float>(direction[axis]));
        }
    }
    std::size_t size() const { return columns[0].size(); }
    Long3 origin(std::size_t i) const { return {columns[0][i], columns[1][i], columns[2][i]}; }
    Long3 direction(std::size_t i) const { return {columns[3][i], columns[4][i], columns[5][i]}; }

    // The arguments of a function: an array of primitives, these columns, and more columns.
    std::vector<DeviceArgument> arguments(const std::vector<Primitive>& primitives,
                                          const std::vector<DeviceArgument>& more = {}) const
    {
        std::vector<DeviceArgument> all{primitives};
        all.insert(all.end(), columns.begin(), columns.end());
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
};

// Numbers uniform in [-1, 1) and directions uniform on the sphere.
class Randoms
{
public:
    long double number() { return static_cast<long double>(generator_()) * 0x1p-31l - 1.0l; }
    Long3 point()
    {
        const long double x = number(), y = number();
        return {x, y, number()};
    }
    Long3 direction()
    {
        for (;;) {
            const Long3 p = point();
            if (dot(p, p) <= 1.0l && dot(p, p) > 0.01l) return unit(p);
        }
    }

private:
    std::mt19937 generator_{7};
};
} // namespace etendue
