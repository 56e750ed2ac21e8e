// Vectors in lanes against double precision.
#include "support/device_lanes.h"

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

using namespace etendue;

namespace
{
const DeviceFunctions functions(
    {"math/vector.h"},
    {
        {"componentwise",
         "float float float float float float float -> float float float float float float float float",
         // Weigh the axes differently, so that none can stand in for another.
         "Vec3 a = vec3(in0, in1, in2), b = vec3(in3, in4, in5), k = vec3((Float)(1.0), (Float)(8.0), (Float)(64.0));"
         "Vec3 r[8]; r[0] = add3(a, b); r[1] = sub3(a, b); r[2] = mul3(a, b); r[3] = scale3(a, in6); r[4] = negate3(a);"
         "r[5] = fma3(b, in6, a); r[6] = choose3(in6 > 0.0, a, b); r[7] = abs3(a);"
         "Float sums[8]; for (int i = 0; i < 8; i++) sums[i] = r[i].x * k.x + r[i].y * k.y + r[i].z * k.z;"
         "out0 = sums[0]; out1 = sums[1]; out2 = sums[2]; out3 = sums[3]; out4 = sums[4]; out5 = sums[5];"
         "out6 = sums[6]; out7 = sums[7];"},
        {"products",
         "float float float float float float -> float float float float float float float float float mask",
         "Vec3 a = vec3(in0, in1, in2), b = vec3(in3, in4, in5), c = cross3(a, b), n = normalize3(a);"
         "out0 = dot3(a, b); out1 = c.x; out2 = c.y; out3 = c.z; out4 = length3(a); out5 = n.x; out6 = n.y;"
         "out7 = n.z; out8 = max_component(a); out9 = is_finite3(a);"},
        {"constants", "float -> float float float float float",
         "Vec3 b = broadcast3((real4)(1.0, 2.0, 3.0, 4.0)); Vec2 t = vec2(in0, in0 + 1.0);"
         "out0 = black().x + black().y + black().z; out1 = white().x * white().y * white().z;"
         "out2 = b.x + 10.0 * b.y + 100.0 * b.z; out3 = t.x; out4 = t.y;"},
    });

struct Vectors {
    std::vector<float> x[3];

    void add(double a, double b, double c)
    {
        x[0].push_back(static_cast<float>(a));
        x[1].push_back(static_cast<float>(b));
        x[2].push_back(static_cast<float>(c));
    }
    std::size_t size() const { return x[0].size(); }
};

Vectors random_vectors(unsigned seed, std::size_t count)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1, 1);
    Vectors v;
    while (v.size() < count) v.add(u(random), u(random), u(random));
    return v;
}

double dot(const Vectors& a, const Vectors& b, std::size_t i)
{
    return double{a.x[0][i]} * b.x[0][i] + double{a.x[1][i]} * b.x[1][i] + double{a.x[2][i]} * b.x[2][i];
}
} // namespace

TEST_CASE("sums, differences, products and choices go axis by axis")
{
    // Small integers: everything is exact.
    std::mt19937 random(3);
    Vectors a, b;
    std::vector<float> s;
    for (int i = 0; i < 256; ++i) {
        const auto integer = [&] { return static_cast<double>(random() % 15) - 7.0; };
        a.add(integer(), integer(), integer());
        b.add(integer(), integer(), integer());
        s.push_back(static_cast<float>(integer()));
    }
    for (Device& device : test_devices()) {
        const DeviceResults out = evaluate_in_all_lanes(functions, device, "componentwise",
                                                        {a.x[0], a.x[1], a.x[2], b.x[0], b.x[1], b.x[2], s});
        for (std::size_t i = 0; i < s.size(); ++i) {
            float expected[8] = {};
            const float weights[3] = {1.0f, 8.0f, 64.0f};
            for (int axis = 0; axis < 3; ++axis) {
                const float p = a.x[axis][i], q = b.x[axis][i];
                const float values[8] = {p + q,      p - q, p * q, p * s[i], -p, q * s[i] + p, s[i] > 0 ? p : q,
                                         std::abs(p)};
                for (int k = 0; k < 8; ++k) expected[k] += weights[axis] * values[k];
            }
            for (std::size_t k = 0; k < 8; ++k) {
                CAPTURE(i, k);
                CHECK(out.get<float>(k)[i] == expected[k]);
            }
        }
    }
}

