// Launching kernels: arguments of every kind, errors, counts.
#include "compute/kernel.h"

#include "math/shared.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

using namespace etendue;
using Catch::Contains;

namespace
{
const char* const source = R"(
#include "shared/material.h"
kernel void is_null(global const uint* maybe, global uint* out) { out[0] = maybe == 0 ? 1u : maybe[0]; }
kernel void by_value(Material m, uint a, float b, global uint* out)
{
    out[0] = m.type + m.first_parameter + a + (uint)b;
}
kernel void reverse(local uint* scratch, global uint* values)
{
    uint i = (uint)get_local_id(0), n = (uint)get_local_size(0);
    scratch[i] = values[i];
    barrier(CLK_LOCAL_MEM_FENCE);
    values[i] = scratch[n - 1u - i];
}
kernel void spin(uint turns, global uint* out)
{
    uint x = 1u;
    for (uint i = 0u; i < turns; ++i) x = x * 1664525u + 1013904223u;
    out[0] = x;
}
kernel void count_items(volatile global uint* out) { atomic_inc(out); }
)";
} // namespace

TEST_CASE("a buffer without elements reaches a kernel as a null pointer")
{
    for (Device& device : test_devices()) {
        const Program program = Program::from_text(device, "kernels", source, "");
        Kernel kernel(program, "is_null");
        const Buffer<std::uint32_t> none, empty(device, "empty", 0), out(device, "out", 1);
        const Buffer<std::uint32_t> seven(device, "seven", std::vector<std::uint32_t>{7});
        kernel.run(1, 1, none, out);
        CHECK(out.read()[0] == 1);
        kernel.run(1, 1, seven, out);
        CHECK(out.read()[0] == 7);
        kernel.run(1, 1, empty, out);
        CHECK(out.read()[0] == 1);
        CHECK(empty.read().empty());
    }
}

TEST_CASE("values, structs and local memory reach a kernel")
{
    for (Device& device : test_devices()) {
        const Program program = Program::from_text(device, "kernels", source, "");
        const Buffer<std::uint32_t> out(device, "out", 1);
        Kernel(program, "by_value").run(1, 1, Material{1, 0, 10, 0}, std::uint32_t{100}, 1000.0f, out);
        CHECK(out.read()[0] == 1111);

        const Buffer<std::uint32_t> values(device, "values", std::vector<std::uint32_t>{1, 2, 3, 4});
        Kernel(program, "reverse").run(4, 4, LocalMemory{4 * sizeof(std::uint32_t)}, values);
        CHECK(values.read() == std::vector<std::uint32_t>{4, 3, 2, 1});
    }
}

TEST_CASE("every work-item of a range runs once and an empty range runs none")
{
    for (Device& device : test_devices()) {
        const Program program = Program::from_text(device, "kernels", source, "");
        Kernel kernel(program, "count_items");
        const Buffer<std::uint32_t> out(device, "out", std::vector<std::uint32_t>{0});
        kernel.launch(0, 0, out);
        kernel.launch(96, 0, out);
        kernel.launch(64, 32, out);
        device.finish();
        CHECK(out.read()[0] == 160);
    }
}

TEST_CASE("launches are counted by device and kernel")
{
    Device& device = test_devices().front();
    const Program program = Program::from_text(device, "kernels", source, "");
    const Buffer<std::uint32_t> out(device, "out", std::vector<std::uint32_t>{0});
    const auto before = launches()[device.info().name]["count_items"];
    Kernel kernel(program, "count_items");
    kernel.run(1, 1, out);
    kernel.launch(2, 1, out);
    kernel.launch(0, 1, out);
    device.finish();
    CHECK(launches()[device.info().name]["count_items"] == before + 2);
}

TEST_CASE("the device's own clock tells how long the last launch took")
{
    for (Device& device : test_devices()) {
        const Program program = Program::from_text(device, "kernels", source, "");
        const Buffer<std::uint32_t> out(device, "out", 1);
        Kernel kernel(program, "spin");
        CHECK(kernel.last_launch_seconds() == 0.0);
        kernel.run(1, 1, std::uint32_t{1}, out); // compiles, perhaps
        const double seconds = kernel.run(1, 1, std::uint32_t{100'000'000}, out);
        const double by_device = kernel.last_launch_seconds();
        CHECK(by_device > 0.001);
        CHECK(by_device <= seconds);
        kernel.run(1, 1, std::uint32_t{1}, out);
        CHECK(kernel.last_launch_seconds() < by_device);
    }
}

TEST_CASE("what a kernel refuses is reported with device, kernel and the name of the error")
{
    Device& device = test_devices().front();
    const Program program = Program::from_text(device, "kernels", source, "");
    const Buffer<std::uint32_t> out(device, "out", std::vector<std::uint32_t>{0});
    CHECK_THROWS_WITH(Kernel(program, "missing"), Contains(device.info().name + ", kernel missing") &&
                                                      Contains("clCreateKernel failed: CL_INVALID_KERNEL_NAME"));
    Kernel kernel(program, "count_items");
    CHECK_THROWS_WITH(kernel.run(1, 1, out, 5), Contains("kernel count_items, argument 1") &&
                                                    Contains("clSetKernelArg failed: CL_INVALID_ARG_INDEX"));
    CHECK_THROWS_WITH(kernel.run(1, std::size_t{1} << 30, out), Contains("CL_INVALID_WORK_GROUP_SIZE"));
    CHECK_THROWS_AS(kernel.run(1, std::size_t{1} << 30, out), DeviceError);
}
