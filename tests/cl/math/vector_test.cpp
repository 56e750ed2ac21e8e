// Vectors in lanes against the host's in double precision.
#include "support/device_evaluate.h"

#include "math/vector.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace etendue;

namespace
{
// A function of the vectors a and b and the float s that gives a vector v.
DeviceFunction vector_function(const std::string& name, const std::string& expression)
{
    return {name, "float float float float float float float -> float float float",
            "Vec3 a = vec3(in0, in1, in2), b = vec3(in3, in4, in5); Float s = in6; Vec3 v = " + expression +
                "; out0 = v.x; out1 = v.y; out2 = v.z;"};
}

const DeviceFunctions functions(
    {"math/vector.h"},
    {
        vector_function("sum", "add3(a, b)"),
        vector_function("difference", "sub3(a, b)"),
        vector_function("product", "mul3(a, b)"),
        vector_function("scaled", "scale3(a, s)"),
        vector_function("negated", "negate3(a)"),
        vector_function("along", "fma3(b, s, a)"),
        vector_function("chosen", "choose3(s > 0.0f, a, b)"),
        vector_function("cross", "cross3(a, b)"),
        vector_function("absolute", "abs3(a)"),
        vector_function("unit", "normalize3(a)"),
        vector_function("scalars", "vec3(dot3(a, b), max_component(a), length3(a))"),
        vector_function("constants", "sub3(white(), add3(black(), broadcast3((real4)(1.0f, 2.0f, 3.0f, 4.0f))))"),
        {"finite", "float float float -> mask", "is_finite3(vec3(in0, in1, in2))"},
    });

constexpr double UNIT_ROUNDOFF = 0x1p-24;

struct Inputs {
    std::vector<float> values[7];

    Vec3 a(std::size_t i) const { return {values[0][i], values[1][i], values[2][i]}; }
    Vec3 b(std::size_t i) const { return {values[3][i], values[4][i], values[5][i]}; }
    double s(std::size_t i) const { return values[6][i]; }
    std::vector<DeviceArgument> arguments() const { return {std::begin(values), std::end(values)}; }
};

Inputs make_inputs()
{
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> uniform(-3.0f, 3.0f);
    Inputs inputs;
    for (auto& values : inputs.values)
        for (int i = 0; i < 1000; ++i) values.push_back(uniform(engine));
    return inputs;
}

// The largest error of a function over all axes.
template<typename Expected>
double error_of(const Device& device, const std::string& name, const Inputs& inputs, Expected expected)
{
    const DeviceResults out = functions.evaluate(device, name, inputs.arguments());
    const auto x = out.get<float>(0), y = out.get<float>(1), z = out.get<float>(2);
    double error = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec3 deviation = Vec3(x[i], y[i], z[i]) - expected(inputs.a(i), inputs.b(i), inputs.s(i));
        for (int k = 0; k < 3; ++k) error = std::fmax(error, std::fabs(deviation[k]));
    }
    return error;
}
} // namespace

TEST_CASE("operations on vectors agree with double precision axis by axis")
{
    const Inputs in = make_inputs();
    // Coordinates are below 3, so a sum is below 6, and a product below 9 with an error of half an ulp of [8, 16).
    const double sum_error = 4.0 * UNIT_ROUNDOFF, product_error = 8.0 * UNIT_ROUNDOFF;
    for (Device& device : test_devices()) {
        CHECK(error_of(device, "sum", in, [](Vec3 a, Vec3 b, double) { return a + b; }) <= sum_error);
        CHECK(error_of(device, "difference", in, [](Vec3 a, Vec3 b, double) { return a - b; }) <= sum_error);
        CHECK(error_of(device, "product", in, [](Vec3 a, Vec3 b, double) { return a * b; }) <= product_error);
        CHECK(error_of(device, "scaled", in, [](Vec3 a, Vec3, double s) { return a * s; }) <= product_error);
        // One rounding of a sum below 12.
        CHECK(error_of(device, "along", in, [](Vec3 a, Vec3 b, double s) { return a + b * s; }) <= product_error);
        CHECK(error_of(device, "negated", in, [](Vec3 a, Vec3, double) { return -a; }) == 0.0);
        CHECK(error_of(device, "absolute", in, [](Vec3 a, Vec3, double) { return glm::abs(a); }) == 0.0);
        CHECK(error_of(device, "chosen", in, [](Vec3 a, Vec3 b, double s) { return s > 0.0 ? a : b; }) == 0.0);
        CHECK(error_of(device, "constants", in, [](Vec3, Vec3, double) { return Vec3(0.0, -1.0, -2.0); }) == 0.0);
    }
}

TEST_CASE("products, lengths and directions of vectors agree with double precision")
{
    const Inputs in = make_inputs();
    for (Device& device : test_devices()) {
        CHECK(error_of(device, "cross", in, [](Vec3 a, Vec3 b, double) { return glm::cross(a, b); }) <=
              32.0 * UNIT_ROUNDOFF);
        CHECK(error_of(device, "unit", in, [](Vec3 a, Vec3, double) { return glm::normalize(a); }) <=
              5.0 * UNIT_ROUNDOFF);
        CHECK(error_of(device, "scalars", in, [](Vec3 a, Vec3 b, double) {
                  return Vec3(glm::dot(a, b), std::fmax(a.x, std::fmax(a.y, a.z)), glm::length(a));
              }) <= 40.0 * UNIT_ROUNDOFF);
    }
}

TEST_CASE("operations on vectors have the same bits at every number of lanes")
{
    const auto arguments = make_inputs().arguments();
    for (Device& device : test_devices())
        for (const std::string name : {"along", "cross", "unit", "scalars", "chosen"}) {
            const auto alone = functions.evaluate(device, name, arguments, 1).outputs;
            for (const std::uint32_t lanes : LANE_COUNTS) {
                INFO(name << " in " << lanes << " lanes");
                CHECK(functions.evaluate(device, name, arguments, lanes).outputs == alone);
            }
        }
}

TEST_CASE("a vector is finite when all its axes are")
{
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> x{1.0f, inf, 0.0f, 1.0f, nan}, y{-2.0f, 0.0f, nan, 1.0f, 1.0f}, z{3e38f, 0, 0, -inf, 1.0f};
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(functions.evaluate<std::uint32_t>(device, "finite", {x, y, z}, lanes) ==
                  std::vector<std::uint32_t>{1, 0, 0, 0, 0});
}
