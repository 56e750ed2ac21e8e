// Lanes: masks, conversions, wide products, reads and writes by lane, at every number of lanes.
#include "compute/kernel.h"
#include "math/shared.h"
#include "support/device_lanes.h"

#include <catch2/catch.hpp>

#include <bit>
#include <limits>
#include <numeric>
#include <random>

using namespace etendue;

namespace
{
const DeviceFunctions functions(
    {"math/lanes.h"},
    {
        {"ask_mask", "int -> uint uint uint uint uint uint uint",
         "Mask m = in0 != 0; out0 = (Uint)(lane_bits(m)); out1 = (Uint)(any_of(m) ? 1u : 0u);"
         "out2 = (Uint)(none_of(m) ? 1u : 0u); out3 = (Uint)(count_of(m));"
         "out4 = (Uint)(any_of(m) ? lowest_bit(lane_bits(m)) : 99u);"
         "out5 = (Uint)(lane_bits(in0 < 2) == ALL_LANES ? 1u : 0u); out6 = lane_numbers();"},
        {"mask_logic", "int int -> mask mask mask mask uint mask",
         "Mask a = in0 < 0, b = in1 < 0; out0 = not(a); out1 = a & b; out2 = a | b; out3 = not(not(a) | not(b));"
         "out4 = a ? (Uint)(7u) : (Uint)(9u); out5 = to_mask(1) & not(to_mask(0));"},
        {"convert", "float float int uint -> int uint int float float uint int float uint uint uint uint",
         "out0 = to_int(in0); out1 = to_uint(in0); out2 = to_int(in1); out3 = to_float(in2); out4 = to_float(in3);"
         "out5 = uint_bits(in1); out6 = int_bits(in1); out7 = from_bits(in3);"
         "multiply_wide(0xD2511F53u, in3, &out8, &out9); multiply_wide(0xffffffffu, in3, &out10, &out11);"},
        {"gather",
         "float* uint* Primitive* PrimitiveSurface* uint mask"
         " -> float uint float float float float uint uint uint uint",
         "out0 = gather_real(in0, in4, in5); out1 = gather_uint(in1, in4, in5);"
         "gather_real4(in2[i].b, in4, in5, &out2, &out3, &out4, &out5);"
         "gather_members(in3[i], in4, in5, material, &out6, light, &out7, normal, &out8, flags, &out9);"},
    });

constexpr std::uint32_t INVALID = 0xffffffffu;
} // namespace

TEST_CASE("every pattern of lanes is seen by all questions about a mask")
{
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            // Element e of 16 in row r is set when bit e of r is: every pattern of the lanes.
            std::vector<std::int32_t> set(16u << lanes);
            for (std::uint32_t e = 0; e < set.size(); ++e) set[e] = static_cast<std::int32_t>((e / 16 >> e % 16) & 1u);
            const auto out = functions.evaluate(device, "ask_mask", {set}, lanes).outputs;
            std::size_t wrong = 0, wrong_numbers = 0;
            for (std::uint32_t e = 0; e < set.size(); ++e) {
                std::uint32_t expected = 0;
                for (std::uint32_t lane = 0; lane < lanes; ++lane)
                    expected |= static_cast<std::uint32_t>(set[e - e % lanes + lane]) << lane;
                const std::uint32_t lowest = expected ? static_cast<std::uint32_t>(std::countr_zero(expected)) : 99u;
                wrong += out[0][e] != expected || out[1][e] != (expected != 0) || out[2][e] != (expected == 0) ||
                         out[3][e] != static_cast<std::uint32_t>(std::popcount(expected)) || out[4][e] != lowest;
                wrong_numbers += out[5][e] != 1u || out[6][e] != e % lanes;
            }
            CAPTURE(lanes);
            CHECK(wrong == 0);
            CHECK(wrong_numbers == 0);
        }
}

