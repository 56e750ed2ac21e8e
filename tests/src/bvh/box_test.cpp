// The padded box of a primitive against double precision.
#include "bvh/box.h"

#include "check/primitive_sets.h"

#include <catch2/catch.hpp>

namespace etendue
{
namespace
{
// One unit in the last place of a single-precision number, by its definition.
double ulp(double x)
{
    int exponent;
    std::frexp(x, &exponent);
    return std::ldexp(1.0, std::max(exponent - 24, -126));
}

// The face lies `units` of `unit` outside `coordinate`, up to half a unit of rounding.
void require_outside(double face, double coordinate, double sign, double units, double unit)
{
    const double distance = sign * (face - coordinate) / unit;
    CAPTURE(face, coordinate, unit);
    CHECK(distance >= units - 0.5);
    CHECK(distance <= units + 0.5);
}
} // namespace

TEST_CASE("a triangle's box is eight units in the last place wider than its vertices")
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int i = 0; i < 2000; ++i) {
        const double size = std::ldexp(1.0, static_cast<int>(40 * u(random)));
        const Primitive p =
            triangle_at(size * u(random), size * u(random), size * u(random), size * std::abs(u(random)));
        const Box box = primitive_box(p);
        double largest = 0;
        for (const real4& v : {p.a, p.b, p.c})
            for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(static_cast<double>(v.s[k])));
        for (std::size_t k = 0; k < 3; ++k) {
            require_outside(box.lower[k], std::min({p.a.s[k], p.b.s[k], p.c.s[k]}), -1, 8, ulp(largest));
            require_outside(box.upper[k], std::max({p.a.s[k], p.b.s[k], p.c.s[k]}), 1, 8, ulp(largest));
        }
    }
}

TEST_CASE("the box of a triangle that is a point has a volume")
{
    for (const double x : {0.0, 1e-45, 1e-38, 1.0, 0.9999999403953552, 1e38}) {
        const Box box = primitive_box(triangle_at(x, x, x, 0));
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(static_cast<double>(box.lower[k]) < static_cast<double>(static_cast<float>(x)));
            CHECK(static_cast<double>(box.upper[k]) > static_cast<double>(static_cast<float>(x)));
        }
    }
}

TEST_CASE("the boxes of spheres and disks contain the sphere by about eight units")
{
    std::mt19937 random(4);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int i = 0; i < 1000; ++i) {
        const double radius = std::ldexp(1.0, static_cast<int>(20 * u(random)));
        for (const Primitive& p : {make_sphere(u(random), u(random), u(random), radius),
                                   make_disk(u(random), u(random), u(random), radius)}) {
            const Box box = primitive_box(p);
            double largest = 1;
            for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(static_cast<double>(p.a.s[k])) + radius);
            for (std::size_t k = 0; k < 3; ++k) {
                const double below = (p.a.s[k] - radius - box.lower[k]) / ulp(largest);
                const double above = (box.upper[k] - (p.a.s[k] + radius)) / ulp(largest);
                CAPTURE(radius, below, above);
                CHECK((below >= 3 && below <= 9));
                CHECK((above >= 3 && above <= 9));
            }
        }
    }
}

TEST_CASE("what is not finite has the box of nothing")
{
    const double bad[] = {std::nan(""), std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity()};
    for (const double x : bad) {
        for (int place = 0; place < 9; ++place) {
            Primitive p = triangle_at(0, 0, 0);
            (&p.a)[place / 3].s[place % 3] = static_cast<float>(x);
            CHECK(primitive_box(p).empty());
        }
        CHECK(primitive_box(make_sphere(0, x, 0, 1)).empty());
        CHECK(primitive_box(make_sphere(0, 0, 0, x)).empty());
        CHECK(primitive_box(make_disk(0, 0, x, 1)).empty());
        CHECK(primitive_box(make_disk(0, 0, 0, x)).empty());
    }
    CHECK(primitive_box(make_sphere(3e38, 0, 0, 3e38)).empty());
    CHECK(primitive_box(triangle_at(std::numeric_limits<float>::max(), 0, 0, 0)).empty());
    CHECK_FALSE(primitive_box(triangle_at(3e38, 0, 0, 1)).empty());
}

TEST_CASE("half areas and centres are those of the box")
{
    const Box box{{-1, 2, 3}, {1, 5, 7}};
    CHECK(box.half_area() == 2 * 3 + 3 * 4 + 4 * 2);
    CHECK(box.centre() == std::array<float, 3>{0, 3.5f, 5});
    CHECK(Box{}.half_area() == 0);
}
} // namespace etendue
