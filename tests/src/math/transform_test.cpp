// Affine maps: normals, mirrors and similarities.
#include "math/transform.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

using namespace etendue;

namespace
{
Mat4 random_matrix(std::mt19937& random)
{
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Mat4 m(1.0);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row) m[column][row] = uniform(random);
    return m;
}

Mat4 columns(const Vec3& x, const Vec3& y, const Vec3& z)
{
    return {Vec4(x, 0), Vec4(y, 0), Vec4(z, 0), Vec4(0, 0, 0, 1)};
}
} // namespace

TEST_CASE("a transformed normal is perpendicular to the transformed surface and on the same side of it")
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    int mirroring = 0;
    for (int i = 0; i < 200; ++i) {
        const Mat4 m = random_matrix(random);
        const Vec3 u(uniform(random), uniform(random), uniform(random));
        const Vec3 v(uniform(random), uniform(random), uniform(random));
        const Vec3 n = glm::cross(u, v), origin = transform_point(m, Vec3(0.0));
        const Vec3 turned = transform_normal(m, n);
        const Vec3 mu = transform_point(m, u) - origin, mn = transform_point(m, n) - origin;
        CHECK(std::abs(glm::dot(turned, mu)) <= 1e-13);
        CHECK(glm::dot(turned, mn) > 0.0);
        mirroring += mirrors(m) ? 1 : 0;
    }
    CHECK(mirroring > 50);
    CHECK(mirroring < 150);
}

TEST_CASE("a matrix that flattens one axis still carries the normal along it")
{
    CHECK(transform_normal(columns({2, 0, 0}, {0, 3, 0}, {0, 0, 0}), {0, 0, 1}) == Vec3(0, 0, 6));
}

TEST_CASE("translation moves points but not normals")
{
    Mat4 m(1.0);
    m[3] = Vec4(1, 2, 3, 1);
    CHECK(transform_point(m, {4, 5, 6}) == Vec3(5, 7, 9));
    CHECK(transform_normal(m, {0, 1, 0}) == Vec3(0, 1, 0));
    CHECK_FALSE(mirrors(m));
    CHECK(mirrors(columns({-1, 0, 0}, {0, 1, 0}, {0, 0, 1})));
}

TEST_CASE("a similarity is told from every other matrix and gives its scale")
{
    const double c = std::cos(0.3), s = std::sin(0.3);
    CHECK(similarity_scale(columns({2 * c, 2 * s, 0}, {-2 * s, 2 * c, 0}, {0, 0, 2})).value() ==
          Approx(2.0).epsilon(1e-15));
    CHECK(similarity_scale(columns({-4, 0, 0}, {0, 4, 0}, {0, 0, 4})).value() == 4.0);
    CHECK(similarity_scale(columns({1e-30, 0, 0}, {0, 0, 1e-30}, {0, -1e-30, 0})).value() ==
          Approx(1e-30).epsilon(1e-15));
    CHECK_FALSE(similarity_scale(columns({1, 0, 0}, {0, 1, 0}, {0, 0, 1.001})).has_value());
    CHECK_FALSE(similarity_scale(columns({1, 0, 0}, {0.001, 1, 0}, {0, 0, 1})).has_value());
    CHECK_FALSE(similarity_scale(columns({1, 0, 0}, {0.6, 0.8, 0}, {0, 0, 1})).has_value());
    CHECK_FALSE(similarity_scale(columns({0, 0, 0}, {0, 0, 0}, {0, 0, 0})).has_value());
    CHECK_FALSE(similarity_scale(columns({NAN, 0, 0}, {0, 1, 0}, {0, 0, 1})).has_value());
}

TEST_CASE("a direction survives any length and is zero where there is none")
{
    CHECK(glm::length(unit_or_zero({3e-310, 4e-310, 0}) - Vec3(0.6, 0.8, 0)) <= 1e-12);
    CHECK(glm::length(unit_or_zero({3e305, 0, 4e305}) - Vec3(0.6, 0, 0.8)) <= 1e-15);
    CHECK(unit_or_zero({0, 0, 0}) == Vec3(0.0));
    CHECK(unit_or_zero({NAN, 1, 0}) == Vec3(0.0));
    CHECK(unit_or_zero({1, std::numeric_limits<double>::infinity(), 0}) == Vec3(0.0));
}
