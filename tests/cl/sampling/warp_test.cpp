// Sampled shapes: their ranges at the ends of the unit square, and their distributions against the densities.
#include "support/device_evaluate.h"

#include "math/vector.h"
#include "util/statistics.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

using namespace etendue;

namespace
{
constexpr float ONE_MINUS_COS = 1e-4f;
constexpr float GAUSSIAN_RADIUS = 2.0f;
const float GAUSSIAN_MASS = static_cast<float>(-std::expm1(-0.5 * GAUSSIAN_RADIUS * GAUSSIAN_RADIUS));

// A warp of (u, v) into w = (x, y, z); z is 0 for points of the plane.
DeviceFunction warp(const std::string& name, const std::string& statements)
{
    return {name, "float float -> float float float", statements + " out0 = w.x; out1 = w.y; out2 = w.z;"};
}

const DeviceFunctions functions(
    {"sampling/warp.h"},
    {
        warp("cosine_hemisphere", "Vec3 w = cosine_hemisphere_sample(in0, in1);"),
        warp("uniform_hemisphere", "Vec3 w = uniform_hemisphere_sample(in0, in1);"),
        warp("uniform_sphere", "Vec3 w = uniform_sphere_sample(in0, in1);"),
        warp("uniform_cone", "Vec3 w = uniform_cone_sample(in0, in1, (Float)(1e-4f));"),
        warp("triangle", "Vec2 p = uniform_triangle_sample(in0, in1); Vec3 w = vec3(p.x, p.y, (Float)(0.0f));"),
        warp("disk", "Vec2 p = uniform_disk_sample(in0, in1); Vec3 w = vec3(p.x, p.y, (Float)(0.0f));"),
        warp("tent", "Vec3 w = vec3(tent_sample(in0), tent_sample(in1), (Float)(0.0f));"),
        {"gaussian", "float float float* -> float float float",
         "Vec2 p = truncated_gaussian_sample(in0, in1, (Float)(in2[0]), (Float)(in2[1])); out0 = p.x; out1 = p.y; out2 "
         "= (Float)(0.0f);"},
        {"densities", "float -> float float float float float",
         "Vec3 w = vec3((Float)(0.0f), (Float)(0.0f), in0); out0 = cosine_hemisphere_pdf(w); out1 = "
         "uniform_hemisphere_pdf(w); out2 = uniform_sphere_pdf(); out3 = uniform_cone_pdf((Float)(1e-4f)); out4 = "
         "uniform_disk_pdf_area();"},
    });

constexpr std::size_t SAMPLES = 1 << 17;
constexpr float LAST = 16777215.0f / 16777216.0f;

std::vector<float> uniform_floats(unsigned seed)
{
    std::mt19937 engine(seed);
    std::vector<float> values(SAMPLES);
    for (float& value : values) value = static_cast<float>(engine() >> 8) * 0x1p-24f;
    return values;
}

std::vector<Vec3> sample(const Device& device, const std::string& name, const std::vector<float>& u,
                         const std::vector<float>& v)
{
    std::vector<DeviceArgument> arguments{u, v};
    if (name == "gaussian") arguments.emplace_back(std::vector<float>{GAUSSIAN_RADIUS, GAUSSIAN_MASS});
    const DeviceResults out = functions.evaluate(device, name, arguments);
    const auto x = out.get<float>(0), y = out.get<float>(1), z = out.get<float>(2);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < x.size(); ++i) points.emplace_back(x[i], y[i], z[i]);
    return points;
}

// A warp, two coordinates that are independent and uniform over [0, 1] if its density is right (its cumulative
// distribution functions), and the domain it must stay in.
struct Warp {
    std::string name;
    std::function<double(const Vec3&)> first, second;
    std::function<bool(const Vec3&)> contains;
};

double turns(const Vec3& w)
{
    const double t = std::atan2(w.y, w.x) / (2.0 * std::numbers::pi);
    return t < 0.0 ? t + 1.0 : t;
}
bool is_unit(const Vec3& w)
{
    return std::fabs(glm::length(w) - 1.0) < 4e-7;
}
double radius_squared(const Vec3& w)
{
    return w.x * w.x + w.y * w.y;
}
double tent_cdf(double x)
{
    return x < 0.0 ? 0.5 * (1.0 + x) * (1.0 + x) : 1.0 - 0.5 * (1.0 - x) * (1.0 - x);
}

