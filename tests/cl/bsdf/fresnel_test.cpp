// Fresnel's equations against extended precision, most of all around the critical angle.
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace etendue
{
namespace
{
const DeviceFunctions functions({"bsdf/fresnel.h"}, {{"fresnel", "float float -> float float",
                                                      "Float eta_cos_t;\n"
                                                      "out0 = fresnel_dielectric(in0, in1, &eta_cos_t);\n"
                                                      "out1 = eta_cos_t;\n"}});

// From Snell's law, with the reflected amplitude of each polarisation (Born and Wolf, Principles of Optics, 1.5.2).
double reflectance(float cos_i, float eta)
{
    const long double c = cos_i, n = eta;
    const long double cos_t2 = 1 - (1 - c * c) / (n * n);
    if (cos_t2 <= 0) return 1;
    const long double t = std::sqrt(cos_t2);
    const long double s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
    return static_cast<double>((s * s + p * p) / 2);
}

struct Reflected {
    std::vector<float> r, eta_cos_t;
};

Reflected fresnel(const Device& device, const std::vector<float>& cos_i, const std::vector<float>& eta)
{
    const DeviceResults results = functions.evaluate(device, "fresnel", {cos_i, eta});
    return {results.get<float>(0), results.get<float>(1)};
}

float steps_from(float x, int steps)
{
    for (; steps > 0; --steps) x = std::nextafter(x, 2.0f);
    for (; steps < 0; ++steps) x = std::nextafter(x, -1.0f);
    return x;
}
} // namespace

TEST_CASE("around the critical angle the reflectance rises to 1 without a jump")
{
    // 64 steps to both sides of the critical cosine sqrt(1 - eta^2), for a million pairs.
    std::vector<float> cos_i, eta;
    std::mt19937 random(31);
    std::uniform_real_distribution<float> u(0.2f, 0.9999f); // below, Brewster's angle comes as close
    constexpr std::size_t INDICES = 8128, STEPS = 129;
    for (std::size_t i = 0; i < INDICES; ++i) {
        const float n = u(random);
        const float critical = static_cast<float>(std::sqrt(1 - double{n} * n));
        for (int step = -64; step <= 64; ++step) {
            cos_i.push_back(steps_from(critical, step));
            eta.push_back(n);
        }
    }
    for (const Device& device : test_devices()) {
        const Reflected found = fresnel(device, cos_i, eta);
        std::size_t out_of_range = 0, not_total = 0, rising = 0;
        double worst = 0;
        for (std::size_t i = 0; i < found.r.size(); ++i) {
            const float r = found.r[i];
            const double expected = reflectance(cos_i[i], eta[i]);
            out_of_range += !(r >= 0 && r <= 1);
            not_total += expected == 1 && (r != 1 || found.eta_cos_t[i] != 0);
            worst = std::max(worst, std::abs(r - expected));
            rising += i % STEPS != 0 && r > found.r[i - 1] + 0x1p-20f; // beyond the rounding of both polarisations
        }
        CHECK(out_of_range == 0);
        CHECK(not_total == 0);
        CHECK(worst <= 1e-4);
        CHECK(rising == 0);
    }
}

TEST_CASE("the reflectance of a dielectric is that of extended precision, at any angle and index")
{
    std::mt19937 random(37);
    std::uniform_real_distribution<float> u(0, 1);
    std::vector<float> cos_i, eta;
    for (int i = 0; i < 1 << 18; ++i) {
        // Half of them close to grazing or close to equal indices.
        const float x = u(random);
        cos_i.push_back(i % 2 ? x : x * x * x * x);
        eta.push_back(i % 4 < 2 ? std::pow(100.0f, 2 * u(random) - 1) : 1 + 1e-4f * (u(random) - 0.5f));
    }
    for (const Device& device : test_devices()) {
        const Reflected found = fresnel(device, cos_i, eta);
        std::size_t out_of_range = 0;
        double worst = 0;
        for (std::size_t i = 0; i < found.r.size(); ++i) {
            out_of_range += !(found.r[i] >= 0 && found.r[i] <= 1);
            worst = std::max(worst, std::abs(found.r[i] - reflectance(cos_i[i], eta[i])));
        }
        CHECK(out_of_range == 0);
        CHECK(worst <= 1e-5);
    }
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
