// Smooth glass: Snell's law, Fresnel's shares, radiance scaled by the index of refraction squared.
#include "check/bsdf_suite.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace etendue
{
namespace
{
BsdfCase glass(float ior)
{
    return {BSDF_DIELECTRIC, {ior, 1, 1, 1}, "dielectric"};
}

// Lobe choices spread evenly over all integers: a mean over them is an integral.
std::vector<RandomWords> all_lobes(uint count)
{
    const uint step = 0xffffffffu / count + 1;
    std::vector<RandomWords> words;
    for (uint i = 0; i < count; ++i) words.push_back({0, 0, i * step + step / 2, 0});
    return words;
}

double index_beyond_over_before(float ior, const Direction& wo)
{
    return wo[2] > 0 ? double{ior} : 1 / double{ior};
}

// Share of unpolarised light that is reflected, by the tangent forms of Fresnel's equations.
double reflected_share(double cosine, double eta)
{
    const double angle = std::acos(cosine), sine = std::sin(angle) / eta;
    if (sine >= 1) return 1;
    if (angle < 1e-3) return std::pow((eta - 1) / (eta + 1), 2);
    const double beyond = std::asin(sine);
    const double s = std::sin(angle - beyond) / std::sin(angle + beyond);
    const double p = std::tan(angle - beyond) / std::tan(angle + beyond);
    return (s * s + p * p) / 2;
}
} // namespace

TEST_CASE("glass reflects and refracts all light: the shares are Fresnel's, and add up to one")
{
    constexpr uint LOBES = 1 << 14;
    for (const Device& device : test_devices())
        for (const float ior : {1.33f, 1.5f, 2.4f, 1 / 1.5f, 100.0f})
            for (const Direction& wo : standard_directions()) {
                const double eta = index_beyond_over_before(ior, wo);
                double reflected = 0, refracted = 0, share = 0;
                for (const auto& s : DeviceBsdf(device, glass(ior)).sample({wo}, all_lobes(LOBES))) {
                    const bool reflects = (s.wi[2] > 0) == (wo[2] > 0);
                    share += reflects ? 1.0 / LOBES : 0;
                    (reflects ? reflected : refracted) += s.weight[0] / LOBES * (reflects ? 1 : eta * eta);
                }
                CAPTURE(ior, wo[2]);
                CHECK(reflected + refracted == Approx(1).epsilon(1e-6));
                CHECK(share == Approx(reflected_share(std::abs(wo[2]), eta)).margin(1e-4).epsilon(1e-4));
            }
}

TEST_CASE(
    "glass mirrors exactly, refracts by Snell's law into the plane of incidence, and scales radiance by 1 / eta^2")
{
    for (const Device& device : test_devices())
        for (const float ior : {1.33f, 1.5f, 2.4f, 1 / 1.5f})
            for (const Direction& wo : standard_directions()) {
                const double eta = index_beyond_over_before(ior, wo);
                CAPTURE(ior, wo[2]);
                for (const auto& s : DeviceBsdf(device, glass(ior)).sample({wo}, all_lobes(512))) {
                    if ((s.wi[2] > 0) == (wo[2] > 0)) {
                        const bool mirrored = s.wi == Direction{-wo[0], -wo[1], wo[2]};
                        CHECK(mirrored);
                        CHECK(s.radiance_scale == 1.0f);
                        CHECK(s.weight[0] == Approx(1).epsilon(1e-6));
                        continue;
                    }
                    CHECK(s.wi[0] == Approx(-wo[0] / eta).margin(1e-7).epsilon(3e-7));
                    CHECK(s.wi[1] == Approx(-wo[1] / eta).margin(1e-7).epsilon(3e-7));
                    CHECK(std::hypot(double{s.wi[0]}, double{s.wi[1]}, double{s.wi[2]}) == Approx(1).epsilon(1e-6));
                    CHECK(s.radiance_scale == Approx(1 / (eta * eta)).epsilon(1e-6));
                    CHECK(s.weight[0] == Approx(1 / (eta * eta)).epsilon(1e-6));
                }
            }
}

TEST_CASE("beyond the critical angle glass is a mirror, whatever the choice")
{
    for (const Device& device : test_devices())
        for (const float cosine : {0.74f, 0.5f, 1e-3f, 1e-30f}) { // the critical cosine of 1.5 is 0.745
            const Direction wo{std::sqrt(1 - cosine * cosine), 0, -cosine};
            for (const auto& s : DeviceBsdf(device, glass(1.5f)).sample({wo}, all_lobes(4096))) {
                const bool mirrored = s.wi == Direction{-wo[0], 0, wo[2]};
                CHECK(mirrored);
                CHECK(s.weight == std::array<float, 3>{1, 1, 1});
            }
        }
}

TEST_CASE("glass of the index of its surroundings is not there")
{
    for (const Device& device : test_devices())
        for (const float ior : {1.0f, std::nextafter(1.0f, 2.0f), std::nextafter(1.0f, 0.0f)})
            for (const Direction& wo : standard_directions()) {
                CAPTURE(ior - 1, wo[2]);
                // The integer 0 reflects whatever the share.
                std::vector<RandomWords> lobes = all_lobes(256);
                lobes.push_back({0, 0, 0, 0});
                std::size_t reflected = 0;
                for (const auto& s : DeviceBsdf(device, glass(ior)).sample({wo}, lobes)) {
                    const bool reflects = (s.wi[2] > 0) == (wo[2] > 0);
                    reflected += reflects;
                    // Of a share of a few integers the last one may be cut off.
                    CHECK(s.weight[0] == Approx(1).epsilon(reflects ? 0.5 : 1e-6));
                    CHECK(std::abs(s.wi[0] + wo[0]) <= 1e-6);
                    CHECK(std::abs(s.wi[1] + wo[1]) <= 1e-6);
                    // At an index of 1 +- 1e-7 the direction bends by that over the cosine.
                    const double allowed = ior == 1.0f ? 1e-7 : 1e-7 + 2e-7 / std::abs(wo[2]);
                    CHECK(std::abs(std::abs(s.wi[2]) - std::abs(wo[2])) <= allowed);
                }
                // One in a thousand at a cosine of 0.001.
                CHECK(reflected <= (ior == 1.0f || std::abs(wo[2]) > 0.05f ? 0 : 2));
            }
}

TEST_CASE("the tint multiplies both lobes")
{
    const BsdfCase tinted{BSDF_DIELECTRIC, {1.5f, 0.25f, 0.5f, 1.0f}, "dielectric"};
    for (const Device& device : test_devices())
        for (const auto& s : DeviceBsdf(device, tinted).sample({{0.8f, 0, 0.6f}}, all_lobes(256))) {
            CHECK(s.weight[0] == Approx(0.25 * s.weight[2]).epsilon(1e-6));
            CHECK(s.weight[1] == Approx(0.5 * s.weight[2]).epsilon(1e-6));
        }
}
} // namespace etendue
