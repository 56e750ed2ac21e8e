// Lanes: masks, conversions, wide products, reads and writes by lane, at every number of lanes.
#include "compute/kernel.h"
#include "math/shared.h"
#include "support/device_lanes.h"

#include <catch2/catch.hpp>

#include <bit>
#include <limits>
#include <random>

using namespace etendue;

namespace
{
const DeviceFunctions functions(
    {"math/lanes.h"},
    {
        {"ask_mask", "int -> uint uint uint uint uint",
         "Mask m = in0 != 0; out0 = (Uint)(lane_bits(m)); out1 = (Uint)(any_of(m) ? 1u : 0u);"
         "out2 = (Uint)(none_of(m) ? 1u : 0u); out3 = (Uint)(count_of(m));"
         "out4 = (Uint)(any_of(m) ? lowest_bit(lane_bits(m)) : 99u);"},
        {"mask_logic", "int int -> mask mask mask mask uint mask",
         "Mask a = in0 < 0, b = in1 < 0; out0 = not(a); out1 = a & b; out2 = a | b; out3 = not(not(a) | not(b));"
         "out4 = a ? (Uint)(7u) : (Uint)(9u); out5 = to_mask(1) & not(to_mask(0));"},
        {"all_lanes", "uint -> uint uint",
         "out0 = (Uint)(lane_bits(in0 == in0) == ALL_LANES ? 1u : 0u); out1 = lane_numbers();"},
        {"convert", "float int uint -> int uint float float uint int float",
         "out0 = to_int(in0); out1 = to_uint(in0); out2 = to_float(in1); out3 = to_float(in2); out4 = uint_bits(in0);"
         "out5 = int_bits(in0); out6 = from_bits(in2);"},
        {"convert_negative", "float -> int", "to_int(in0)"},
        {"multiply", "uint -> uint uint uint uint",
         "multiply_wide(0xD2511F53u, in0, &out0, &out1); multiply_wide(0xffffffffu, in0, &out2, &out3);"},
        {"gather", "float* uint* uint mask -> float uint",
         "out0 = gather_real(in0, in2, in3); out1 = gather_uint(in1, in2, in3);"},
        {"gather_structs", "Primitive* PrimitiveSurface* uint mask -> float float float float uint uint uint uint",
         "gather_real4(in0[i].b, in2, in3, &out0, &out1, &out2, &out3);"
         "gather_members(in1[i], in2, in3, material, &out4, light, &out5, normal, &out6, flags, &out7);"},
    });

constexpr std::uint32_t INVALID = 0xffffffffu;
} // namespace

TEST_CASE("every pattern of lanes is seen by all questions about a mask")
{
    // Element e of pack p is set when bit e of p is: all 65536 patterns of 16 lanes, and of fewer.
    std::vector<std::int32_t> set(65536 * 16);
    for (std::uint32_t e = 0; e < set.size(); ++e) set[e] = static_cast<std::int32_t>((e / 16 >> e % 16) & 1u);
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceResults out = functions.evaluate(device, "ask_mask", {set}, lanes);
            const auto bits = out.get<std::uint32_t>(0), any = out.get<std::uint32_t>(1);
            const auto none = out.get<std::uint32_t>(2), count = out.get<std::uint32_t>(3);
            const auto lowest = out.get<std::uint32_t>(4);
            std::size_t wrong = 0;
            for (std::uint32_t e = 0; e < set.size(); ++e) {
                std::uint32_t expected = 0;
                for (std::uint32_t lane = 0; lane < lanes; ++lane)
                    expected |= static_cast<std::uint32_t>(set[e - e % lanes + lane]) << lane;
                const std::uint32_t first = expected ? static_cast<std::uint32_t>(std::countr_zero(expected)) : 99u;
                wrong += bits[e] != expected || any[e] != (expected != 0) || none[e] != (expected == 0) ||
                         count[e] != static_cast<std::uint32_t>(std::popcount(expected)) || lowest[e] != first;
            }
            CAPTURE(lanes);
            CHECK(wrong == 0);
        }
}

