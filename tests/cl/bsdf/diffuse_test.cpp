// Lambert's law: value, density and samples agree with each other and with their integrals.
#include "support/device_evaluate.h"
#include "util/statistics.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace etendue;

namespace
{
const DeviceFunctions DIFFUSE({"bsdf/diffuse.h"}, {{"sample", "float uint uint -> float float float float float", R"(
    DiffuseParameters p = {vec3((Float)(0.25), (Float)(0.5), (Float)(0.75))};
    RandomBlock random = {in1, in2, in1, in2};
    BsdfSample s = diffuse_sample(p, vec3(sqrt(1.0 - in0 * in0), (Float)(0.0), in0), random);
    out0 = s.wi.x; out1 = s.wi.y; out2 = s.wi.z; out3 = s.weight.y; out4 = s.pdf;)"},
                                                   {"twins", "float float float float -> float float", R"(
    DiffuseParameters p = {vec3((Float)(0.25), (Float)(0.5), (Float)(0.75))};
    Vec3 wo = vec3(sqrt(1.0 - in0 * in0), (Float)(0.0), in0), wi = vec3(in1, in2, in3);
    out0 = diffuse_evaluate(p, wo, wi).y; out1 = diffuse_pdf(p, wo, wi);)"}});

struct Samples {
    std::vector<float> x, y, z, weight, pdf, u, v;
};

Samples draw(const Device& device, float cosine, std::size_t count)
{
    std::mt19937 random(2);
    std::vector<std::uint32_t> a, b;
    for (std::size_t i = 0; i < count; ++i) {
        a.push_back(i == 0 ? 0u : i == 1 ? 0xffffffffu : static_cast<std::uint32_t>(random()));
        b.push_back(i == 0 ? 0xffffffffu : i == 1 ? 0u : static_cast<std::uint32_t>(random()));
    }
    const auto r = DIFFUSE.evaluate(device, "sample", {std::vector<float>(count, cosine), a, b});
    Samples s{r.get<float>(0), r.get<float>(1), r.get<float>(2), r.get<float>(3), r.get<float>(4), {}, {}};
    for (std::size_t i = 0; i < count; ++i) {
        s.u.push_back(static_cast<float>(a[i] >> 8) * 0x1p-24f);
        s.v.push_back(static_cast<float>(b[i] >> 8) * 0x1p-24f);
    }
    return s;
}
} // namespace

TEST_CASE("diffuse samples invert to their random numbers and weigh the albedo", "[kernel]")
{
    for (const Device& device : test_devices())
        for (const float cosine : {1.0f, 0.3f, 0.001f, -0.5f}) {
            const Samples s = draw(device, cosine, 20000);
            for (std::size_t i = 0; i < s.x.size(); ++i) {
                REQUIRE((s.z[i] > 0.0f) == (cosine > 0.0f));
                REQUIRE(s.weight[i] == 0.5f);
                const double r2 = static_cast<double>(s.x[i]) * s.x[i] + static_cast<double>(s.y[i]) * s.y[i];
                REQUIRE(std::abs(r2 - s.v[i]) <= 1e-6);
                REQUIRE(std::abs(r2 + static_cast<double>(s.z[i]) * s.z[i] - 1.0) <= 1e-6);
                double turn = std::atan2(s.y[i], s.x[i]) / (2.0 * std::numbers::pi);
                turn -= std::floor(turn);
                const double off = std::abs(turn - s.u[i]);
                if (r2 > 1e-6) REQUIRE(std::min(off, 1.0 - off) <= 1e-6);
            }
        }
}

TEST_CASE("a diffuse weight is f cos over pdf, f is reciprocal, and nothing goes through", "[kernel]")
{
    for (const Device& device : test_devices()) {
        const Samples s = draw(device, 0.4f, 10000);
        const std::vector<float> cosine(s.x.size(), 0.4f);
        const auto r = DIFFUSE.evaluate(device, "twins", {cosine, s.x, s.y, s.z});
        const auto f = r.get<float>(0), pdf = r.get<float>(1);
        for (std::size_t i = 0; i < s.x.size(); ++i) {
            REQUIRE(std::abs(f[i] - 0.5 / std::numbers::pi) <= 1e-7);
            REQUIRE(pdf[i] == Approx(s.pdf[i]).epsilon(64 * 0x1p-24));
            REQUIRE(static_cast<double>(f[i]) * s.z[i] / pdf[i] == Approx(s.weight[i]).epsilon(64 * 0x1p-24));
        }
        std::vector<float> below = s.z;
        for (float& z : below) z = -z;
        const auto through = DIFFUSE.evaluate(device, "twins", {cosine, s.x, s.y, below});
        for (std::size_t i = 0; i < s.x.size(); ++i)
            REQUIRE((through.get<float>(0)[i] == 0.0f && through.get<float>(1)[i] == 0.0f));
        // wo along the surface: nothing is sampled.
        CHECK(draw(device, 0.0f, 4).pdf == std::vector<float>(4, 0.0f));
    }
}

TEST_CASE("diffuse samples have their density, by chi-square", "[kernel]")
{
    constexpr std::size_t COUNT = 1u << 18, ROWS = 16, COLUMNS = 32;
    for (const Device& device : test_devices()) {
        const Samples s = draw(device, 0.8f, COUNT);
        // Bins of equal mass: cos^2 and phi are uniform.
        std::vector<double> bins(ROWS * COLUMNS, 0.0);
        for (std::size_t i = 0; i < COUNT; ++i) {
            double turn = std::atan2(s.y[i], s.x[i]) / (2.0 * std::numbers::pi);
            turn -= std::floor(turn);
            const auto row =
                std::min<std::size_t>(static_cast<std::size_t>(static_cast<double>(s.z[i]) * s.z[i] * ROWS), ROWS - 1);
            const auto column = std::min<std::size_t>(static_cast<std::size_t>(turn * COLUMNS), COLUMNS - 1);
            bins[row * COLUMNS + column] += 1.0;
        }
        const double expected = static_cast<double>(COUNT) / static_cast<double>(bins.size());
        double statistic = 0.0;
        for (const double b : bins) statistic += (b - expected) * (b - expected) / expected;
        // 512 samples a bin: a bin that is off by a fifth adds 20 to the statistic.
        CHECK(chi_square_p_value(statistic, static_cast<double>(bins.size() - 1)) > 1e-4);
    }
}
