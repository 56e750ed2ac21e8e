// Sampled shapes: their ranges at the ends of the unit square, their inverses in double precision, and their
// distributions against the densities.
#include "support/chi_square.h"
#include "support/device_lanes.h"

#include "math/vector.h"
#include "util/statistics.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>

using namespace etendue;

namespace
{
constexpr float ONE_MINUS_COS = 1e-4f;
constexpr float GAUSSIAN_RADIUS = 2.0f;
const float GAUSSIAN_MASS = static_cast<float>(-std::expm1(-0.5 * GAUSSIAN_RADIUS * GAUSSIAN_RADIUS));

// The warp numbered in input 0, with its parameters in input 1, of (u, v): (x, y, z), z is 0 for points of the plane.
// One kernel for all, as each costs time to compile.
const DeviceFunctions functions(
    {"sampling/warp.h"},
    {
        {"warp", "uint* float* float float -> float float float", R"(
    Vec2 p = vec2((Float)(0.0), (Float)(0.0));
    Vec3 w;
    switch (in0[0]) {
    case 0: w = cosine_hemisphere_sample(in2, in3); break;
    case 1: w = uniform_hemisphere_sample(in2, in3); break;
    case 2: w = uniform_sphere_sample(in2, in3); break;
    case 3: w = uniform_cone_sample(in2, in3, (Float)(in1[0])); break;
    case 4: p = uniform_triangle_sample(in2, in3); break;
    case 5: p = uniform_disk_sample(in2, in3); break;
    case 6: p = vec2(tent_sample(in2), tent_sample(in3)); break;
    case 7: p = truncated_gaussian_sample(in2, in3, (Float)(in1[1]), (Float)(in1[2])); break;
    }
    if (in0[0] >= 4) w = vec3(p.x, p.y, (Float)(0.0));
    out0 = w.x; out1 = w.y; out2 = w.z;)"},
        {"densities", "float* float -> float float float float float",
         "Vec3 w = vec3((Float)(0.0), (Float)(0.0), in1); out0 = cosine_hemisphere_pdf(w);"
         "out1 = uniform_hemisphere_pdf(w); out2 = uniform_sphere_pdf(); out3 = uniform_cone_pdf((Float)(in0[0]));"
         "out4 = uniform_disk_pdf_area();"},
    });

constexpr std::size_t SAMPLES = 1 << 20;
constexpr float LAST = 16777215.0f / 16777216.0f;

std::vector<float> uniform_floats(unsigned seed, std::size_t count = SAMPLES)
{
    std::mt19937 engine(seed);
    std::vector<float> values(count);
    for (float& value : values) value = static_cast<float>(engine() >> 8) * 0x1p-24f;
    return values;
}

// A warp, two coordinates that are independent and uniform over [0, 1] if its density is right (its cumulative
// distribution functions), and the domain it must stay in. The first coordinate is u, the second v or 1 - v.
struct Warp {
    std::uint32_t number; // in the kernel
    std::string name;
    std::function<double(const Vec3&)> first, second;
    std::function<bool(const Vec3&)> contains;
    bool falling = false; // the second coordinate is 1 - v
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
    {0, "cosine_hemisphere", turns, [](const Vec3& w) { return w.z * w.z; },
     [](const Vec3& w) { return is_unit(w) && w.z > 0.0; }, true},
    {1, "uniform_hemisphere", turns, [](const Vec3& w) { return w.z; },
     [](const Vec3& w) { return is_unit(w) && w.z > 0.0; }, true},
    {2, "uniform_sphere", turns, [](const Vec3& w) { return 0.5 * (w.z + 1.0); }, is_unit, true},
    // The sine tells the angle that the cosine of a small cone has lost.
    {3, "uniform_cone", turns,
     [](const Vec3& w) {
         const double sine_squared = radius_squared(w);
         return sine_squared / (1.0 + std::sqrt(1.0 - sine_squared)) / double{ONE_MINUS_COS};
     },
     [](const Vec3& w) { return is_unit(w) && w.z >= 1.0 - double{ONE_MINUS_COS} - 1e-7; }},
    {4, "triangle", [](const Vec3& w) { return (w.x + w.y) * (w.x + w.y); },
     [](const Vec3& w) { return w.x + w.y > 0.0 ? w.y / (w.x + w.y) : 0.0; },
     [](const Vec3& w) { return w.x >= 0.0 && w.y >= 0.0 && w.x + w.y <= 1.0 + 1e-7; }},
    {5, "disk", turns, radius_squared, [](const Vec3& w) { return radius_squared(w) <= 1.0 + 4e-7; }},
    {6, "tent", [](const Vec3& w) { return tent_cdf(w.x); }, [](const Vec3& w) { return tent_cdf(w.y); },
     [](const Vec3& w) { return std::fabs(w.x) <= 1.0 && std::fabs(w.y) <= 1.0; }},
    {7, "gaussian", turns, [](const Vec3& w) { return std::expm1(-0.5 * radius_squared(w)) / std::expm1(-2.0); },
     [](const Vec3& w) { return std::sqrt(radius_squared(w)) <= GAUSSIAN_RADIUS * (1.0 + 4e-7); }},
};

std::vector<DeviceArgument> arguments(const Warp& warp, const std::vector<float>& u, const std::vector<float>& v)
{
    return {std::vector<std::uint32_t>{warp.number}, std::vector<float>{ONE_MINUS_COS, GAUSSIAN_RADIUS, GAUSSIAN_MASS},
            u, v};
}

std::vector<Vec3> points_of(const DeviceResults& out)
{
    const auto x = out.get<float>(0), y = out.get<float>(1), z = out.get<float>(2);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < x.size(); ++i) points.emplace_back(x[i], y[i], z[i]);
    return points;
}