TEST_CASE("devices without an instruction for it gather the same bits of a mask")
{
    // Work-item p sets the lanes of the bits of p.
    const std::string text = "#undef __AVX512DQ__\n#undef __AVX512VL__\n#include \"math/lanes.h\"\n"
                             "kernel void gather_bits(global uint* out)\n{\n"
                             "    uint p = (uint)get_global_id(0);\n"
                             "    out[p] = lane_bits((((Uint)(p) >> lane_numbers()) & 1u) != 0u);\n}\n";
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const Program program =
                Program::from_text(device, "gather bits", text, Specialization::everything(lanes, 32).build_options());
            std::vector<std::uint32_t> expected(std::size_t{1} << lanes);
            std::iota(expected.begin(), expected.end(), 0u);
            Buffer<std::uint32_t> out(device, "out", expected.size());
            Kernel(program, "gather_bits").run(expected.size(), 0, out);
            const bool same_bits = out.read() == expected;
            CAPTURE(lanes);
            CHECK(same_bits);
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

TEST_CASE("conversions round and truncate as C does, bits stay bits, and wide products are those of 64-bit integers")
{
    std::vector<float> positive{0.0f, 0.99f, 1.5f, 16777215.0f, 2147483520.0f, 1e-42f};
    std::vector<float> negative{-0.0f, -0.99f, -1.5f, -16777215.0f, -2147483648.0f, -1e-42f};
    std::vector<std::int32_t> i{0, -1, 16777217, std::numeric_limits<std::int32_t>::min(), 33554435, -33554433};
    std::vector<std::uint32_t> u{0u, 1u, 16777219u, 0x7f800000u, 0xffffffffu, 0x80000000u};
    std::mt19937 random(1);
    while (u.size() < 4096) {
        u.push_back(static_cast<std::uint32_t>(random()));
        i.push_back(static_cast<std::int32_t>(random()));
        positive.push_back(static_cast<float>(random() >> 1) / 512.0f);
        negative.push_back(-positive.back());
    }
    for (Device& device : test_devices()) {
        const DeviceResults out = evaluate_in_all_lanes(functions, device, "convert", {positive, negative, i, u});
        const auto from_integer = out.get<float>(3), from_unsigned = out.get<float>(4);
        std::size_t wrong_conversions = 0, wrong_bits = 0, wrong_products = 0;
        for (std::size_t e = 0; e < u.size(); ++e) {
            wrong_conversions +=
                out.outputs[0][e] != static_cast<std::uint32_t>(positive[e]) ||
                out.outputs[1][e] != static_cast<std::uint32_t>(positive[e]) ||
                static_cast<std::int32_t>(out.outputs[2][e]) != static_cast<std::int32_t>(negative[e]) ||
                from_integer[e] != static_cast<float>(i[e]) || from_unsigned[e] != static_cast<float>(u[e]);
            const auto bits = std::bit_cast<std::uint32_t>(negative[e]);
            wrong_bits += out.outputs[5][e] != bits || out.outputs[6][e] != bits || out.outputs[7][e] != u[e];
            const std::uint64_t a = std::uint64_t{0xD2511F53u} * u[e], b = std::uint64_t{0xffffffffu} * u[e];
            wrong_products += out.outputs[8][e] != a >> 32 || out.outputs[9][e] != (a & 0xffffffffu) ||
                              out.outputs[10][e] != b >> 32 || out.outputs[11][e] != (b & 0xffffffffu);
        }
        CHECK(wrong_conversions == 0);
        CHECK(wrong_bits == 0);
        CHECK(wrong_products == 0);
    }
}

TEST_CASE("active lanes read their own element, the others element 0, wherever they point")
{
    std::vector<float> reals(5);
    std::vector<std::uint32_t> integers(5);
    std::vector<Primitive> primitives(5);
    std::vector<PrimitiveSurface> surfaces(5);
    for (std::uint32_t p = 0; p < 5; ++p) {
        reals[p] = static_cast<float>(p) + 0.125f;
        integers[p] = 50 + p;
        primitives[p].b = make_real4(p, p + 0.25, p + 0.5, p + 0.75);
        surfaces[p] = {100 + p, 200 + p, 300 + p, 400 + p};
    }
    const std::vector<std::uint32_t> index{4, 2, INVALID, 0, 3, INVALID}, active{1, 1, 0, 1, 1, 0};
    const std::vector<std::uint32_t> read{4, 2, 0, 0, 3, 0};
    for (Device& device : test_devices()) {
        const DeviceResults out =
            evaluate_in_all_lanes(functions, device, "gather", {reals, integers, primitives, surfaces, index, active});
        for (std::size_t e = 0; e < index.size(); ++e) {
            CHECK(out.get<float>(0)[e] == static_cast<float>(read[e]) + 0.125f);
            CHECK(out.get<std::uint32_t>(1)[e] == 50 + read[e]);
            for (std::uint32_t member = 0; member < 4; ++member) {
                CHECK(out.get<float>(2 + member)[e] ==
                      static_cast<float>(read[e]) + 0.25f * static_cast<float>(member));
                CHECK(out.get<std::uint32_t>(6 + member)[e] == 100 * (member + 1) + read[e]);
            }
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
