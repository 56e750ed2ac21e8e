// The closed forms that other tests take as truth, against known values and against quadrature of their definition,
// F = 1/pi times the integral of max(cos theta, 0) |cos theta'| / r^2 over the shape.
#include "support/form_factors.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

using namespace etendue;
using std::numbers::pi;

namespace
{
const Vec3 ORIGIN{0.0};
const Vec3 UP{0, 1, 0};

// The midpoint rule over [0,1]^2 for the patch at the origin with normal UP: place(u, v) gives a point of the shape and
// area(u, v) the vector normal times area per du dv.
double quadrature(const std::function<Vec3(double, double)>& place, const std::function<Vec3(double, double)>& area)
{
    const int n = 800;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double u = (i + 0.5) / n;
            const double v = (j + 0.5) / n;
            const Vec3 point = place(u, v);
            const double r2 = dot(point, point);
            sum += std::max(point.y, 0.0) * std::abs(dot(point, area(u, v))) / (r2 * r2);
        }
    }
    return sum / (pi * n * n);
}

double parallelogram_quadrature(const Vec3& corner, const Vec3& a, const Vec3& b)
{
    return quadrature([&](double u, double v) { return corner + u * a + v * b; },
                      [&](double, double) { return cross(a, b); });
}

std::vector<Vec3> parallelogram(const Vec3& corner, const Vec3& a, const Vec3& b)
{
    return {corner, corner + a, corner + a + b, corner + b};
}
} // namespace

TEST_CASE("rectangle, disk and sphere form factors have their known values", "[host]")
{
    CHECK(parallel_rectangle_form_factor(0.7, 1.3, 0.9) == Approx(0.137671753).epsilon(0).margin(6e-10));
    CHECK(perpendicular_rectangle_form_factor(0.8, 1.1, 0.5) == Approx(0.109398308).epsilon(0).margin(6e-10));
    CHECK(disk_form_factor(0.6, 0.8, 0.9) == Approx(0.124779852).epsilon(0).margin(6e-10));
    CHECK(disk_form_factor(0.6, 0.8, 0.0) == Approx(0.36).epsilon(1e-14));
    CHECK(sphere_form_factor(1.0, 1.6, 1.0) == Approx(0.21177340).epsilon(0).margin(6e-9));
    CHECK(sphere_form_factor(1.0, 1.6, 1.6) == Approx(0.05403007).epsilon(0).margin(6e-9));
    CHECK(sphere_form_factor(1.0, 1.6, 2.2) == Approx(0.00009492).epsilon(0).margin(6e-9));
    CHECK(sphere_form_factor(0.5, 1.0, 0.0) == Approx(0.25).epsilon(1e-14));
    CHECK(sphere_form_factor(1.0, 1.6, pi) == 0.0);
}

TEST_CASE("a square light straight above has its known form factor at every distance", "[host]")
{
    const auto [e, expected] = GENERATE(table<double, double>(
        {{1.0, 0.2394564705}, {0.1, 0.9683395570}, {0.01, 0.9996727869}, {1e-3, 0.9999967268}, {1e-6, 1.0 - 3.3e-12}}));
    const std::vector<Vec3> square = parallelogram({-0.5, e, -0.5}, {1, 0, 0}, {0, 0, 1});
    CHECK(polygon_form_factor(ORIGIN, UP, square) == Approx(expected).epsilon(0).margin(6e-11));
    CHECK(4.0 * parallel_rectangle_form_factor(0.5, 0.5, e) == Approx(expected).epsilon(0).margin(6e-11));
}

TEST_CASE("a light that touches a wall has its known form factor at every distance below the edge", "[host]")
{
    const auto [e, expected] = GENERATE(
        table<double, double>({{1.0, 0.0710934390}, {0.1, 0.4225448602}, {0.01, 0.4921589522}, {1e-4, 0.4999215797}}));
    // The wall is the plane y = 0 here, and the light a unit square in front of it, e beside the patch.
    const std::vector<Vec3> square = parallelogram({-0.5, 0, e}, {1, 0, 0}, {0, 1, 0});
    CHECK(polygon_form_factor(ORIGIN, UP, square) == Approx(expected).epsilon(0).margin(6e-11));
    CHECK(2.0 * perpendicular_rectangle_form_factor(1.0, 0.5, e) == Approx(expected).epsilon(0).margin(6e-11));
}