TEST_CASE("dot products and lengths err by roundings of their terms")
{
    const Vectors a = random_vectors(4, 1 << 16), b = random_vectors(5, 1 << 16);
    for (Device& device : test_devices()) {
        const DeviceResults out =
            evaluate_in_all_lanes(functions, device, "products", {a.x[0], a.x[1], a.x[2], b.x[0], b.x[1], b.x[2]});
        const auto dots = out.get<float>(0), lengths = out.get<float>(4), largest = out.get<float>(8);
        double worst_dot = 0.0, worst_length = 0.0;
        std::size_t wrong_largest = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            double size = 0.0;
            for (int axis = 0; axis < 3; ++axis) size += std::abs(double{a.x[axis][i]} * b.x[axis][i]);
            worst_dot = std::max(worst_dot, std::abs(dots[i] - dot(a, b, i)) / size);
            const double length = std::sqrt(dot(a, a, i));
            worst_length = std::max(worst_length, std::abs(lengths[i] / length - 1.0));
            wrong_largest += largest[i] != std::max({a.x[0][i], a.x[1][i], a.x[2][i]});
        }
        CHECK(worst_dot <= 3 * 0x1p-24);
        CHECK(worst_length <= 4 * 0x1p-24);
        CHECK(wrong_largest == 0);
    }
}

TEST_CASE("each component of a cross product is right to 1.5 ulp, also for vectors that are almost parallel")
{
    const Vectors a = random_vectors(6, 1 << 16);
    Vectors b = random_vectors(7, 1 << 15);
    for (std::size_t i = b.size(); i < a.size(); ++i)
        b.add(a.x[0][i] * 1.7, a.x[1][i] * 1.7 * (1 + 1e-7), a.x[2][i] * 1.7 * (1 - 1e-7));
    for (Device& device : test_devices()) {
        const DeviceResults out =
            evaluate_in_all_lanes(functions, device, "products", {a.x[0], a.x[1], a.x[2], b.x[0], b.x[1], b.x[2]});
        double worst = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto c = out.get<float>(1 + axis);
            const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
            for (std::size_t i = 0; i < a.size(); ++i) {
                const double exact = double{a.x[next][i]} * b.x[last][i] - double{a.x[last][i]} * b.x[next][i];
                const double ulp = std::ldexp(1.0, std::ilogb(std::max(std::abs(exact), 0x1p-126)) - 23);
                worst = std::max(worst, std::abs(c[i] - exact) / ulp);
            }
        }
        CHECK(worst <= 1.5);
    }
}

TEST_CASE("normalised vectors keep their direction and have length 1 to 4 roundings")
{
    Vectors a = random_vectors(8, 1 << 16);
    for (const double size : {1e-17, 1e-6, 1.0, 1e6, 1e17})
        for (int axis = 0; axis < 3; ++axis)
            a.add(axis == 0 ? -size : 0.0, axis == 1 ? size : 0.0, axis == 2 ? size : 0.0);
    for (Device& device : test_devices()) {
        const DeviceResults out =
            evaluate_in_all_lanes(functions, device, "products", {a.x[0], a.x[1], a.x[2], a.x[0], a.x[1], a.x[2]});
        double worst_length = 0.0, worst_component = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double length = std::sqrt(dot(a, a, i));
            double squares = 0.0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double n = std::bit_cast<float>(out.outputs[5 + axis][i]);
                squares += n * n;
                worst_component = std::max(worst_component, std::abs(n - a.x[axis][i] / length));
            }
            worst_length = std::max(worst_length, std::abs(std::sqrt(squares) - 1.0));
        }
        CHECK(worst_length <= 4 * 0x1p-24);
        CHECK(worst_component <= 4 * 0x1p-24);
    }
}

TEST_CASE("a vector is finite when all of its axes are")
{
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> x{1, inf, 1, 1, nan, 1, 1}, y{1, 1, -inf, 1, 1, nan, 1}, z{1, 1, 1, inf, 1, 1, nan};
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(functions.evaluate(device, "products", {x, y, z, x, y, z}, lanes).get<std::uint32_t>(9) ==
                  std::vector<std::uint32_t>{1, 0, 0, 0, 0, 0, 0});
}

TEST_CASE("constant vectors are the same in every lane")
{
    const std::vector<float> x(17, 0.5f);
    for (Device& device : test_devices()) {
        const DeviceResults out = evaluate_in_all_lanes(functions, device, "constants", {x});
        const float expected[] = {0.0f, 1.0f, 321.0f, 0.5f, 1.5f};
        for (std::size_t k = 0; k < 5; ++k) CHECK(out.get<float>(k) == std::vector<float>(17, expected[k]));
    }
}
