// Lambert's law in closed form, and its sampling turned back into the random numbers that it came from.
#include "check/bsdf_suite.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

namespace etendue
{
namespace
{
const BsdfCase GREY{BSDF_DIFFUSE, {0.25f, 0.5f, 0.75f}, "diffuse"};
constexpr double PI = std::numbers::pi;
} // namespace

TEST_CASE("a diffuse surface reflects albedo over pi on the side that light comes from, and lets nothing pass")
{
    for (const Device& device : test_devices())
        for (const Direction& wo : standard_directions()) {
            const std::vector<Direction> wi = standard_directions();
            const DeviceBsdf::Evaluation evaluation = DeviceBsdf(device, GREY).evaluate({wo}, wi);
            for (std::size_t i = 0; i < wi.size(); ++i) {
                const bool same_side = (wo[2] > 0) == (wi[i][2] > 0);
                for (std::size_t k = 0; k < 3; ++k)
                    CHECK(evaluation.f[i][k] == Approx(same_side ? GREY.parameters[k] / PI : 0).epsilon(2e-7));
                CHECK(evaluation.pdf[i] == Approx(same_side ? std::abs(wi[i][2]) / PI : 0).epsilon(2e-7));
            }
        }
}

TEST_CASE("the direction of a diffuse sample gives back the random numbers")
{
    // Cosine-weighted directions: the azimuth is uniform, and so is the squared sine.
    std::mt19937 random(29);
    std::vector<RandomWords> words;
    for (int i = 0; i < 1 << 14; ++i)
        words.push_back({static_cast<uint>(random()), static_cast<uint>(random()), static_cast<uint>(random()), 0});
    for (const Device& device : test_devices())
        for (const float side : {1.0f, -1.0f}) {
            double worst_u = 0, worst_v = 0;
            const auto samples = DeviceBsdf(device, GREY).sample({{0.6f, 0, side * 0.8f}}, words);
            for (std::size_t i = 0; i < words.size(); ++i) {
                const Direction& w = samples[i].wi;
                const double u = (words[i][0] >> 8) * 0x1p-24, v = (words[i][1] >> 8) * 0x1p-24;
                const double sine2 = double{w[0]} * w[0] + double{w[1]} * w[1];
                const double turn = std::atan2(w[1], w[0]) / (2 * PI);
                worst_u = std::max(worst_u, std::abs(std::remainder(turn - u, 1.0)));
                worst_v = std::max(worst_v, std::abs(sine2 - v));
                if (w[2] * side <= 0 || samples[i].delta) worst_v = 1;
            }
            CHECK(worst_u <= 1e-6);
            CHECK(worst_v <= 1e-6);
        }
}
} // namespace etendue
