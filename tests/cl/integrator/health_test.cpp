// Accidents: the first of a path is kept, as a code that a float holds exactly.
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

namespace etendue
{
namespace
{
const DeviceFunctions
    functions({"integrator/health.h"},
              {{"code", "uint -> uint float", "out0 = accident_code(HEALTH_INVALID_RAY, in0); out1 = to_float(out0);"},
               {"note", "uint mask uint -> uint",
                "Uint accident = in0;\n"
                "note_accident(&accident, in1, HEALTH_NON_FINITE_PDF, in2);\n"
                "out0 = accident;"}});
} // namespace

TEST_CASE("an accident's code is kind + 1 + 16 * vertex, with the vertex capped so that a float holds it")
{
    const std::vector<uint> vertices{0, 1, 2, 1000, 65534, 65535, 65536, 0xffffffffu};
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceResults results = functions.evaluate(device, "code", {vertices}, lanes);
            const auto codes = results.get<uint>(0);
            const auto floats = results.get<float>(1);
            for (std::size_t i = 0; i < vertices.size(); ++i) {
                CHECK(codes[i] == HEALTH_INVALID_RAY + 1 + 16 * std::min(vertices[i], 65535u));
                CHECK(static_cast<double>(floats[i]) == codes[i]);
                CHECK((codes[i] & 15u) - 1u == HEALTH_INVALID_RAY);
            }
        }
}

TEST_CASE("every kind of accident fits the four bits of its code")
{
    STATIC_REQUIRE(HEALTH_KINDS + 1 <= 16);
    STATIC_REQUIRE(HEALTH_KINDS <= sizeof(LaunchCounters::health) / sizeof(uint));
}

TEST_CASE("the first accident of a lane stays, and lanes outside the mask have none")
{
    const std::vector<uint> before{0, 0, 21, 21}, mask{1, 0, 1, 0}, vertices{3, 3, 3, 3};
    const uint code = HEALTH_NON_FINITE_PDF + 1 + 16 * 3;
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(functions.evaluate<uint>(device, "note", {before, mask, vertices}, lanes) ==
                  std::vector<uint>{code, 0, 21, 21});
}
} // namespace etendue
