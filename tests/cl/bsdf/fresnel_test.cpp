// Fresnel's equations against double, around the critical angle above all.
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace etendue;

namespace
{
const DeviceFunctions FRESNEL({"bsdf/fresnel.h"}, {{"fresnel", "float float -> float float",
                                                    "out0 = fresnel_dielectric(in0, in1, &out1);"}});

double reflectance(double cos_i, double eta)
{
    const double squared = eta * eta - 1.0 + cos_i * cos_i;
    if (squared <= 0.0) return 1.0;
    const double g = std::sqrt(squared);
    const double s = (cos_i - g) / (cos_i + g), p = (eta * eta * cos_i - g) / (eta * eta * cos_i + g);
    return 0.5 * (s * s + p * p);
}
} // namespace

TEST_CASE("reflectance agrees with double for every angle and index", "[kernel]")
{
    std::vector<float> cosines, etas;
    for (const double eta : {0.01, 1 / 2.4, 1 / 1.5, 0.9999999, 1.0, 1.0000001, 1.33, 1.5, 2.4, 100.0})
        for (int i = 1; i <= 1000; ++i) {
            cosines.push_back(static_cast<float>(i / 1000.0));
            etas.push_back(static_cast<float>(eta));
        }
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : {1u, 16u}) {
            const auto found = FRESNEL.evaluate<float>(device, "fresnel", {cosines, etas}, lanes);
            double worst = 0.0;
            for (std::size_t i = 0; i < found.size(); ++i) {
                REQUIRE(found[i] >= 0.0f);
                REQUIRE(found[i] <= 1.0f);
                worst = std::max(worst, std::abs(found[i] - reflectance(cosines[i], etas[i])));
            }
            INFO("worst error " << worst);
            CHECK(worst <= 1e-5);
        }
}

TEST_CASE("an index of 1 reflects nothing", "[kernel]")
{
    std::vector<float> cosines;
    for (int i = 1; i <= 4096; ++i) cosines.push_back(static_cast<float>(i) / 4096.0f);
    for (const Device& device : test_devices())
        for (const float r :
             FRESNEL.evaluate<float>(device, "fresnel", {cosines, std::vector<float>(cosines.size(), 1.0f)}))
            REQUIRE(r == 0.0f);
}

TEST_CASE("around the critical angle reflectance is right, at most 1, and 1 beyond", "[kernel]")
{
    std::vector<float> cosines, etas;
    for (const float eta : {1 / 1.33f, 1 / 1.5f, 1 / 2.4f, 0.999f}) {
        float c = static_cast<float>(std::sqrt(1.0 - static_cast<double>(eta) * eta));
        for (int i = 0; i < 64; ++i) c = std::nextafter(c, 0.0f);
        for (int i = 0; i < 129; ++i, c = std::nextafter(c, 1.0f)) {
            cosines.push_back(c);
            etas.push_back(eta);
        }
    }
    for (const Device& device : test_devices()) {
        const auto found = FRESNEL.evaluate<float>(device, "fresnel", {cosines, etas});
        for (std::size_t i = 0; i < found.size(); ++i) {
            INFO(cosines[i] << " " << etas[i]);
            REQUIRE(found[i] <= 1.0f);
            REQUIRE(std::abs(found[i] - reflectance(cosines[i], etas[i])) <= 1e-4);
            if (static_cast<double>(etas[i]) * etas[i] - 1.0 + static_cast<double>(cosines[i]) * cosines[i] < -1e-15)
                REQUIRE(found[i] == 1.0f);
            if (i % 129 != 0) REQUIRE(found[i] <= found[i - 1]);
        }
    }
}