const std::vector<Warp> WARPS{
    {"cosine_hemisphere", turns, [](const Vec3& w) { return w.z * w.z; },
     [](const Vec3& w) { return is_unit(w) && w.z > 0.0; }},
    {"uniform_hemisphere", turns, [](const Vec3& w) { return w.z; },
     [](const Vec3& w) { return is_unit(w) && w.z > 0.0; }},
    {"uniform_sphere", turns, [](const Vec3& w) { return 0.5 * (w.z + 1.0); }, is_unit},
    // The sine tells the angle that the cosine of a small cone has lost.
    {"uniform_cone", turns,
     [](const Vec3& w) {
         const double sine_squared = radius_squared(w);
         return sine_squared / (1.0 + std::sqrt(1.0 - sine_squared)) / double{ONE_MINUS_COS};
     },
     [](const Vec3& w) { return is_unit(w) && w.z >= 1.0 - double{ONE_MINUS_COS} - 1e-7; }},
    {"triangle", [](const Vec3& w) { return (w.x + w.y) * (w.x + w.y); },
     [](const Vec3& w) { return w.x + w.y > 0.0 ? w.y / (w.x + w.y) : 0.0; },
     [](const Vec3& w) { return w.x >= 0.0 && w.y >= 0.0 && w.x + w.y <= 1.0 + 1e-7; }},
    {"disk", turns, radius_squared, [](const Vec3& w) { return radius_squared(w) <= 1.0 + 4e-7; }},
    {"tent", [](const Vec3& w) { return tent_cdf(w.x); }, [](const Vec3& w) { return tent_cdf(w.y); },
     [](const Vec3& w) { return std::fabs(w.x) <= 1.0 && std::fabs(w.y) <= 1.0; }},
    {"gaussian", turns, [](const Vec3& w) { return std::expm1(-0.5 * radius_squared(w)) / std::expm1(-2.0); },
     [](const Vec3& w) { return std::sqrt(radius_squared(w)) <= GAUSSIAN_RADIUS * (1.0 + 4e-7); }},
};

// Pearson's test that points are uniform over the unit square, in 16 x 16 cells.
double uniform_square_p_value(const std::vector<Vec3>& points, const Warp& warp)
{
    constexpr int SIDE = 16;
    std::vector<double> counts(SIDE * SIDE, 0.0);
    for (const Vec3& w : points) {
        const int column = std::clamp(static_cast<int>(warp.first(w) * SIDE), 0, SIDE - 1);
        const int row = std::clamp(static_cast<int>(warp.second(w) * SIDE), 0, SIDE - 1);
        counts[static_cast<std::size_t>(row * SIDE + column)] += 1.0;
    }
    const double expected = static_cast<double>(points.size()) / (SIDE * SIDE);
    double statistic = 0.0;
    for (const double count : counts) statistic += (count - expected) * (count - expected) / expected;
    return chi_square_p_value(statistic, SIDE * SIDE - 1);
}
} // namespace

TEST_CASE("every warp stays finite and in its domain, at the corners of the unit square too")
{
    std::vector<float> u = uniform_floats(1), v = uniform_floats(2);
    for (const float a : {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, LAST})
        for (const float b : {0.0f, 0x1p-24f, 0.5f, LAST}) {
            u.push_back(a), v.push_back(b);
            u.push_back(b), v.push_back(a);
        }
    for (Device& device : test_devices())
        for (const Warp& warp : WARPS) {
            const auto points = sample(device, warp.name, u, v);
            INFO(warp.name);
            CHECK(std::all_of(points.begin(), points.end(), warp.contains));
        }
}

TEST_CASE("every warp has the distribution of its density")
{
    const double alpha = sidak_alpha(1e-6, WARPS.size());
    const std::vector<float> u = uniform_floats(3), v = uniform_floats(4);
    for (Device& device : test_devices())
        for (const Warp& warp : WARPS) {
            INFO(warp.name);
            CHECK(uniform_square_p_value(sample(device, warp.name, u, v), warp) > alpha);
        }
}

TEST_CASE("densities are those of the closed forms, zero below the hemisphere")
{
    const double pi = std::numbers::pi;
    const std::vector<float> z{1.0f, 0.5f, 1e-6f, 0.0f, -0.5f, -1.0f};
    for (Device& device : test_devices()) {
        const DeviceResults out = functions.evaluate(device, "densities", {z});
        for (std::size_t i = 0; i < z.size(); ++i) {
            CHECK(out.get<float>(0)[i] == Approx(std::max(0.0f, z[i]) / pi).epsilon(1e-6));
            CHECK(out.get<float>(1)[i] == Approx(z[i] > 0.0f ? 0.5 / pi : 0.0).epsilon(1e-6));
            CHECK(out.get<float>(2)[i] == Approx(0.25 / pi).epsilon(1e-6));
            CHECK(out.get<float>(3)[i] == Approx(0.5 / pi / double{ONE_MINUS_COS}).epsilon(1e-6));
            CHECK(out.get<float>(4)[i] == Approx(1.0 / pi).epsilon(1e-6));
        }
    }
}

TEST_CASE("the mean of sampled directions and points is that of the shape")
{
    const std::vector<float> u = uniform_floats(5), v = uniform_floats(6);
    const struct {
        std::string name;
        Vec3 mean;
    } shapes[] = {{"cosine_hemisphere", {0, 0, 2.0 / 3.0}},
                  {"uniform_hemisphere", {0, 0, 0.5}},
                  {"uniform_sphere", {0, 0, 0}},
                  {"triangle", {1.0 / 3.0, 1.0 / 3.0, 0}},
                  {"disk", {0, 0, 0}},
                  {"tent", {0, 0, 0}},
                  {"gaussian", {0, 0, 0}}};
    for (Device& device : test_devices())
        for (const auto& shape : shapes) {
            RunningStatistics axes[3];
            for (const Vec3& w : sample(device, shape.name, u, v))
                for (int k = 0; k < 3; ++k) axes[k].add(w[k]);
            INFO(shape.name);
            for (int k = 0; k < 3; ++k)
                CHECK(std::fabs(axes[k].mean() - shape.mean[k]) <= 5.0 * axes[k].standard_error());
        }
}
