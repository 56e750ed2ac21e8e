// Exact and almost exact arithmetic against double precision, and numbers that are none.
#include "support/device_lanes.h"

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

using namespace etendue;

namespace
{
const DeviceFunctions
    functions({"math/numerics.h"},
              {
                  {"products", "float float float float -> float float float",
                   "out0 = difference_of_products(in0, in1, in2, in3);"
                   "out1 = two_sum(in0, in1, &out2);"},
                  {"choices", "float float -> float float float float float mask float",
                   "out0 = min_of(in0, in1); out1 = max_of(in0, in1); out2 = abs_of(in0); out3 = copy_sign(in0, in1);"
                   "out4 = sqrt_of(in0); out5 = is_finite(in0); out6 = square(in0);"},
                  {"constants", "float -> float float float float float float float",
                   "out0 = in0 * UNIT_ROUNDOFF; out1 = in0 * TRIANGLE_POINT_ERROR; out2 = in0 * CURVED_POINT_ERROR;"
                   "out3 = in0 * SLAB_FAR_FACTOR; out4 = in0 * RAY_BOX_PADDING; out5 = in0 * MIN_SURVIVAL;"
                   "out6 = (Float)(INFINITE);"},
              });

using Words = std::vector<std::uint32_t>;

constexpr float INF = std::numeric_limits<float>::infinity();
constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();

double ulp(double x)
{
    return std::ldexp(1.0, std::ilogb(std::max(std::abs(x), 0x1p-126)) - 23);
}
} // namespace

TEST_CASE("a difference of products has the right sign and an error below 1.5 ulp, also when it almost vanishes")
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> u(-1, 1);
    std::vector<float> a, b, c, d;
    const auto add = [&](float p, float q, float r, float s) {
        a.push_back(p), b.push_back(q), c.push_back(r), d.push_back(s);
    };
    for (int i = 0; i < 1 << 16; ++i) {
        const float p = u(random), q = u(random), r = u(random);
        add(p, q, r, u(random));
        add(p, q, q, p); // exactly zero
        // a b / c, and its neighbours: what is left is of the size of the rounding of the products.
        const float s = p * q / r;
        add(p, q, r, s);
        add(p, q, r, std::nextafter(s, INF));
        // Products of neighbours: p (p + 2 ulp) against (p + ulp)^2.
        const float next = std::nextafter(p, INF);
        add(p, std::nextafter(next, INF), next, next);
    }
    for (Device& device : test_devices()) {
        const auto result = evaluate_in_all_lanes(functions, device, "products", {a, b, c, d}).get<float>(0);
        std::size_t wrong_signs = 0;
        double worst = 0.0;
        for (std::size_t i = 0; i < result.size(); ++i) {
            // Products of two floats are exact in double.
            const double exact = double{a[i]} * b[i] - double{c[i]} * d[i];
            wrong_signs += (result[i] > 0.0f) != (exact > 0.0) || (result[i] < 0.0f) != (exact < 0.0);
            worst = std::max(worst, std::abs(result[i] - exact) / ulp(exact));
        }
        CHECK(wrong_signs == 0);
        CHECK(worst <= 1.5);
    }
}

TEST_CASE("a sum and its error are together exact")
{
    std::mt19937 random(2);
    std::uniform_real_distribution<float> u(-1, 1);
    std::vector<float> a, b;
    for (int i = 0; i < 1 << 16; ++i) {
        a.push_back(std::ldexp(u(random), static_cast<int>(random() % 24)));
        b.push_back(i % 5 ? std::ldexp(u(random), static_cast<int>(random() % 24)) : -a.back() * (1 + 0x1p-20f));
    }
    for (Device& device : test_devices()) {
        const DeviceResults out = evaluate_in_all_lanes(functions, device, "products", {a, b, a, b});
        const auto sum = out.get<float>(1), error = out.get<float>(2);
        std::size_t wrong = 0, rounded = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            wrong += sum[i] != a[i] + b[i] || double{sum[i]} + error[i] != double{a[i]} + b[i];
            rounded += error[i] != 0.0f;
        }
        CHECK(wrong == 0);
        CHECK(rounded > a.size() / 2);
    }
}