TEST_CASE("masks combine and choose by lane")
{
    const std::vector<std::int32_t> a{-1, -1, 1, 1, -5}, b{-1, 1, -1, 1, 7};
    for (Device& device : test_devices()) {
        const DeviceResults out = evaluate_in_all_lanes(functions, device, "mask_logic", {a, b});
        using Words = std::vector<std::uint32_t>;
        CHECK(out.get<std::uint32_t>(0) == Words{0, 0, 1, 1, 0});
        CHECK(out.get<std::uint32_t>(1) == Words{1, 0, 0, 0, 0});
        CHECK(out.get<std::uint32_t>(2) == Words{1, 1, 1, 0, 1});
        CHECK(out.get<std::uint32_t>(3) == Words{1, 0, 0, 0, 0});
        CHECK(out.get<std::uint32_t>(4) == Words{7, 7, 9, 9, 7});
        CHECK(out.get<std::uint32_t>(5) == Words{1, 1, 1, 1, 1});
    }
}

TEST_CASE("lanes are numbered from 0, and all of them are ALL_LANES")
{
    const std::vector<std::uint32_t> any(64, 3u);
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceResults out = functions.evaluate(device, "all_lanes", {any}, lanes);
            CHECK(out.get<std::uint32_t>(0) == std::vector<std::uint32_t>(64, 1u));
            const auto numbers = out.get<std::uint32_t>(1);
            for (std::uint32_t e = 0; e < numbers.size(); ++e) CHECK(numbers[e] == e % lanes);
        }
}

TEST_CASE("conversions round and truncate as C does, and bits stay bits")
{
    const std::vector<float> f{0.0f, 0.99f, 1.5f, 16777215.0f, 2147483520.0f, 1e-42f};
    const std::vector<std::int32_t> i{0, -1, 16777217, std::numeric_limits<std::int32_t>::min(), 33554435, -33554433};
    const std::vector<std::uint32_t> u{0u, 1u, 16777219u, 0x7f800000u, 0xffffff7fu, 0x80000000u};
    for (Device& device : test_devices()) {
        const DeviceResults out = evaluate_in_all_lanes(functions, device, "convert", {f, i, u});
        for (std::size_t e = 0; e < f.size(); ++e) {
            CHECK(out.get<std::int32_t>(0)[e] == static_cast<std::int32_t>(f[e]));
            CHECK(out.get<std::uint32_t>(1)[e] == static_cast<std::uint32_t>(f[e]));
            CHECK(out.get<float>(2)[e] == static_cast<float>(i[e]));
            CHECK(out.get<float>(3)[e] == static_cast<float>(u[e]));
            CHECK(out.get<std::uint32_t>(4)[e] == std::bit_cast<std::uint32_t>(f[e]));
            CHECK(out.get<std::int32_t>(5)[e] == std::bit_cast<std::int32_t>(f[e]));
            CHECK(out.get<std::uint32_t>(6)[e] == u[e]);
        }
        const std::vector<float> negative{-0.99f, -1.5f, -2147483648.0f};
        CHECK(evaluate_in_all_lanes(functions, device, "convert_negative", {negative}).get<std::int32_t>(0) ==
              std::vector<std::int32_t>{0, -1, std::numeric_limits<std::int32_t>::min()});
    }
}

