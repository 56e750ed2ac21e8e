// Transforms: steps of a scene file as one matrix, and what kind of matrix that is.
#pragma once

#include "math/vector.h"
#include "util/json.h"

#include <vector>

namespace etendue
{
// Rotation by `degrees` about an axis of any length but zero, anticlockwise when the axis points at the viewer
// (Rodrigues' formula). Multiples of 90 degrees about a coordinate axis are exact.
Mat4 rotation_matrix(const Vec3& axis, double degrees);

// The product of the steps, the first applied first. Throws SceneError for a step that has no meaning and a product
// that grows beyond MAX_COORDINATE or flattens space.
Mat4 parse_transform(const std::vector<json::Value>& steps);

// Rotation or reflection, uniform scale and translation: what keeps a sphere a sphere.
bool is_similarity(const Mat4& transform);
} // namespace etendue
