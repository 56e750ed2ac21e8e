// Area lights: the mean of 1 / pdf over samples is the solid angle, and each pdf is that of its point.
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace etendue;

namespace
{
const DeviceFunctions AREA({"light/area.h"}, {{"triangle", "float float float -> float float float float", R"(
    Float one = (Float)(1.0), zero = (Float)(0.0);
    AreaPoint p = triangle_light_sample(vec3(zero, in2, zero), vec3(one, in2, zero), vec3(zero, in2, one), vec3(zero, zero, zero), in0, in1);
    out0 = p.to_point.x; out1 = p.to_point.y; out2 = p.to_point.z; out3 = p.pdf;)"},
                                              {"disk", "float float float -> float float float float", R"(
    Float zero = (Float)(0.0);
    AreaPoint p = disk_light_sample(vec3(zero, in2, zero), vec3(zero, (Float)(-1.0), zero), (Float)(0.5), vec3(zero, zero, zero), in0, in1);
    out0 = p.to_point.x; out1 = p.to_point.y; out2 = p.to_point.z; out3 = p.pdf;)"},
                                              {"sphere", "float float float -> float float float float float", R"(
    Float zero = (Float)(0.0);
    Vec3 from = vec3(zero, zero, zero), centre = vec3(zero, in2, zero);
    AreaPoint p = sphere_light_sample(centre, (Float)(0.5), from, in0, in1);
    out0 = p.to_point.x; out1 = p.to_point.y; out2 = p.to_point.z; out3 = p.pdf;
    out4 = sphere_light_pdf(centre, (Float)(0.5), from, p.to_point, p.normal);)"}});

constexpr std::size_t SIDE = 128;

struct Points {
    std::vector<float> x, y, z, pdf, twin;
    double mean_inverse_pdf = 0.0;
};

// A stratified square of random numbers through the sampler of a light at this distance.
Points sample(const Device& device, const std::string& light, float distance)
{
    std::vector<float> u, v;
    for (std::size_t i = 0; i < SIDE * SIDE; ++i) {
        u.push_back((static_cast<float>(i % SIDE) + 0.5f) / SIDE);
        v.push_back((static_cast<float>(i / SIDE) + 0.5f) / SIDE);
    }
    const auto r = AREA.evaluate(device, light, {u, v, std::vector<float>(u.size(), distance)});
    Points points{r.get<float>(0), r.get<float>(1), r.get<float>(2), r.get<float>(3), {}, 0.0};
    if (r.outputs.size() > 4) points.twin = r.get<float>(4);
    for (const float pdf : points.pdf) points.mean_inverse_pdf += 1.0 / pdf / static_cast<double>(u.size());
    return points;
}
} // namespace

TEST_CASE("a triangle light is sampled uniformly by area, with the density of its solid angle", "[kernel]")
{
    for (const Device& device : test_devices())
        for (const float h : {0.3f, 1.0f, 30.0f}) {
            const Points p = sample(device, "triangle", h);
            for (std::size_t i = 0; i < p.x.size(); ++i) {
                REQUIRE(p.y[i] == h);
                REQUIRE((p.x[i] >= 0.0f && p.z[i] >= 0.0f && p.x[i] + p.z[i] <= 1.0f + 1e-6f));
                const double d2 = static_cast<double>(p.x[i]) * p.x[i] + static_cast<double>(p.z[i]) * p.z[i] +
                                  static_cast<double>(h) * h;
                REQUIRE(p.pdf[i] == Approx(d2 * std::sqrt(d2) / (0.5 * h)).epsilon(2e-6));
            }
            // Van Oosterom and Strackee 1983.
            const double a = h, b = std::sqrt(1.0 + a * a);
            const double solid = 2.0 * std::atan2(a, a * b * b + a * a * b + a * a * b + a * a * a);
            CHECK(p.mean_inverse_pdf == Approx(solid).epsilon(5e-3));
        }
}

TEST_CASE("a disk light is sampled with the density of its solid angle", "[kernel]")
{
    for (const Device& device : test_devices())
        for (const float h : {0.2f, 1.0f, 50.0f}) {
            const Points p = sample(device, "disk", h);
            for (std::size_t i = 0; i < p.x.size(); ++i) REQUIRE(std::hypot(p.x[i], p.z[i]) <= 0.5f * (1 + 1e-6f));
            const double cosine = h / std::hypot(h, 0.5);
            CHECK(p.mean_inverse_pdf == Approx(2.0 * std::numbers::pi * (1.0 - cosine)).epsilon(5e-3));
        }
}

TEST_CASE("a sphere light is sampled over its cone from outside and over its area from inside", "[kernel]")
{
    for (const Device& device : test_devices())
        for (const float distance : {0.0f, 0.3f, 0.51f, 2.0f, 1000.0f}) {
            INFO("distance " << distance);
            const Points p = sample(device, "sphere", distance);
            const bool outside = distance > 0.5f;
            const double sine2 = outside ? 0.25 / (static_cast<double>(distance) * distance) : 1.0;
            const double solid =
                outside ? 2.0 * std::numbers::pi * sine2 / (1.0 + std::sqrt(1.0 - sine2)) : 4.0 * std::numbers::pi;
            CHECK(p.mean_inverse_pdf == Approx(solid).epsilon(outside ? 1e-5 : 5e-3));
            for (std::size_t i = 0; i < p.x.size(); ++i) {
                REQUIRE(p.twin[i] == Approx(p.pdf[i]).epsilon(1e-5));
                const double r = std::hypot(static_cast<double>(p.x[i]), static_cast<double>(p.y[i]) - distance,
                                            static_cast<double>(p.z[i]));
                REQUIRE(std::abs(r - 0.5) <= 2e-3 * std::max(1.0f, distance * distance * 1e-3f));
            }
        }
}
