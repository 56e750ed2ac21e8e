// Morton codes against a formula that takes one bit at a time from double precision.
#include "bvh/morton.h"

#include "check/primitive_sets.h"

#include <catch2/catch.hpp>

namespace etendue
{
namespace
{
Box point_box(float x, float y, float z)
{
    return {{x, y, z}, {x, y, z}};
}

// Halve the cube below (lower, size) once per bit of each axis.
std::uint64_t bisected_code(std::array<double, 3> lower, double size, const std::array<float, 3>& point)
{
    std::uint64_t code = 0;
    for (unsigned bit = 0; bit < MORTON_BITS; ++bit) {
        size /= 2;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool upper = point[axis] >= lower[axis] + size;
            code = 2 * code + upper;
            if (upper) lower[axis] += size;
        }
    }
    return code;
}
} // namespace

TEST_CASE("a Morton code says where a cube was halved")
{
    std::mt19937 random(5);
    for (const float size : {1.0f, 8.0f, 0.25f}) {
        // Multiples of a 4096th from 0 on, so that differences are exact; the farthest is just inside the cube.
        std::uniform_int_distribution<int> step(0, 4095);
        std::vector<Box> boxes{point_box(0, 0, 0), point_box(size * 4095 / 4096, 0, 0)};
        for (int i = 0; i < 1000; ++i) {
            const auto coordinate = [&] { return size * static_cast<float>(step(random)) / 4096; };
            const float x = coordinate(), y = coordinate(), z = coordinate();
            boxes.push_back(point_box(x, y, z));
        }
        const MortonGrid grid = morton_grid(boxes);
        CHECK(grid.scale == 2097152.0f / size);
        for (const Box& box : boxes) CHECK(morton_code(grid, box) == bisected_code({0, 0, 0}, size, box.lower));
    }
}

TEST_CASE("the largest extent takes between half and all of the cells")
{
    for (int exponent = -100; exponent <= 127; ++exponent)
        for (const float mantissa : {1.0f, 1.5f, 1.9999999f}) {
            const std::vector<Box> boxes{point_box(0, 0, 0), point_box(0, std::ldexp(mantissa, exponent), 0)};
            const MortonGrid grid = morton_grid(boxes);
            const double cells = std::ldexp(static_cast<double>(mantissa), exponent) * static_cast<double>(grid.scale);
            CAPTURE(exponent, mantissa);
            CHECK(cells >= 1048576);
            CHECK(cells < 2097152);
        }
}

TEST_CASE("codes are valid without an extent, with one too large, and for the box of nothing")
{
    const Box point = point_box(3, 4, 5);
    CHECK(morton_grid({point, point}).scale == 0);
    CHECK(morton_code(morton_grid({point}), point) == 0);
    CHECK(morton_grid({}).scale == 0);
    CHECK(morton_code(morton_grid({point, point_box(9, 9, 9)}), Box{}) == 0);

    const std::vector<Box> far{point_box(-3e38f, 0, 0), point_box(3e38f, 0, 0)};
    CHECK(morton_code(morton_grid(far), far[0]) == 0);
    CHECK(morton_code(morton_grid(far), far[1]) == 0x4924924924924924u);
}

TEST_CASE("boxes of nothing do not move the grid")
{
    const std::vector<Box> boxes{point_box(0, 0, 0), point_box(1, 2, 3)};
    std::vector<Box> more = boxes;
    more.insert(more.begin() + 1, Box{});
    CHECK(morton_grid(more).scale == morton_grid(boxes).scale);
    CHECK(morton_grid(more).lower == morton_grid(boxes).lower);
}
} // namespace etendue