TEST_CASE("the polygon form factor agrees with the closed forms of rectangles", "[host]")
{
    CHECK(polygon_form_factor(ORIGIN, UP, parallelogram({0, 0.9, 0}, {0.7, 0, 0}, {0, 0, 1.3})) ==
          Approx(parallel_rectangle_form_factor(0.7, 1.3, 0.9)).epsilon(1e-13));
    CHECK(polygon_form_factor(ORIGIN, UP, parallelogram({0.5, 0, 0}, {0, 0.8, 0}, {0, 0, 1.1})) ==
          Approx(perpendicular_rectangle_form_factor(0.8, 1.1, 0.5)).epsilon(1e-13));
}

TEST_CASE("the polygon form factor agrees with quadrature, above and across the horizon", "[host]")
{
    const Vec3 corner = GENERATE(Vec3{-0.4, 0.7, 0.3}, Vec3{0.9, -0.5, -0.2}, Vec3{-1.5, -0.8, -0.9});
    const Vec3 a{0.8, 0.3, 0.1};
    const Vec3 b{-0.2, 1.1, 0.9};
    const double expected = parallelogram_quadrature(corner, a, b);
    CHECK(polygon_form_factor(ORIGIN, UP, parallelogram(corner, a, b)) == Approx(expected).epsilon(1e-5));
    // The order of the vertices does not matter, nor where the patch is.
    const Vec3 shift{3, -4, 5};
    CHECK(polygon_form_factor(shift, UP, parallelogram(corner + shift, b, a)) == Approx(expected).epsilon(1e-5));
}

TEST_CASE("a polygon below the horizon or in its plane has form factor zero", "[host]")
{
    CHECK(polygon_form_factor(ORIGIN, UP, parallelogram({-0.5, -0.3, -0.5}, {1, 0, 0}, {0, 0, 1})) == 0.0);
    CHECK(polygon_form_factor(ORIGIN, UP, parallelogram({1, 0, 1}, {1, 0, 0}, {0, 0, 1})) == 0.0);
}

TEST_CASE("the disk form factor agrees with quadrature", "[host]")
{
    const auto [radius, h, offset] =
        GENERATE(table<double, double, double>({{0.6, 0.8, 0.9}, {1.0, 0.5, 0.2}, {0.01, 1.0, 0.7}, {2.0, 0.4, 0.0}}));
    const double r = radius;
    const Vec3 centre{offset, h, 0};
    const double expected = quadrature(
        [=](double u, double v) {
            return centre + r * u * Vec3{std::cos(2 * pi * v), 0, std::sin(2 * pi * v)};
        },
        [=](double u, double) {
            return Vec3{0, 2 * pi * r * r * u, 0};
        });
    CHECK(disk_form_factor(radius, h, offset) == Approx(expected).epsilon(1e-5));
}

TEST_CASE("the sphere form factor agrees with quadrature, above and across the horizon", "[host]")
{
    const auto [radius, distance, theta] = GENERATE(table<double, double, double>(
        {{1.0, 1.6, 0.3}, {1.0, 1.6, 1.0}, {0.5, 0.8, 1.6}, {2.0, 3.2, 2.2}, {1, 1.01, 1.2}}));
    // The sphere looks like the disk that its tangent cone cuts out of a plane at distance 1.
    const double radius_of_cone = radius / std::sqrt(distance * distance - radius * radius);
    const Vec3 axis{std::sin(theta), std::cos(theta), 0};
    const Vec3 x{std::cos(theta), -std::sin(theta), 0};
    const Vec3 z{0, 0, 1};
    const double r = radius_of_cone;
    const double expected = quadrature(
        [=](double u, double v) { return axis + r * u * (std::cos(2 * pi * v) * x + std::sin(2 * pi * v) * z); },
        [=](double u, double) { return 2 * pi * r * r * u * axis; });
    CHECK(sphere_form_factor(radius, distance, theta) == Approx(expected).epsilon(2e-4));
}