TEST_CASE("numbers that are not finite are known by their bits")
{
    const float largest = std::numeric_limits<float>::max(), denormal = 1e-44f;
    const float signalling = std::bit_cast<float>(0x7f800001u), negative_nan = std::bit_cast<float>(0xffffffffu);
    const std::vector<float> x{0.0f, -0.0f, denormal,     largest,    -largest,
                               INF,  -INF,  NOT_A_NUMBER, signalling, negative_nan};
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(functions.evaluate(device, "choices", {x, x}, lanes).get<std::uint32_t>(5) ==
                  std::vector<std::uint32_t>{1, 1, 1, 1, 1, 0, 0, 0, 0, 0});
}

TEST_CASE("signs and magnitudes are taken from the bits, those of infinities and of no number too")
{
    const Words a{0x7fc00000u, 0xffc00001u, 0x7f800000u, 0xff800000u, 0x00000000u, 0x80000000u, 0x3f800000u};
    const Words sign{0xffc00000u, 0x3f800000u, 0x80000000u, 0x7fc00000u, 0xff800000u, 0x00000001u, 0x80000001u};
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const auto out = functions.evaluate(device, "choices", {a, sign}, lanes).outputs;
            for (std::size_t i = 0; i < a.size(); ++i) {
                CHECK(out[2][i] == (a[i] & 0x7fffffffu));
                CHECK(out[3][i] == ((a[i] & 0x7fffffffu) | (sign[i] & 0x80000000u)));
            }
        }
}

TEST_CASE("least and greatest, magnitude, sign and root agree with the language of the host")
{
    std::vector<float> a, b;
    for (const float x : {0.0f, -0.0f, 1.5f, -1.5f, 1e-42f, -1e-42f, 3e38f, 0.1f, INF})
        for (const float y : {0.0f, -0.0f, 1.5f, -2.5f, 1e-42f, -3e38f, INF, -INF}) {
            a.push_back(x);
            b.push_back(y);
        }
    for (Device& device : test_devices()) {
        const DeviceResults out = evaluate_in_all_lanes(functions, device, "choices", {a, b});
        for (std::size_t i = 0; i < a.size(); ++i) {
            CAPTURE(a[i], b[i]);
            CHECK(out.get<float>(0)[i] == std::min(a[i], b[i]));
            CHECK(out.get<float>(1)[i] == std::max(a[i], b[i]));
            CHECK(out.outputs[2][i] == std::bit_cast<std::uint32_t>(std::abs(a[i])));
            CHECK(out.outputs[3][i] == std::bit_cast<std::uint32_t>(std::copysign(a[i], b[i])));
            CHECK(out.get<float>(4)[i] == Approx(std::sqrt(std::max(a[i], 0.0f))).epsilon(2e-7));
            CHECK(out.get<float>(6)[i] == a[i] * a[i]);
        }
    }
}

TEST_CASE("of a number and no number, the least and the greatest are the second")
{
    const std::vector<float> a{NOT_A_NUMBER, 2.0f}, b{3.0f, NOT_A_NUMBER};
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceResults out = functions.evaluate(device, "choices", {a, b}, lanes);
            for (const std::size_t which : {0u, 1u}) {
                CHECK(out.get<float>(which)[0] == 3.0f);
                CHECK(std::isnan(out.get<float>(which)[1]));
            }
        }
}

TEST_CASE("tolerances are what their derivations say")
{
    const double u = 0x1p-24;
    const auto gamma = [u](int n) { return n * u / (1 - n * u); };
    const double expected[] = {u, gamma(7), gamma(12), 1 + 2 * gamma(3), gamma(12), 1.0 / 64};
    for (Device& device : test_devices()) {
        const DeviceResults out = evaluate_in_all_lanes(functions, device, "constants", {std::vector<float>{1.0f}});
        for (std::size_t i = 0; i < std::size(expected); ++i) {
            CAPTURE(i);
            CHECK(std::abs(out.get<float>(i)[0] - expected[i]) <= ulp(expected[i]));
        }
        // The slab's factor must be more than 1 after its own rounding.
        CHECK(out.get<float>(3)[0] > 1.0f);
        CHECK(out.get<float>(6)[0] == INF);
    }
}
