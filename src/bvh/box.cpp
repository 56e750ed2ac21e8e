// The padded box of one primitive, on the host: the same bits as cl/bvh/primitive_box.h.
#include "bvh/box.h"

#include <algorithm>
#include <cmath>

namespace etendue
{
namespace
{
// One unit in the last place of the numbers with the exponent of x, at least the least normal number; x >= 0.
float ulp(float x)
{
    if (x < std::numeric_limits<float>::min()) return std::numeric_limits<float>::min();
    return std::max(std::ldexp(1.0f, std::ilogb(x) - 23), std::numeric_limits<float>::min());
}

// The largest |coordinate|; infinite when one is not finite.
float largest_magnitude(std::initializer_list<std::array<float, 3>> points)
{
    float largest = 0.0f;
    for (const auto& point : points)
        for (const float x : point) largest = std::isfinite(x) ? std::max(largest, std::fabs(x)) : Box::INFINITE;
    return largest;
}

std::array<float, 3> xyz(const real4& v)
{
    return {v.s[0], v.s[1], v.s[2]};
}

// Move every face outwards; the box of nothing when that is not finite (an infinite magnitude has an infinite ulp).
Box padded(Box box, float padding)
{
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lower[axis] -= padding;
        box.upper[axis] += padding;
    }
    return largest_magnitude({box.lower, box.upper}) == Box::INFINITE ? Box{} : box;
}

Box triangle_box(const Primitive& primitive)
{
    const auto a = xyz(primitive.a), b = xyz(primitive.b), c = xyz(primitive.c);
    const float largest = largest_magnitude({a, b, c});
    Box box{a, a};
    box.extend(Box{b, b});
    box.extend(Box{c, c});
    return padded(box, 8.0f * ulp(largest));
}

Box sphere_box(const std::array<float, 3>& centre, float radius)
{
    Box box{centre, centre};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lower[axis] -= radius;
        box.upper[axis] += radius;
    }
    const float largest = largest_magnitude({box.lower, box.upper});
    return padded(box, 8.0f * ulp(std::max(largest, 1.0f)));
}
} // namespace

void Box::extend(const Box& other)
{
    for (std::size_t axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(lower[axis], other.lower[axis]);
        upper[axis] = std::max(upper[axis], other.upper[axis]);
    }
}

std::array<float, 3> Box::centre() const
{
    return {0.5f * lower[0] + 0.5f * upper[0], 0.5f * lower[1] + 0.5f * upper[1], 0.5f * lower[2] + 0.5f * upper[2]};
}

float Box::half_area() const
{
    if (empty()) return 0.0f;
    const float x = upper[0] - lower[0], y = upper[1] - lower[1], z = upper[2] - lower[2];
    return std::fma(x, y, std::fma(y, z, z * x));
}

uint primitive_kind(const Primitive& primitive)
{
    if (primitive.a.s[3] == PRIMITIVE_TRIANGLE) return PRIMITIVE_TRIANGLE;
    return primitive.a.s[3] == PRIMITIVE_SPHERE ? PRIMITIVE_SPHERE : PRIMITIVE_DISK;
}

Box primitive_box(const Primitive& primitive)
{
    switch (primitive_kind(primitive)) {
    case PRIMITIVE_TRIANGLE:
        return triangle_box(primitive);
    case PRIMITIVE_SPHERE:
        return sphere_box(xyz(primitive.a), std::fabs(primitive.b.s[0]));
    default:
        return sphere_box(xyz(primitive.a), std::fabs(primitive.c.s[0]));
    }
}
} // namespace etendue
