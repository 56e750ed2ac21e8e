// What sampling a BSDF gives: nothing, and one of two by lane.
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

namespace etendue
{
namespace
{
const DeviceFunctions functions({"bsdf/sample.h"}, {{"none", "float -> float float mask float",
                                                     "BsdfSample s = no_bsdf_sample();\n"
                                                     "out0 = s.pdf; out1 = in0 * max_component(s.weight);\n"
                                                     "out2 = s.delta; out3 = s.radiance_scale;\n"},
                                                    {"choose", "mask mask mask -> float float float mask float",
                                                     "BsdfSample a = no_bsdf_sample(), b = a;\n"
                                                     "a.wi = a.weight = white(); a.pdf = (Float)(2.0); a.delta = in1;\n"
                                                     "b.pdf = b.radiance_scale = (Float)(3.0); b.delta = in2;\n"
                                                     "BsdfSample s = choose_bsdf_sample(in0, a, b);\n"
                                                     "out0 = s.wi.x; out1 = s.weight.z; out2 = s.pdf; out3 = s.delta;\n"
                                                     "out4 = s.radiance_scale;\n"},
                                                    {"colour", "float* uint mask -> float float float",
                                                     "Color c = load_color(in0, in1, in2);\n"
                                                     "out0 = c.x; out1 = c.y; out2 = c.z;\n"}});
} // namespace

TEST_CASE("a sample of nothing has no density, no weight, and scales nothing")
{
    for (const Device& device : test_devices()) {
        const DeviceResults results = functions.evaluate(device, "none", {std::vector<float>{1, 1, 1}});
        CHECK(results.get<float>(0) == std::vector<float>(3, 0));
        CHECK(results.get<float>(1) == std::vector<float>(3, 0));
        CHECK(results.get<uint>(2) == std::vector<uint>(3, 0));
        CHECK(results.get<float>(3) == std::vector<float>(3, 1));
    }
}

TEST_CASE("each lane takes the sample that its mask asks for, the delta flag included")
{
    // Every combination of: take the first, the first is delta, the second is delta.
    std::vector<uint> take, first_delta, second_delta, delta;
    std::vector<float> ones, pdf, scale;
    for (uint i = 0; i < 8; ++i) {
        take.push_back(i & 1);
        first_delta.push_back(i >> 1 & 1);
        second_delta.push_back(i >> 2 & 1);
        const bool first = (i & 1) != 0;
        delta.push_back(first ? first_delta.back() : second_delta.back());
        ones.push_back(first ? 1.0f : 0.0f);
        pdf.push_back(first ? 2.0f : 3.0f);
        scale.push_back(first ? 1.0f : 3.0f);
    }
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceResults results =
                functions.evaluate(device, "choose", {take, first_delta, second_delta}, lanes);
            CHECK(results.get<float>(0) == ones);
            CHECK(results.get<float>(1) == ones);
            CHECK(results.get<float>(2) == pdf);
            CHECK(results.get<uint>(3) == delta);
            CHECK(results.get<float>(4) == scale);
        }
}

TEST_CASE("a colour is three parameters in a row; lanes that are not active read the first ones")
{
    const std::vector<float> parameters{1, 2, 3, 4, 5, 6};
    for (const Device& device : test_devices()) {
        const DeviceResults results = functions.evaluate(
            device, "colour", {parameters, std::vector<uint>{3, 1, 0xffffff00u}, std::vector<uint>{1, 1, 0}});
        CHECK(results.get<float>(0) == std::vector<float>{4, 2, 1});
        CHECK(results.get<float>(1)[0] == 5);
        CHECK(results.get<float>(2)[0] == 6);
    }
}
} // namespace etendue
