// Morton codes on the device against a formula that takes one bit at a time in double precision.
#include "compute/kernel.h"
#include "math/shared.h"
#include "support/device_evaluate.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace etendue
{
namespace
{
using Point = std::array<float, 3>;

// The codes of boxes around these points on the grid between the first two.
std::vector<cl_ulong> device_codes(const Device& device, const Program& program, const std::vector<Point>& points,
                                   const Point& lower, const Point& upper)
{
    std::vector<cl_float4> boxes;
    for (const Point& p : points) {
        boxes.push_back(make_real4(p[0], p[1], p[2], PRIMITIVE_TRIANGLE));
        boxes.push_back(make_real4(p[0], p[1], p[2]));
    }
    const Buffer<cl_float4> box_buffer(device, "boxes", boxes);
    const Buffer<cl_float4> bounds(
        device, "bounds",
        std::vector<cl_float4>{make_real4(lower[0], lower[1], lower[2]), make_real4(upper[0], upper[1], upper[2])});
    const cl_uint count = static_cast<cl_uint>(points.size());
    Buffer<cl_ulong> codes(device, "codes", count);
    Buffer<cl_uint> indices(device, "indices", count);
    Kernel(program, "morton_codes").launch(count, 0, box_buffer, count, bounds, codes, indices);
    const std::vector<cl_uint> numbers = indices.read();
    for (cl_uint i = 0; i < count; ++i) CHECK(numbers[i] == i);
    return codes.read();
}

// Bits of the cells of a grid of 2^21 cells per axis over `size`, which is a power of two.
cl_ulong expected_code(const Point& p, const Point& lower, double size)
{
    cl_ulong code = 0;
    for (int bit = 20; bit >= 0; --bit)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double cell =
                std::floor((static_cast<double>(p[axis]) - static_cast<double>(lower[axis])) / size * 2097152);
            code = 2 * code + (static_cast<cl_ulong>(cell) >> bit & 1);
        }
    return code;
}
} // namespace

TEST_CASE("the device's Morton codes interleave the cells of cubic grids")
{
    std::mt19937 random(2);
    for (const Device& device : test_devices()) {
        const Program program(device, "bvh_build.cl", "-DLANES=1", KernelCache::none());
        for (const int exponent : {-60, -3, 0, 1, 30, 100}) {
            const float size = std::ldexp(1.0f, exponent);
            // Multiples of 2^-22 of the size, so that differences from the corner are exact: half are between cells.
            std::uniform_int_distribution<int> step(0, (1 << 22) - 1);
            const Point lower{0, -size / 2, size / 4};
            std::vector<Point> points;
            for (int i = 0; i < 2000; ++i) {
                Point p;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    p[axis] = lower[axis] + std::ldexp(static_cast<float>(step(random)), exponent - 22);
                points.push_back(p);
            }
            const Point upper{size * 0.99f, lower[1] + size * 0.7f, lower[2] + size * 0.1f};
            const std::vector<cl_ulong> codes = device_codes(device, program, points, lower, upper);
            CAPTURE(exponent);
            for (std::size_t i = 0; i < points.size(); ++i)
                CHECK(codes[i] == expected_code(points[i], lower, static_cast<double>(size)));
        }
    }
}

TEST_CASE("the device's Morton codes are 0 without an extent and for a box of nothing")
{
    const float infinity = std::numeric_limits<float>::infinity();
    for (const Device& device : test_devices()) {
        const Program program(device, "bvh_build.cl", "-DLANES=1", KernelCache::none());
        CHECK(device_codes(device, program, {{3, 4, 5}, {3, 4, 5}}, {3, 4, 5}, {3, 4, 5}) ==
              std::vector<cl_ulong>{0, 0});

        const std::vector<cl_float4> boxes{make_real4(infinity, infinity, infinity),
                                           make_real4(-infinity, -infinity, -infinity)};
        const std::vector<cl_float4> bounds{make_real4(-1, -1, -1), make_real4(1, 1, 1)};
        Buffer<cl_ulong> codes(device, "codes", std::vector<cl_ulong>{7});
        Buffer<cl_uint> indices(device, "indices", 1);
        Kernel(program, "morton_codes")
            .launch(1, 0, Buffer<cl_float4>(device, "boxes", boxes), cl_uint{1},
                    Buffer<cl_float4>(device, "bounds", bounds), codes, indices);
        CHECK(codes.read().front() == 0);
    }
}
} // namespace etendue
