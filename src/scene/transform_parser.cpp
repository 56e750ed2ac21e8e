// Matrices from translate, rotate, scale, look_at and matrix.
#include "scene/transform_parser.h"

#include "scene/fields.h"
#include "scene/scene_tables.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace etendue
{
namespace
{
// Below this determinant of the columns scaled to length 1, they are parallel up to the rounding of a few matrix
// products (each about 1e-15).
constexpr double SINGULAR = 1e-12;

// How far the scaled columns of a similarity may be from orthonormal: decimal numbers in a file are often rounded to a
// dozen digits.
constexpr double SIMILARITY_TOLERANCE = 1e-9;

double largest_entry(const Mat4& m)
{
    double largest = 0.0;
    for (int i = 0; i < 16; ++i) largest = std::max(largest, std::abs(m[i / 4][i % 4]));
    return largest;
}

// Whether the three axes still span space.
bool is_regular(const Mat4& m)
{
    glm::dmat3 axes(m);
    for (int i = 0; i < 3; ++i) axes[i] = glm::normalize(axes[i]);
    return std::abs(glm::determinant(axes)) > SINGULAR;
}

Mat4 look_at_matrix(const Fields& fields)
{
    const Vec3 position = fields.vector3("position"), target = fields.vector3("target"), up = fields.vector3("up");
    if (position == target) fields.object().fail("position and target are the same point");
    const Vec3 z = glm::normalize(target - position);
    const Vec3 x = glm::cross(up, z);
    if (!(glm::length(x) > SINGULAR * glm::length(up)))
        fields.object().fail("up is zero or points along the line of sight");
    const Vec3 unit_x = glm::normalize(x);
    return {Vec4(unit_x, 0), Vec4(glm::cross(z, unit_x), 0), Vec4(z, 0), Vec4(position, 1)};
}

Mat4 step_matrix(const json::Value& step)
{
    const Fields fields(step, transform_table());
    if (fields.has("translate")) return glm::translate(Mat4(1.0), fields.vector3("translate"));
    if (fields.has("scale")) return glm::scale(Mat4(1.0), fields.scale("scale"));
    if (fields.has("look_at")) return look_at_matrix(Fields(fields.at("look_at"), look_at_table()));
    if (fields.has("rotate")) {
        const Fields rotate(fields.at("rotate"), rotate_table());
        const Vec3 axis = rotate.vector3("axis");
        if (axis == Vec3(0.0)) rotate.at("axis").fail("the axis of a rotation must not be zero");
        return rotation_matrix(axis, rotate.number("angle"));
    }
    const Mat4 matrix = fields.matrix("matrix");
    if (Vec4(matrix[0].w, matrix[1].w, matrix[2].w, matrix[3].w) != Vec4(0, 0, 0, 1))
        fields.at("matrix").fail("the last row of a matrix must be 0 0 0 1");
    return matrix;
}
} // namespace

Mat4 rotation_matrix(const Vec3& axis, double degrees)
{
    // Take multiples of a right angle exactly.
    const double turn = std::fmod(degrees, 360.0);
    const double radians = turn * (std::numbers::pi / 180.0);
    double sine = std::sin(radians), cosine = std::cos(radians);
    if (std::fmod(turn, 90.0) == 0.0) {
        sine = std::round(sine);
        cosine = std::round(cosine);
    }

    // R = c I + (1 - c) a a^T + s [a]x
    const Vec3 scaled = axis / std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
    const Vec3 a = scaled / glm::length(scaled);
    const Vec3 b = a * (1.0 - cosine);
    return {Vec4(cosine + b.x * a.x, b.x * a.y + sine * a.z, b.x * a.z - sine * a.y, 0),
            Vec4(b.y * a.x - sine * a.z, cosine + b.y * a.y, b.y * a.z + sine * a.x, 0),
            Vec4(b.z * a.x + sine * a.y, b.z * a.y - sine * a.x, cosine + b.z * a.z, 0), Vec4(0, 0, 0, 1)};
}

Mat4 parse_transform(const std::vector<json::Value>& steps)
{
    Mat4 product(1.0);
    for (const json::Value& step : steps) {
        product = step_matrix(step) * product;
        if (!(largest_entry(product) <= MAX_COORDINATE))
            step.fail("the transform grows beyond " + number_text(MAX_COORDINATE) + " here");
        if (!is_regular(product)) step.fail("the transform flattens space here: its matrix is singular");
    }
    return product;
}

bool is_similarity(const Mat4& transform)
{
    const glm::dmat3 linear(transform);
    const double scale = glm::length(linear[0]);
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) {
            const double product = glm::dot(linear[i] / scale, linear[j] / scale);
            if (!(std::abs(product - (i == j ? 1.0 : 0.0)) <= SIMILARITY_TOLERANCE)) return false;
        }
    return true;
}
} // namespace etendue