TEST_CASE("wide products are those of 64-bit integers")
{
    std::mt19937 random(1);
    std::vector<std::uint32_t> x{0u, 1u, 0xffffffffu, 0x80000000u, 0x7fffffffu};
    while (x.size() < 4096) x.push_back(static_cast<std::uint32_t>(random()));
    for (Device& device : test_devices()) {
        const DeviceResults out = evaluate_in_all_lanes(functions, device, "multiply", {x});
        std::size_t wrong = 0;
        for (std::size_t e = 0; e < x.size(); ++e) {
            const std::uint64_t a = std::uint64_t{0xD2511F53u} * x[e], b = std::uint64_t{0xffffffffu} * x[e];
            wrong += out.outputs[0][e] != a >> 32 || out.outputs[1][e] != (a & 0xffffffffu) ||
                     out.outputs[2][e] != b >> 32 || out.outputs[3][e] != (b & 0xffffffffu);
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("active lanes read their own element, the others element 0, wherever they point")
{
    const std::vector<float> reals{10.0f, 11.0f, 12.0f, 13.0f};
    const std::vector<std::uint32_t> integers{20, 21, 22, 23}, index{3, INVALID, 1, 0, 2, INVALID};
    const std::vector<std::uint32_t> active{1, 0, 1, 1, 1, 0};
    for (Device& device : test_devices()) {
        const DeviceResults out =
            evaluate_in_all_lanes(functions, device, "gather", {reals, integers, index, active});
        CHECK(out.get<float>(0) == std::vector<float>{13.0f, 10.0f, 11.0f, 10.0f, 12.0f, 10.0f});
        CHECK(out.get<std::uint32_t>(1) == std::vector<std::uint32_t>{23, 20, 21, 20, 22, 20});
    }
}

TEST_CASE("members of structs are read by lane, each into its own place")
{
    std::vector<Primitive> primitives(5);
    std::vector<PrimitiveSurface> surfaces(5);
    for (std::uint32_t p = 0; p < 5; ++p) {
        primitives[p].b = make_real4(p, p + 0.25, p + 0.5, p + 0.75);
        surfaces[p] = {100 + p, 200 + p, 300 + p, 400 + p};
    }
    const std::vector<std::uint32_t> index{4, 2, INVALID, 0, 3}, active{1, 1, 0, 1, 1}, read{4, 2, 0, 0, 3};
    for (Device& device : test_devices()) {
        const DeviceResults out =
            evaluate_in_all_lanes(functions, device, "gather_structs", {primitives, surfaces, index, active});
        for (std::size_t e = 0; e < index.size(); ++e)
            for (std::uint32_t member = 0; member < 4; ++member) {
                CHECK(out.get<float>(member)[e] == static_cast<float>(read[e]) + 0.25f * static_cast<float>(member));
                CHECK(out.get<std::uint32_t>(4 + member)[e] == 100 * (member + 1) + read[e]);
            }
    }
}

TEST_CASE("lanes of the mask write their own place and no other")
{
    // Lane n of each pack writes place 3 n + 1 of the pack's 64 when n is not a multiple of 3.
    const std::string text =
        "#include \"math/lanes.h\"\nkernel void scatter(global float4* out)\n{\n"
        "    Uint lane = lane_numbers();\n    Float x = to_float(lane);\n"
        "    uint pack = (uint)get_global_id(0);\n"
        "    scatter_real4(out[i], lane * 3u + (Uint)(1u + 64u * pack), lane % 3u != 0u, x, x + 0.25, x + 0.5, "
        "x + 0.75);\n}\n";
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const Program program =
                Program::from_text(device, "scatter", text, Specialization::everything(lanes, 32).build_options());
            Buffer<cl_float4> out(device, "out", std::vector<cl_float4>(128, make_real4(-1, -1, -1, -1)));
            Kernel(program, "scatter").run(2, 0, out);
            const std::vector<cl_float4> places = out.read();
            for (std::uint32_t place = 0; place < 128; ++place) {
                const std::uint32_t lane = (place % 64 - 1) / 3;
                const bool written = place % 64 % 3 == 1 && lane < lanes && lane % 3 != 0;
                for (std::uint32_t k = 0; k < 4; ++k) {
                    const float value = static_cast<float>(lane) + 0.25f * static_cast<float>(k);
                    CHECK(places[place].s[k] == (written ? value : -1.0f));
                }
            }
        }
}
