// Affine maps in double precision.
#include "math/transform.h"

#include <algorithm>
#include <cmath>

namespace etendue
{
namespace
{
double determinant(const Mat4& m)
{
    return glm::dot(Vec3(m[0]), glm::cross(Vec3(m[1]), Vec3(m[2])));
}
} // namespace

bool is_finite(const Vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Vec3 unit_or_zero(const Vec3& v)
{
    // Divide by the largest component first, so that no square underflows or overflows.
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0.0 && is_finite(v) ? glm::normalize(v / largest) : Vec3(0.0);
}

Vec3 transform_point(const Mat4& matrix, const Vec3& point)
{
    return Vec3(matrix[0]) * point.x + Vec3(matrix[1]) * point.y + Vec3(matrix[2]) * point.z + Vec3(matrix[3]);
}

Vec3 transform_normal(const Mat4& matrix, const Vec3& normal)
{
    const Vec3 x(matrix[0]), y(matrix[1]), z(matrix[2]);
    const Vec3 turned = glm::cross(y, z) * normal.x + glm::cross(z, x) * normal.y + glm::cross(x, y) * normal.z;
    return mirrors(matrix) ? -turned : turned;
}

bool mirrors(const Mat4& matrix)
{
    return determinant(matrix) < 0.0;
}

std::optional<double> similarity_scale(const Mat4& matrix)
{
    const Vec3 x(matrix[0]), y(matrix[1]), z(matrix[2]);
    const double scale = glm::length(x);
    const double tolerance = SIMILARITY_TOLERANCE * scale;
    const double uneven = std::max(std::abs(glm::length(y) - scale), std::abs(glm::length(z) - scale));
    const double skew = std::max({std::abs(glm::dot(x, y)), std::abs(glm::dot(y, z)), std::abs(glm::dot(z, x))});
    if (!(scale > 0.0 && uneven <= tolerance && skew <= tolerance * scale)) return std::nullopt;
    return scale;
}
} // namespace etendue
