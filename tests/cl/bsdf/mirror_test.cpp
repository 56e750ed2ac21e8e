// The perfect mirror.
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

using namespace etendue;

namespace
{
const DeviceFunctions MIRROR({"bsdf/mirror.h"},
                             {{"sample", "float float float -> float float float float float mask float float", R"(
    MirrorParameters p = {vec3((Float)(0.25), (Float)(0.5), (Float)(0.75))};
    Vec3 wo = vec3(in0, in1, in2);
    RandomBlock random = {(Uint)(7u), (Uint)(7u), (Uint)(7u), (Uint)(7u)};
    BsdfSample s = mirror_sample(p, wo, random);
    out0 = s.wi.x; out1 = s.wi.y; out2 = s.wi.z; out3 = s.weight.y; out4 = s.pdf; out5 = s.delta;
    out6 = mirror_pdf(p, wo, s.wi); out7 = mirror_evaluate(p, wo, s.wi).y;)"}});
} // namespace

TEST_CASE("a mirror sends everything where the angle of reflection says, on both sides", "[kernel]")
{
    const std::vector<float> x{0.6f, -0.6f, 0.0f, 1.0f}, y{0.0f, 0.48f, 0.0f, 0.0f}, z{0.8f, -0.64f, 1.0f, 0.0f};
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const auto r = MIRROR.evaluate(device, "sample", {x, y, z}, lanes);
            for (std::size_t i = 0; i < x.size(); ++i) {
                CHECK(r.get<float>(0)[i] == -x[i]);
                CHECK(r.get<float>(1)[i] == -y[i]);
                CHECK(r.get<float>(2)[i] == z[i]);
                CHECK(r.get<float>(3)[i] == 0.5f);
                CHECK(r.get<std::uint32_t>(5)[i] == 1u);
                // A direction along the surface is on no side; no light sample reaches a delta lobe.
                CHECK(r.get<float>(4)[i] == (z[i] == 0.0f ? 0.0f : 1.0f));
                CHECK(r.get<float>(6)[i] == 0.0f);
                CHECK(r.get<float>(7)[i] == 0.0f);
            }
        }
}
