#include "scene/transform_parser.h"

#include <cmath>
#include <numbers>

using namespace etendue;

namespace
{
Mat4 parse(const std::string& text)
{
    const json::Document document(text, "a.json");
    std::vector<json::Value> steps;
    for (std::size_t i = 0; i < document.root().size(); ++i) steps.push_back(document.root()[i]);
    return parse_transform(steps);
}

Vec3 apply(const Mat4& m, const Vec3& p)
{
    return Vec3(m * Vec4(p, 1));
}

double distance_of(const Vec3& a, const Vec3& b)
{
    return glm::length(a - b);
}
} // namespace

TEST_CASE("steps are applied in the order of the list", "[host]")
{
    CHECK(apply(parse(R"([{"scale": 2}, {"translate": [1, 0, 0]}])"), {1, 1, 1}) == Vec3(3, 2, 2));
    CHECK(apply(parse(R"([{"translate": [1, 0, 0]}, {"scale": [2, 1, 1]}])"), {1, 1, 1}) == Vec3(4, 1, 1));
    CHECK(parse("[]") == Mat4(1.0));
}

TEST_CASE("right angles about the axes are exact and anticlockwise", "[host]")
{
    CHECK(apply(rotation_matrix({0, 0, 1}, 90), {1, 0, 0}) == Vec3(0, 1, 0));
    CHECK(apply(rotation_matrix({1, 0, 0}, 90), {0, 1, 0}) == Vec3(0, 0, 1));
    CHECK(apply(rotation_matrix({0, 1, 0}, 90), {0, 0, 1}) == Vec3(1, 0, 0));
    CHECK(apply(rotation_matrix({0, -3, 0}, 90), {0, 0, 1}) == Vec3(-1, 0, 0));
    CHECK(apply(rotation_matrix({0, 0, 1e-200}, -270), {1, 0, 0}) == Vec3(0, 1, 0));
    CHECK(apply(rotation_matrix({1, 0, 0}, 180), {0, 1, 1}) == Vec3(0, -1, -1));
    CHECK(rotation_matrix({0, 1, 0}, 720) == Mat4(1.0));
}

TEST_CASE("a rotation turns by its angle and leaves its axis alone", "[host]")
{
    const Vec3 axis(1, -2, 0.5), p(0.3, 0.7, -1.1);
    for (const double degrees : {1.0, 30.0, 91.0, -200.0, 359.0}) {
        const Mat4 m = rotation_matrix(axis, degrees);
        CHECK(distance_of(apply(m, axis), axis) < 1e-15 * 10);
        CHECK(is_similarity(m));
        CHECK(std::abs(glm::determinant(m) - 1.0) < 1e-14);
        // The parts of p and its image across the axis enclose the angle.
        const Vec3 a = glm::normalize(axis), across = p - a * glm::dot(a, p);
        const Vec3 turned = apply(m, across);
        const double sine = glm::dot(a, glm::cross(across, turned)), cosine = glm::dot(across, turned);
        const double expected = std::remainder(degrees * std::numbers::pi / 180, 2 * std::numbers::pi);
        CHECK(std::abs(std::atan2(sine, cosine) - expected) < 1e-14);
    }
}

TEST_CASE("look_at puts the origin at the position, +z towards the target and +y upwards", "[host]")
{
    const Mat4 m = parse(R"([{"look_at": {"position": [1, 2, 3], "target": [4, 2, 7]}}])");
    CHECK(apply(m, {0, 0, 0}) == Vec3(1, 2, 3));
    CHECK(distance_of(apply(m, {0, 0, 5}), {4, 2, 7}) < 1e-14);
    CHECK(distance_of(apply(m, {0, 1, 0}), {1, 3, 3}) < 1e-14);
    CHECK(std::abs(glm::determinant(m) - 1.0) < 1e-14);
}

TEST_CASE("a matrix may be flat or in rows", "[host]")
{
    const Mat4 flat = parse(R"([{"matrix": [1,2,3,4, 0,1,0,5, 0,0,1,6, 0,0,0,1]}])");
    CHECK(flat == parse(R"([{"matrix": [[1,2,3,4], [0,1,0,5], [0,0,1,6], [0,0,0,1]]}])"));
    CHECK(apply(flat, {1, 1, 1}) == Vec3(10, 6, 7));
}

TEST_CASE("flat but regular transforms are accepted, singular ones are not", "[host]")
{
    CHECK_NOTHROW(parse(R"([{"scale": [1, 1e-14, 1]}, {"rotate": {"axis": [1, 2, 3], "angle": 17}}])"));
    CHECK_NOTHROW(parse(R"([{"scale": 1e-15}, {"scale": 1e-15}])"));
    CHECK_THROWS_AS(parse(R"([{"rotate": {"axis": [1, 2, 3], "angle": 17}}, {"scale": [1, 0, 1]}])"), SceneError);
    CHECK_THROWS_AS(parse(R"([{"matrix": [1,2,3,0, 2,4,6,0, 0,0,1,0, 0,0,0,1]}])"), SceneError);
}

TEST_CASE("similarities keep spheres and others do not", "[host]")
{
    CHECK(is_similarity(
        parse(R"([{"scale": 1e-9}, {"rotate": {"axis": [1, 2, 3], "angle": 17}}, {"translate": [9, 9, 9]}])")));
    CHECK(is_similarity(parse(R"([{"scale": [1, -1, 1]}])")));
    CHECK_FALSE(is_similarity(parse(R"([{"scale": [1, 1, 1.000001]}])")));
    CHECK_FALSE(is_similarity(parse(R"([{"matrix": [1,0.001,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])")));
}
