// Frames around a normal: orthonormal for every normal, also close to both poles.
#include "support/device_lanes.h"

#include <catch2/catch.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>

using namespace etendue;

namespace
{
const DeviceFunctions
    functions({"math/frame.h"},
              {
                  {"frame", "float float float -> float float float float float float float float float",
                   "Frame f = make_frame(vec3(in0, in1, in2));"
                   "out0 = f.s.x; out1 = f.s.y; out2 = f.s.z; out3 = f.t.x; out4 = f.t.y; out5 = f.t.z;"
                   "out6 = f.n.x; out7 = f.n.y; out8 = f.n.z;"},
                  {"there_and_back", "float float float float float float -> float float float float float float float",
                   "Frame f = make_frame(vec3(in0, in1, in2)); Vec3 w = vec3(in3, in4, in5);"
                   "Vec3 l = to_local(f, w), back = to_world(f, l);"
                   "out0 = l.x; out1 = l.y; out2 = l.z; out3 = back.x; out4 = back.y; out5 = back.z;"
                   "out6 = dot3(w, f.n);"},
                  {"side", "float float -> mask",
                   "same_hemisphere(vec3((Float)(0.5), (Float)(0.5), in0), vec3((Float)(-0.5), (Float)(0.5), in1))"},
              });

constexpr double U = 0x1p-24;

struct Directions {
    std::vector<float> x, y, z;

    void add(double a, double b, double c)
    {
        const double length = std::sqrt(a * a + b * b + c * c);
        x.push_back(static_cast<float>(a / length));
        y.push_back(static_cast<float>(b / length));
        z.push_back(static_cast<float>(c / length));
    }
};

// Normals from everywhere, and many within 1e-3 of +z and -z, down to the poles themselves.
Directions normals(std::size_t count)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(0, 1);
    Directions n;
    for (const double pole : {1.0, -1.0}) {
        n.add(0.0, 0.0, pole);
        n.add(-0.0, 0.0, pole);
        n.add(1.0, 0.0, 0.0 * pole);
        n.add(0.6, -0.8, 0.0 * pole);
    }
    while (n.x.size() < count) {
        const double phi = 2 * std::numbers::pi * u(random), near = std::pow(10.0, -3.0 - 6.0 * u(random));
        n.add(near * std::cos(phi), near * std::sin(phi), n.x.size() % 2 ? 1.0 : -1.0);
        if (n.x.size() % 4 == 0) n.add(u(random) - 0.5, u(random) - 0.5, u(random) - 0.5);
    }
    return n;
}
} // namespace

TEST_CASE("frames are orthonormal and right-handed for normals everywhere and next to the poles")
{
    const Directions n = normals(1 << 20);
    for (Device& device : test_devices()) {
        const auto out = functions.evaluate(device, "frame", {n.x, n.y, n.z}).outputs;
        double worst_length = 0.0, worst_angle = 0.0, worst_hand = 0.0;
        std::size_t wrong_normals = 0;
        for (std::size_t i = 0; i < n.x.size(); ++i) {
            double f[3][3];
            for (std::size_t k = 0; k < 9; ++k) f[k / 3][k % 3] = std::bit_cast<float>(out[k][i]);
            const auto dot = [&](int a, int b) { return f[a][0] * f[b][0] + f[a][1] * f[b][1] + f[a][2] * f[b][2]; };
            worst_length =
                std::max({worst_length, std::abs(std::sqrt(dot(0, 0)) - 1.0), std::abs(std::sqrt(dot(1, 1)) - 1.0)});
            worst_angle = std::max({worst_angle, std::abs(dot(0, 1)), std::abs(dot(0, 2)), std::abs(dot(1, 2))});
            for (int k = 0; k < 3; ++k) {
                const int next = (k + 1) % 3, last = (k + 2) % 3;
                const double cross = f[0][next] * f[1][last] - f[0][last] * f[1][next];
                worst_hand = std::max(worst_hand, std::abs(cross - f[2][k]));
            }
            wrong_normals += out[6][i] != std::bit_cast<std::uint32_t>(n.x[i]) ||
                             out[7][i] != std::bit_cast<std::uint32_t>(n.y[i]) ||
                             out[8][i] != std::bit_cast<std::uint32_t>(n.z[i]);
        }
        CHECK(worst_length <= 4 * U);
        CHECK(worst_angle <= 4 * U);
        CHECK(worst_hand <= 8 * U);
        CHECK(wrong_normals == 0);
    }
}

TEST_CASE("a direction goes into the local frame and back, and its z is the cosine to the normal")
{
    const Directions n = normals(1 << 16);
    Directions w;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> u(-1, 1);
    while (w.x.size() < n.x.size()) w.add(u(random), u(random), u(random));
    for (Device& device : test_devices()) {
        const DeviceResults out =
            evaluate_in_all_lanes(functions, device, "there_and_back", {n.x, n.y, n.z, w.x, w.y, w.z});
        double worst = 0.0, worst_length = 0.0;
        const std::array world{out.get<float>(3), out.get<float>(4), out.get<float>(5)};
        const std::array local{out.get<float>(0), out.get<float>(1), out.get<float>(2)};
        for (std::size_t i = 0; i < w.x.size(); ++i) {
            worst = std::max({worst, std::abs(double{world[0][i]} - w.x[i]), std::abs(double{world[1][i]} - w.y[i]),
                              std::abs(double{world[2][i]} - w.z[i])});
            worst_length =
                std::max(worst_length, std::abs(std::hypot(double{local[0][i]}, local[1][i], local[2][i]) - 1));
        }
        CHECK(worst <= 16 * U);
        CHECK(worst_length <= 8 * U);
        CHECK(out.outputs[2] == out.outputs[6]);
    }
}

TEST_CASE("directions along the surface are on neither side of it")
{
    const std::vector<float> a{1.0f, -1.0f, 1.0f, 0.0f, -0.0f, 0.0f, 1e-44f, -1e-44f};
    const std::vector<float> b{0.5f, -0.5f, -1.0f, 1.0f, -1.0f, 0.0f, 1e-44f, 1e-44f};
    for (Device& device : test_devices())
        CHECK(evaluate_in_all_lanes(functions, device, "side", {a, b}).get<std::uint32_t>(0) ==
              std::vector<std::uint32_t>{1, 1, 0, 0, 0, 0, 1, 0});
}
