// Prefix sums on the device against std::exclusive_scan.
#include "bvh/scan.h"

#include "support/device_evaluate.h"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>

namespace etendue
{
TEST_CASE("a prefix sum of any length is exact, however it is divided")
{
    std::mt19937 random(1);
    for (const Device& device : test_devices()) {
        const Program program(device, "sort.cl", "-DLANES=1", KernelCache::none());
        Scan scan(program);
        for (const std::uint32_t count :
             {0u, 1u, 2u, 3u, 255u, 256u, 257u, 4095u, 4096u, 4097u, 65535u, 65536u, 65537u, 100000u}) {
            std::vector<cl_uint> values(count);
            for (cl_uint& v : values) v = static_cast<cl_uint>(random()); // the sum passes 2^32
            std::vector<cl_uint> expected(count);
            std::exclusive_scan(values.begin(), values.end(), expected.begin(), cl_uint{0});
            for (const std::uint32_t chunks : {0u, 1u, 2u, 3u, 100u, 5000u}) {
                Buffer<cl_uint> buffer(device, "values", values);
                scan.exclusive(buffer, count, chunks);
                CAPTURE(count, chunks);
                CHECK(buffer.read() == expected);
            }
        }
    }
}

TEST_CASE("a prefix sum leaves what is beyond its length")
{
    for (const Device& device : test_devices()) {
        const Program program(device, "sort.cl", "-DLANES=1", KernelCache::none());
        Buffer<cl_uint> buffer(device, "values", std::vector<cl_uint>(1000, 3));
        Scan(program).exclusive(buffer, 700);
        const std::vector<cl_uint> values = buffer.read();
        CHECK(values[699] == 3 * 699);
        CHECK(values[700] == 3);
        CHECK(values[999] == 3);
    }
}
} // namespace etendue
