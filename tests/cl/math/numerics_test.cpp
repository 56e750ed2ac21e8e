// Numerical building blocks of the kernels on special values, and their exactness against wider arithmetic.
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace etendue;

namespace
{
const DeviceFunctions functions({"math/numerics.h"},
                                {
                                    {"smaller", "float float -> float", "min_of(in0, in1)"},
                                    {"larger", "float float -> float", "max_of(in0, in1)"},
                                    {"signed_as", "float float -> float", "copy_sign(in0, in1)"},
                                    {"magnitude", "float -> float", "abs_of(in0)"},
                                    {"finite", "float -> mask", "is_finite(in0)"},
                                    {"difference", "float float float float -> float",
                                     "difference_of_products(in0, in1, in2, in3)"},
                                    {"sum", "float float -> float float", "out0 = two_sum(in0, in1, &out1);"},
                                });

constexpr float INF = std::numeric_limits<float>::infinity();
constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
const std::vector<float> SPECIAL{0.0f,     -0.0f, 1.0f, -1.5f,        3.4028235e38f, -3.4028235e38f,
                                 1.2e-38f, INF,   -INF, NOT_A_NUMBER, -NOT_A_NUMBER};

// Every pair of special values.
void make_pairs(std::vector<float>& a, std::vector<float>& b)
{
    for (const float x : SPECIAL)
        for (const float y : SPECIAL) {
            a.push_back(x);
            b.push_back(y);
        }
}

std::vector<float> random_floats(std::size_t count, unsigned seed, int exponents)
{
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> mantissa(-1.0f, 1.0f);
    std::uniform_int_distribution<int> exponent(-exponents, exponents);
    std::vector<float> values(count);
    for (float& value : values) value = std::ldexp(mantissa(engine), exponent(engine));
    return values;
}
} // namespace

TEST_CASE("minimum and maximum choose as their comparison does, special values included")
{
    std::vector<float> a, b;
    make_pairs(a, b);
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const auto least = functions.evaluate<float>(device, "smaller", {a, b}, lanes);
            const auto most = functions.evaluate<float>(device, "larger", {a, b}, lanes);
            for (std::size_t i = 0; i < a.size(); ++i) {
                INFO(a[i] << " and " << b[i] << " in " << lanes << " lanes");
                // A comparison with NaN is false, and then the second value is taken.
                if (std::isnan(b[i])) {
                    CHECK((std::isnan(least[i]) && std::isnan(most[i])));
                } else {
                    CHECK(least[i] == std::fmin(a[i], b[i]));
                    CHECK(most[i] == std::fmax(a[i], b[i]));
                }
            }
        }
}

TEST_CASE("signs and magnitudes are taken from the bits of zeros, infinities and NaN too")
{
    std::vector<float> a, b;
    make_pairs(a, b);
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const auto with_sign = functions.evaluate(device, "signed_as", {a, b}, lanes).outputs[0];
            const auto magnitudes = functions.evaluate(device, "magnitude", {a}, lanes).outputs[0];
            const auto finite = functions.evaluate<std::uint32_t>(device, "finite", {a}, lanes);
            for (std::size_t i = 0; i < a.size(); ++i) {
                INFO(a[i] << " and " << b[i] << " in " << lanes << " lanes");
                CHECK(with_sign[i] == DeviceArgument(std::vector<float>{std::copysign(a[i], b[i])}).words[0]);
                CHECK(magnitudes[i] == DeviceArgument(std::vector<float>{std::fabs(a[i])}).words[0]);
                CHECK(finite[i] == (std::isfinite(a[i]) ? 1u : 0u));
            }
        }
}

TEST_CASE("a difference of products has the right sign and an error below 2 ulp, however much cancels")
{
    std::vector<float> a = random_floats(1 << 14, 1, 10), b = random_floats(1 << 14, 2, 10), c = a, d = b;
    std::mt19937 engine(3);
    std::uniform_int_distribution<int> steps(-2, 2);
    for (std::size_t i = 0; i < c.size(); ++i) {
        // Move both factors by few ulp, so that nearly everything cancels.
        c[i] += static_cast<float>(steps(engine)) * (std::nextafter(c[i], INF) - c[i]);
        d[i] += static_cast<float>(steps(engine)) * (std::nextafter(d[i], INF) - d[i]);
    }
    for (Device& device : test_devices()) {
        const auto out = functions.evaluate<float>(device, "difference", {a, b, c, d});
        std::size_t wrong_signs = 0, inaccurate = 0;
        for (std::size_t i = 0; i < out.size(); ++i) {
            const long double exact =
                static_cast<long double>(a[i]) * b[i] - static_cast<long double>(c[i]) * d[i];
            const float rounded = std::fabs(static_cast<float>(exact));
            const long double ulp = std::nextafter(rounded, INF) - rounded;
            wrong_signs += (exact > 0) != (out[i] > 0.0f) || (exact < 0) != (out[i] < 0.0f);
            inaccurate += !(std::fabs(out[i] - exact) < 2 * ulp);
        }
        CHECK(wrong_signs == 0);
        CHECK(inaccurate == 0);
    }
}

TEST_CASE("a sum of two floats and its error are together exact")
{
    // Exponents within 2^-12 ... 2^12 keep the exact sum within the 64 bits of the reference.
    const std::vector<float> a = random_floats(1 << 14, 4, 12), b = random_floats(1 << 14, 5, 12);
    for (Device& device : test_devices()) {
        const DeviceResults out = functions.evaluate(device, "sum", {a, b});
        const auto sums = out.get<float>(0), errors = out.get<float>(1);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            wrong += sums[i] != a[i] + b[i] ||
                     static_cast<long double>(sums[i]) + errors[i] != static_cast<long double>(a[i]) + b[i];
        CHECK(wrong == 0);
    }
}
