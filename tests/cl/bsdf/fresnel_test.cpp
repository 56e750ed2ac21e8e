// Fresnel's equations against extended precision, most of all around the critical angle.
#include "check/bsdf_checks.h"
#include "support/device_checks.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace etendue
{
namespace
{
const DeviceFunctions functions({"bsdf/fresnel.h"}, {{"fresnel", "float float -> float float",
                                                      "Float eta_cos_t;\n"
                                                      "out0 = fresnel_dielectric(in0, in1, &eta_cos_t);\n"
                                                      "out1 = eta_cos_t;\n"}});

struct Reflected {
    std::vector<float> r, eta_cos_t;
};

Reflected fresnel(const Device& device, const std::vector<float>& cos_i, const std::vector<float>& eta)
{
    const DeviceResults results = functions.evaluate(device, "fresnel", {cos_i, eta});
    return {results.get<float>(0), results.get<float>(1)};
}
} // namespace

TEST_CASE("around the critical angle the reflectance rises to 1 without a jump, and it is right at any angle and index")
{
    require_passed(fresnel_checks());
}

TEST_CASE("known reflectances: normal incidence, Brewster's angle, grazing, equal indices")
{
    const float brewster = static_cast<float>(1 / std::sqrt(1 + 1.5 * 1.5));
    for (const Device& device : test_devices()) {
        const Reflected found = fresnel(device, {1, 1, 0, 0, 0.3f, 1, 1e-3f, brewster, 1e-45f, 0x1p-126f},
                                        {1.5f, 1 / 1.5f, 1.5f, 0.5f, 1, 1, 1, 1.5f, 1.5f, 0.7f});
        CHECK(found.r[0] == Approx(0.04).epsilon(1e-6));
        CHECK(found.r[1] == Approx(0.04).epsilon(1e-6));
        CHECK(found.r[2] == 1.0f);
        CHECK(found.r[3] == 1.0f);
        for (const std::size_t same_index : {4u, 5u, 6u}) CHECK(found.r[same_index] == 0.0f);
        // Only the perpendicular polarisation is left: half of ((1 - n^2) / (1 + n^2))^2.
        CHECK(found.r[7] == Approx(0.5 * std::pow(1.25 / 3.25, 2)).epsilon(1e-6));
        CHECK(found.r[8] == Approx(1).epsilon(1e-6));
        CHECK(found.r[9] == 1.0f);
    }
}
} // namespace etendue