std::vector<Vec3> sample(const Device& device, const Warp& warp, const std::vector<float>& u,
                         const std::vector<float>& v)
{
    return points_of(functions.evaluate(device, "warp", arguments(warp, u, v)));
}

// What inversion loses: a few roundings of u and v, for angles and radii alike.
constexpr double INVERSION_ERROR = 8 * 0x1p-24;

// Distance between two numbers of turns: 0 and 1 are the same direction.
double turn_error(double a, double b)
{
    const double difference = std::abs(a - b);
    return std::min(difference, 1.0 - difference);
}
} // namespace

TEST_CASE("every warp stays finite and in its domain, at the corners of the unit square too")
{
    std::vector<float> u = uniform_floats(1, 1 << 16), v = uniform_floats(2, 1 << 16);
    for (const float a : {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, LAST})
        for (const float b : {0.0f, 0x1p-24f, 0.5f, LAST}) {
            u.push_back(a), v.push_back(b);
            u.push_back(b), v.push_back(a);
        }
    for (Device& device : test_devices())
        for (const Warp& warp : WARPS) {
            const auto points = sample(device, warp, u, v);
            INFO(warp.name);
            CHECK(std::all_of(points.begin(), points.end(), warp.contains));
        }
}

TEST_CASE("every warp is inverted in double precision to the numbers it was made from, at every number of lanes")
{
    // Inversion ignores what the ends of the unit square make of a warp: a point at the pole has no angle.
    std::vector<float> u = uniform_floats(7, 1 << 16), v = uniform_floats(8, 1 << 16);
    for (float& x : v) x = std::max(x, 0x1p-24f);
    for (Device& device : test_devices())
        for (const Warp& warp : WARPS) {
            const auto points = points_of(evaluate_in_all_lanes(functions, device, "warp", arguments(warp, u, v)));
            double worst_first = 0.0, worst_second = 0.0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const double second = warp.falling ? 1.0 - warp.second(points[i]) : warp.second(points[i]);
                const bool no_second = warp.name == "triangle" && u[i] == 0.0f; // a vertex
                worst_first = std::max(worst_first, turn_error(warp.first(points[i]), u[i]));
                if (!no_second) worst_second = std::max(worst_second, std::abs(second - v[i]));
            }
            CAPTURE(warp.name, worst_first * 0x1p24, worst_second * 0x1p24);
            CHECK(worst_first <= INVERSION_ERROR);
            CHECK(worst_second <= INVERSION_ERROR);
        }
}

TEST_CASE("every warp has the distribution of its density")
{
    const std::vector<float> u = uniform_floats(3), v = uniform_floats(4);
    for (Device& device : test_devices())
        for (const Warp& warp : WARPS) {
            Histogram histogram(16, 16);
            for (const Vec3& w : sample(device, warp, u, v))
                histogram.add(std::min(warp.first(w), 1.0), std::min(warp.second(w), 1.0));
            check_histogram(warp.name, histogram, std::vector<double>(256, 1.0 / 256));
        }
}

TEST_CASE("densities are those of the closed forms, zero below the hemisphere")
{
    const double pi = std::numbers::pi;
    const std::vector<float> z{1.0f, 0.5f, 1e-6f, 0.0f, -0.5f, -1.0f};
    for (Device& device : test_devices()) {
        const DeviceResults out =
            evaluate_in_all_lanes(functions, device, "densities", {std::vector<float>{ONE_MINUS_COS}, z});
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
    const std::vector<float> u = uniform_floats(5, 1 << 17), v = uniform_floats(6, 1 << 17);
    // By the number of the warp; the cone is left out.
    const std::map<std::uint32_t, Vec3> means{
        {0, {0, 0, 2.0 / 3.0}}, {1, {0, 0, 0.5}}, {2, {0, 0, 0}}, {4, {1.0 / 3.0, 1.0 / 3.0, 0}},
        {5, {0, 0, 0}},         {6, {0, 0, 0}},   {7, {0, 0, 0}}};
    for (Device& device : test_devices())
        for (const auto& [number, mean] : means) {
            const Warp& warp = WARPS[number];
            RunningStatistics axes[3];
            for (const Vec3& w : sample(device, warp, u, v))
                for (int k = 0; k < 3; ++k) axes[k].add(w[k]);
            INFO(warp.name);
            for (int k = 0; k < 3; ++k) CHECK(std::fabs(axes[k].mean() - mean[k]) <= 5.0 * axes[k].standard_error());
        }
}
