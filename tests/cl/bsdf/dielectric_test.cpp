// Smooth glass: one of two directions, with Fresnel's probability, by Snell's law.
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace etendue;

namespace
{
const DeviceFunctions GLASS({"bsdf/dielectric.h"},
                            {{"sample", "float float float float uint -> float float float float float float mask", R"(
    DielectricParameters p = {in0, white()};
    RandomBlock random = {in4, in4, in4, in4};
    BsdfSample s = dielectric_sample(p, vec3(in1, in2, in3), random);
    out0 = s.wi.x; out1 = s.wi.y; out2 = s.wi.z; out3 = s.weight.y; out4 = s.pdf; out5 = s.radiance_scale; out6 = s.delta;)"},
                             {"twin", "float float float -> float float", R"(
    DielectricParameters p = {(Float)(1.5), white()};
    Vec3 wo = vec3(in0, in1, in2);
    out0 = dielectric_pdf(p, wo, negate3(wo)); out1 = dielectric_evaluate(p, wo, negate3(wo)).x;)"}});

struct Directions {
    std::vector<float> x, y, z;
    void add(double cosine, double phi)
    {
        const double sine = std::sqrt(1.0 - cosine * cosine);
        x.push_back(static_cast<float>(sine * std::cos(phi)));
        y.push_back(static_cast<float>(sine * std::sin(phi)));
        z.push_back(static_cast<float>(cosine));
    }
};

double reflectance(double cos_i, double eta)
{
    const double squared = eta * eta - 1.0 + cos_i * cos_i;
    if (squared <= 0.0) return 1.0;
    const double g = std::sqrt(squared);
    const double s = (cos_i - g) / (cos_i + g), p = (eta * eta * cos_i - g) / (eta * eta * cos_i + g);
    return 0.5 * (s * s + p * p);
}
} // namespace

TEST_CASE("glass mirrors or refracts by Snell's law, with the weight of radiance", "[kernel]")
{
    Directions wo;
    std::vector<float> ior;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(0.01, 1.0);
    for (int i = 0; i < 4000; ++i) {
        wo.add(i % 2 ? u(random) : -u(random), 6.28 * u(random));
        ior.push_back(std::vector<float>{1.0f, 1.33f, 1.5f, 2.4f, 1 / 1.5f}[static_cast<std::size_t>(i) % 5]);
    }
    for (const Device& device : test_devices())
        for (const std::uint32_t bits : {0u, 0xffffffffu}) {
            const auto r =
                GLASS.evaluate(device, "sample", {ior, wo.x, wo.y, wo.z, std::vector<std::uint32_t>(ior.size(), bits)});
            const auto x = r.get<float>(0), y = r.get<float>(1), z = r.get<float>(2), weight = r.get<float>(3),
                       scale = r.get<float>(5);
            for (std::size_t i = 0; i < ior.size(); ++i) {
                const double eta = wo.z[i] > 0 ? ior[i] : 1.0 / ior[i];
                const double chance = reflectance(std::abs(wo.z[i]), eta);
                INFO("ior " << ior[i] << " cos " << wo.z[i] << " bits " << bits);
                REQUIRE(r.get<float>(4)[i] == 1.0f);
                REQUIRE(r.get<std::uint32_t>(6)[i] == 1u);
                const bool reflected = (z[i] > 0) == (wo.z[i] > 0);
                // The lowest integer reflects where anything does, the highest refracts where anything does.
                if (chance > 1e-9 && bits == 0) REQUIRE(reflected);
                if (chance < 1.0 && bits != 0) REQUIRE(!reflected);
                const double tangent = reflected ? -1.0 : -1.0 / eta;
                CHECK(std::abs(x[i] - tangent * wo.x[i]) <= 4e-7);
                CHECK(std::abs(y[i] - tangent * wo.y[i]) <= 4e-7);
                // Near the critical angle the cosine is the root of a small difference: compare squares.
                const double sine2 = tangent * tangent * (1.0 - static_cast<double>(wo.z[i]) * wo.z[i]);
                CHECK(std::abs(z[i] * z[i] - (1.0 - sine2)) <= 1e-6);
                CHECK(weight[i] == Approx(reflected ? 1.0 : 1.0 / (eta * eta)).epsilon(1e-6));
                CHECK(scale[i] == Approx(reflected ? 1.0 : 1.0 / (eta * eta)).epsilon(1e-6));
            }
        }
}

TEST_CASE("glass reflects as often as Fresnel says", "[kernel]")
{
    constexpr std::size_t STRATA = 1u << 16;
    std::vector<std::uint32_t> bits;
    for (std::size_t i = 0; i < STRATA; ++i) bits.push_back(static_cast<std::uint32_t>(i << 16 | 0x8000));
    for (const Device& device : test_devices())
        for (const double cosine : {1.0, 0.7, 0.3, 0.05, -0.9, -0.76}) {
            Directions wo;
            for (std::size_t i = 0; i < STRATA; ++i) wo.add(cosine, 0.5);
            const auto z = GLASS.evaluate(device, "sample", {std::vector<float>(STRATA, 1.5f), wo.x, wo.y, wo.z, bits})
                               .get<float>(2);
            std::size_t reflected = 0;
            for (const float w : z) reflected += (w > 0) == (cosine > 0);
            const double expected = reflectance(std::abs(cosine), cosine > 0 ? 1.5 : 1.0 / 1.5);
            // Stratified bits count to within one stratum.
            CHECK(std::abs(static_cast<double>(reflected) / STRATA - expected) <= 1.5 / STRATA + 1e-6);
        }
}

TEST_CASE("no light sample can reach glass", "[kernel]")
{
    for (const Device& device : test_devices()) {
        const auto r = GLASS.evaluate(device, "twin",
                                      {std::vector<float>{0.6f}, std::vector<float>{0.0f}, std::vector<float>{0.8f}});
        CHECK(r.get<float>(0)[0] == 0.0f);
        CHECK(r.get<float>(1)[0] == 0.0f);
    }
}
