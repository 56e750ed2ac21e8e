// The evaluation of device functions itself: every type, every number of lanes, tails, arrays.
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <limits>
#include <numeric>

using namespace etendue;

namespace
{
const DeviceFunctions functions(
    {"math/vector.h"},
    {
        {"twice", "float -> float", "in0 + in0"},
        {"echo", "float uint int mask -> float uint int mask", "out0 = in0; out1 = in1; out2 = in2; out3 = in3;"},
        {"less", "int int -> mask", "in0 < in1"},
        {"norm", "float float float -> float", "length3(vec3(in0, in1, in2))"},
        {"pick", "Material* uint -> uint", "gather_uint((global const uint*)in0, in1, to_mask(1))"},
    });

std::vector<float> numbers(std::size_t count)
{
    std::vector<float> values(count);
    std::iota(values.begin(), values.end(), 1.0f);
    return values;
}
} // namespace

TEST_CASE("an expression is evaluated for every element, whatever the lanes and the tail")
{
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS)
            for (const std::size_t count : {1u, 3u, 16u, 37u}) {
                const auto out = functions.evaluate<float>(device, "twice", {numbers(count)}, lanes);
                REQUIRE(out.size() == count);
                for (std::size_t i = 0; i < count; ++i) CHECK(out[i] == 2.0f * static_cast<float>(i + 1));
            }
}

TEST_CASE("values of every type go to the device and come back with their bits")
{
    const std::vector<float> f{-0.0f, std::numeric_limits<float>::infinity(), 1e-42f, 3.5f, -7.25f};
    const std::vector<std::uint32_t> u{0u, 0xffffffffu, 0x80000000u, 7u, 9u};
    const std::vector<std::int32_t> i{-1, std::numeric_limits<std::int32_t>::min(), 0, 5, -6};
    const std::vector<std::uint32_t> m{0u, 1u, 0x80000000u, 0u, 2u};
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceResults out = functions.evaluate(device, "echo", {f, u, i, m}, lanes);
            CHECK(out.get<std::uint32_t>(0) == DeviceArgument(f).words);
            CHECK(out.get<std::uint32_t>(1) == u);
            CHECK(out.get<std::int32_t>(2) == i);
            CHECK(out.get<std::uint32_t>(3) == std::vector<std::uint32_t>{0, 1, 1, 0, 1});
        }
}

TEST_CASE("a mask comes back as 0 or 1 at every number of lanes")
{
    const std::vector<std::int32_t> a{1, 2, 3, -4, 5}, b{2, 2, 2, 2, 2};
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(functions.evaluate<std::uint32_t>(device, "less", {a, b}, lanes) ==
                  std::vector<std::uint32_t>{1, 0, 0, 1, 0});
}

TEST_CASE("several arguments and an array of structs reach a device function")
{
    const std::vector<Material> materials{{1, 2, 3, 4}, {5, 6, 7, 8}};
    for (Device& device : test_devices()) {
        const std::vector<float> x{3.0f, 0.0f}, y{4.0f, -2.0f}, z{12.0f, 0.0f};
        CHECK(functions.evaluate<float>(device, "norm", {x, y, z}) == std::vector<float>{13.0f, 2.0f});
        CHECK(functions.evaluate<std::uint32_t>(device, "pick", {materials, std::vector<std::uint32_t>{6, 0, 3}}) ==
              std::vector<std::uint32_t>{7, 1, 4});
    }
}

TEST_CASE("arguments that do not fit the signature are refused")
{
    Device& device = test_devices().front();
    CHECK_THROWS_AS(functions.evaluate(device, "twice", {}), std::logic_error);
    CHECK_THROWS_AS(functions.evaluate(device, "less", {numbers(2), numbers(3)}), std::logic_error);
    CHECK_THROWS_AS(functions.evaluate(device, "missing", {numbers(2)}), std::logic_error);
}

TEST_CASE("a mistake in the body of a device function is reported by the function's name and the line")
{
    const DeviceFunctions wrong({"math/lanes.h"}, {{"wrong", "float -> float", "out0 = in0;\nout0 = undefined_name;"}});
    CHECK_THROWS_WITH(wrong.evaluate(test_devices().front(), "wrong", {numbers(2)}, 1),
                      Catch::Contains("body of wrong:2") && Catch::Contains("undefined_name"));
}
