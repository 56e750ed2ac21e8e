// Elementary functions of the kernels against the host's in double precision.
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace etendue;

namespace
{
const DeviceFunctions functions({"math/elementary.h"},
                                {
                                    {"turn", "float -> float float", "sin_cos_two_pi(in0, &out0, &out1);"},
                                    {"logarithm", "float -> float", "log_of(in0)"},
                                });

constexpr double UNIT_ROUNDOFF = 0x1p-24;
} // namespace

TEST_CASE("sine and cosine of a turn are off by at most 2e-7 over two turns each way")
{
    std::vector<float> turns;
    for (int i = -(1 << 17); i <= (1 << 17); ++i) turns.push_back(static_cast<float>(i * 0x1p-16 + (i % 7) * 0x1p-20));
    for (float& turn : turns) turn = std::fmin(std::fmax(turn, -2.0f), 2.0f);
    for (Device& device : test_devices()) {
        const DeviceResults out = functions.evaluate(device, "turn", {turns});
        const auto sines = out.get<float>(0), cosines = out.get<float>(1);
        double error = 0.0;
        for (std::size_t i = 0; i < turns.size(); ++i) {
            const double angle = 2.0 * std::numbers::pi * turns[i];
            error = std::fmax(error, std::fabs(sines[i] - std::sin(angle)));
            error = std::fmax(error, std::fabs(cosines[i] - std::cos(angle)));
        }
        CHECK(error <= 2e-7);
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(functions.evaluate(device, "turn", {turns}, lanes).outputs == out.outputs);
    }
}

TEST_CASE("sine and cosine are exact at quarter turns")
{
    std::vector<float> turns, sines, cosines;
    const float quarter_sines[] = {0.0f, 1.0f, 0.0f, -1.0f};
    for (int quarter = -8; quarter <= 8; ++quarter) {
        turns.push_back(static_cast<float>(quarter) / 4.0f);
        sines.push_back(quarter_sines[quarter & 3]);
        cosines.push_back(quarter_sines[(quarter + 1) & 3]);
    }
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceResults out = functions.evaluate(device, "turn", {turns}, lanes);
            CHECK(out.get<float>(0) == sines);
            CHECK(out.get<float>(1) == cosines);
        }
}

TEST_CASE("the logarithm errs by at most 4 u relatively away from 1 and by u near it")
{
    std::vector<float> x;
    for (int i = 0; i < (1 << 16); ++i) {
        // All normal floats alike by exponent, then the neighbourhood of 1.
        x.push_back(static_cast<float>(std::exp2(-126.0 + 253.9 * i / 65536.0)));
        x.push_back(static_cast<float>(0.5 + 1.5 * i / 65536.0));
    }
    x.insert(x.end(), {0x1p-126f, 3.4028235e38f, 1.0f - 0x1p-24f, 1.0f + 0x1p-23f});
    for (Device& device : test_devices()) {
        const auto logarithms = functions.evaluate<float>(device, "logarithm", {x});
        double away = 0.0, near = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double exact = std::log(static_cast<double>(x[i]));
            const double error = std::fabs(logarithms[i] - exact);
            if (std::fabs(exact) < 0.25)
                near = std::fmax(near, error);
            else
                away = std::fmax(away, error / std::fabs(exact));
        }
        CHECK(away <= 4.0 * UNIT_ROUNDOFF);
        CHECK(near <= UNIT_ROUNDOFF);
        CHECK(functions.evaluate<float>(device, "logarithm", {std::vector<float>{1.0f}})[0] == 0.0f);
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(functions.evaluate<float>(device, "logarithm", {x}, lanes) == logarithms);
    }
}
