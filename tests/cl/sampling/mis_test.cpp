// The power heuristic against its formula in double, and where squares would overflow.
#include "support/device_lanes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace etendue;

namespace
{
const DeviceFunctions functions({"sampling/mis.h"},
                                {{"heuristic", "float float -> float float",
                                  "out0 = power_heuristic(in0, in1); out1 = power_heuristic(in1, in0);"},
                                 {"balance", "float float -> float float",
                                  "out0 = balance_heuristic(in0, in1); out1 = balance_heuristic(in1, in0);"}});
} // namespace

TEST_CASE("weights are those of the heuristics, and the two of a pair add up to 1")
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-4, 4);
    std::vector<float> a, b;
    for (int i = 0; i < 1 << 16; ++i) {
        a.push_back(static_cast<float>(std::pow(10.0, exponent(random))));
        b.push_back(i % 3 ? static_cast<float>(std::pow(10.0, exponent(random))) : a.back());
    }
    for (Device& device : test_devices())
        for (const double power : {1.0, 2.0}) {
            const char* const function = power == 2.0 ? "heuristic" : "balance";
            const DeviceResults out = evaluate_in_all_lanes(functions, device, function, {a, b});
            const auto of_a = out.get<float>(0), of_b = out.get<float>(1);
            double worst = 0.0, worst_sum = 0.0;
            for (std::size_t i = 0; i < a.size(); ++i) {
                const double p = std::pow(double{a[i]}, power), q = std::pow(double{b[i]}, power);
                worst = std::max(worst, std::abs(of_a[i] / (p / (p + q)) - 1.0));
                worst_sum = std::max(worst_sum, std::abs(double{of_a[i]} + of_b[i] - 1.0));
                if (a[i] == b[i]) CHECK(of_a[i] == 0.5f);
            }
            CHECK(worst <= 6 * 0x1p-24);
            CHECK(worst_sum <= 4 * 0x1p-24);
        }
}

TEST_CASE("densities whose squares are no floats have finite weights")
{
    const float largest = std::numeric_limits<float>::max(), infinity = std::numeric_limits<float>::infinity();
    const std::vector<float> a{1e20f, 1e20f, 1e-30f, 1e38f, largest, 3.0f, 1.0f, 0.0f};
    const std::vector<float> b{1e20f, 2e20f, 2e-30f, 1e-38f, 1.0f, 0.0f, infinity, 1e-20f};
    const std::vector<float> expected{0.5f, 0.2f, 0.2f, 1.0f, 1.0f, 1.0f, 0.0f, 0.0f};
    for (Device& device : test_devices()) {
        const DeviceResults out = evaluate_in_all_lanes(functions, device, "heuristic", {a, b});
        for (std::size_t i = 0; i < a.size(); ++i) {
            CAPTURE(a[i], b[i]);
            CHECK(out.get<float>(0)[i] == Approx(expected[i]).margin(1e-6));
            CHECK(out.get<float>(1)[i] == Approx(1.0 - expected[i]).margin(1e-6));
        }
    }
}
