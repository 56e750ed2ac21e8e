// Opened devices: lanes, sub-devices, the ledger of memory, the names of errors.
#include "compute/device.h"

#include "compute/buffer.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <thread>

using namespace etendue;
using Catch::Contains;

TEST_CASE("an opened device describes itself")
{
    for (Device& device : test_devices()) {
        CHECK_FALSE(device.info().name.empty());
        CHECK(device.compute_units() == device.info().compute_units);
        CHECK(device.compute_units() > 0);
        CHECK(device.info().max_allocation > 0);
        CHECK(device.info().global_memory >= device.info().max_allocation);
    }
}

TEST_CASE("lanes follow the native width of a CPU and are 1 elsewhere")
{
    for (Device& device : test_devices()) {
        const std::uint32_t lanes = device.preferred_lanes(), width = device.info().native_float_width;
        if (!device.is_cpu())
            CHECK(lanes == 1);
        else
            CHECK((lanes == width || (lanes == 1 && width < 4) || (lanes == 16 && width > 16)));
    }
}

TEST_CASE("threads restrict a CPU to a part of its compute units")
{
    for (const Device& whole : test_devices()) {
        if (!whole.is_cpu()) continue;
        const Device one(whole.info(), 1);
        CHECK(one.compute_units() == 1);
        const Buffer<std::uint32_t> buffer(one, "values", std::vector<std::uint32_t>{1, 2, 3});
        CHECK(buffer.read() == std::vector<std::uint32_t>{1, 2, 3});
        const Device all(whole.info(), whole.compute_units());
        CHECK(all.compute_units() == whole.compute_units());
        CHECK_THROWS_WITH(Device(whole.info(), whole.compute_units() + 1),
                          Contains(std::to_string(whole.compute_units() + 1) + " threads were asked for") &&
                              Contains("has " + std::to_string(whole.compute_units()) + " compute units"));
    }
}

TEST_CASE("a device that went away is an error of the device")
{
    DeviceInfo info = test_devices().front().info();
    info.device_index = 1000;
    CHECK_THROWS_WITH(Device(info), info.name + ": the device is not there any more.");
}

TEST_CASE("the ledger knows the bytes of all buffers now and at most")
{
    const Device device(test_devices().front().info());
    {
        const Buffer<std::uint32_t> a(device, "a", 100);
        Buffer<std::uint64_t> b(device, "b", 50);
        CHECK(device.memory().current == 800);
        b = Buffer<std::uint64_t>(device, "c", 10);
        const Buffer<std::uint64_t> moved(std::move(b));
        CHECK(device.memory().current == 480);
        CHECK(moved.size() == 10);
    }
    const Device::Memory memory = device.memory();
    CHECK(memory.current == 0);
    CHECK(memory.peak == 880);
    CHECK(memory.buffers == decltype(memory.buffers){{"a", 400}, {"b", 400}, {"c", 80}});
}

TEST_CASE("the ledger is right when several threads allocate and release")
{
    constexpr int COUNT = 200000;
    const Device device(test_devices().front().info());
    device.note_allocation("all", 2 * COUNT);
    const auto allocate = [&] {
        for (int i = 0; i < COUNT / 10; ++i) device.note_allocation("x", 1);
    };
    const auto release = [&] {
        for (int i = 0; i < COUNT; ++i) device.note_release(1);
    };
    std::thread first(release), second(allocate);
    release();
    allocate();
    first.join();
    second.join();
    CHECK(device.memory().current == 2 * COUNT / 10);
    CHECK(device.memory().buffers.size() == 1 + 2 * COUNT / 10);
}

TEST_CASE("a buffer that does not fit is refused with the numbers before it is made")
{
    DeviceInfo info = test_devices().front().info();
    info.max_allocation = 1000;
    info.global_memory = 1500;
    const Device device(info);
    const Buffer<std::uint8_t> first(device, "first", 1000);
    CHECK_THROWS_WITH(Buffer<std::uint8_t>(device, "triangles", 1001),
                      info.name + ": the buffer \"triangles\" needs 1001 bytes, but the largest buffer that the device "
                                  "allows is 1000 bytes.");
    CHECK_THROWS_WITH(Buffer<std::uint8_t>(device, "nodes", 501),
                      info.name + ": the buffer \"nodes\" needs 501 bytes, but of the device's 1500 bytes of memory "
                                  "1000 are taken by other buffers.");
    CHECK_NOTHROW(Buffer<std::uint8_t>(device, "nodes", 500));
    CHECK(device.memory().current == 1000);
}

TEST_CASE("errors of OpenCL have the names of its header")
{
    CHECK(opencl_error_name(CL_OUT_OF_RESOURCES) == std::string("CL_OUT_OF_RESOURCES"));
    CHECK(opencl_error_name(CL_INVALID_DEVICE_PARTITION_COUNT) == std::string("CL_INVALID_DEVICE_PARTITION_COUNT"));
    CHECK(opencl_error_name(-70) == std::string("CL_INVALID_DEVICE_QUEUE"));
    CHECK(opencl_error_name(-1001) == std::string("CL_PLATFORM_NOT_FOUND_KHR"));
    CHECK(opencl_error_name(-12345) == std::string("an error that OpenCL does not define"));
    CHECK_THROWS_WITH(throw_device_error("Radeon", cl::Error(-5, "clFinish")),
                      Contains("Radeon: clFinish failed: CL_OUT_OF_RESOURCES (-5).") && Contains("--device"));
}
