// How points, normals and lengths go through an affine matrix.
#pragma once

#include "math/vector.h"

#include <optional>

namespace etendue
{
bool is_finite(const Vec3& v);

// The direction of a vector of any length, as a unit vector; zero where it has none (zero, not finite).
Vec3 unit_or_zero(const Vec3& v);

// M p + t.
Vec3 transform_point(const Mat4& matrix, const Vec3& point);

// The normal of the transformed surface, by the inverse transpose; not normalised. Written with cofactors, so that a
// matrix that flattens one axis still carries the normals it can: |det M| M^-T n = sign(det M) cof(M) n.
Vec3 transform_normal(const Mat4& matrix, const Vec3& normal);

// Whether the matrix turns a right hand into a left one (negative determinant).
bool mirrors(const Mat4& matrix);

// The factor by which a similarity (rotation, translation, uniform scale, mirror) multiplies lengths; empty for a
// matrix that is none, within SIMILARITY_TOLERANCE.
std::optional<double> similarity_scale(const Mat4& matrix);

// Relative: a rotation written with nine decimals still counts.
constexpr double SIMILARITY_TOLERANCE = 1e-8;
} // namespace etendue
