// Elementary functions of our own against those of double precision.
#include "support/device_lanes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using namespace etendue;

namespace
{
const DeviceFunctions
    functions({"math/elementary.h"},
              {
                  {"turn", "float -> float float", "Float s, c; sin_cos_two_pi(in0, &s, &c); out0 = s; out1 = c;"},
                  {"log", "float -> float", "log_of(in0)"},
              });

constexpr double U = 0x1p-24;
} // namespace

TEST_CASE("sine and cosine of 2 pi t err by less than 2 u over their whole range")
{
    // Equally spaced numbers of [-2, 2], numbers of every size, and the neighbours of every eighth of a turn.
    std::vector<float> t;
    for (int i = -(1 << 17); i <= 1 << 17; ++i) t.push_back(static_cast<float>(std::ldexp(i, -16)));
    std::mt19937 random(1);
    std::uniform_real_distribution<float> u(0, 1);
    for (int i = 0; i < 1 << 18; ++i) t.push_back(u(random));
    for (int i = 0; i < 1 << 12; ++i) t.push_back(std::ldexp(u(random), -static_cast<int>(random() % 126)));
    for (int eighth = -16; eighth <= 16; ++eighth) {
        float below = static_cast<float>(eighth) / 8.0f, above = below;
        for (int step = 0; step < 64; ++step) {
            t.push_back(below = std::max(std::nextafter(below, -3.0f), -2.0f));
            t.push_back(above = std::min(std::nextafter(above, 3.0f), 2.0f));
        }
    }
    for (Device& device : test_devices()) {
        const DeviceResults out = evaluate_in_all_lanes(functions, device, "turn", {t});
        const auto sine = out.get<float>(0), cosine = out.get<float>(1);
        double worst = 0.0, worst_norm = 0.0;
        for (std::size_t i = 0; i < t.size(); ++i) {
            const double angle = 2 * std::numbers::pi * t[i];
            worst = std::max({worst, std::abs(sine[i] - std::sin(angle)), std::abs(cosine[i] - std::cos(angle))});
            worst_norm = std::max(worst_norm, std::abs(std::hypot(double{sine[i]}, double{cosine[i]}) - 1.0));
        }
        CAPTURE(worst / U, worst_norm / U);
        CHECK(worst <= 2 * U);
        CHECK(worst_norm <= 2 * U);
    }
}

TEST_CASE("quarters of a turn are exact, and small angles are right relatively")
{
    std::vector<float> quarters, small;
    for (int i = -8; i <= 8; ++i) quarters.push_back(static_cast<float>(i) / 4.0f);
    for (int e = -120; e <= -4; ++e) small.push_back(std::ldexp(1.3f, e));
    for (Device& device : test_devices()) {
        DeviceResults out = evaluate_in_all_lanes(functions, device, "turn", {quarters});
        for (std::size_t i = 0; i < quarters.size(); ++i) {
            const float sines[] = {0, 1, 0, -1};
            CHECK(out.get<float>(0)[i] == sines[i % 4]);
            CHECK(out.get<float>(1)[i] == sines[(i + 1) % 4]);
        }
        out = evaluate_in_all_lanes(functions, device, "turn", {small});
        for (std::size_t i = 0; i < small.size(); ++i) {
            const double exact = std::sin(2 * std::numbers::pi * small[i]);
            CHECK(std::abs(out.get<float>(0)[i] / exact - 1.0) <= 4 * U);
        }
    }
}

TEST_CASE("the logarithm errs by less than 2 u relatively, and less than u absolutely next to 1")
{
    std::vector<float> x{1.0f, std::numeric_limits<float>::min(), std::numeric_limits<float>::max()};
    std::mt19937 random(2);
    std::uniform_real_distribution<float> u(1, 2);
    for (int e = -126; e <= 127; ++e)
        for (int i = 0; i < 512; ++i) x.push_back(std::ldexp(u(random), e));
    // What sampling asks for: 1 - k 2^-24.
    for (int k = 0; k < 1 << 18; ++k) x.push_back(1.0f - std::ldexp(static_cast<float>(1 + 64 * k), -24));
    for (int k = 1; k < 4096; ++k) {
        x.push_back(1.0f - std::ldexp(static_cast<float>(k), -24));
        x.push_back(1.0f + std::ldexp(static_cast<float>(k), -23));
    }
    for (Device& device : test_devices()) {
        const auto result = evaluate_in_all_lanes(functions, device, "log", {x}).get<float>(0);
        double worst_relative = 0.0, worst_near_one = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double exact = std::log(double{x[i]}), error = std::abs(result[i] - exact);
            if (std::abs(exact) < 0.5)
                worst_near_one = std::max(worst_near_one, error);
            else
                worst_relative = std::max(worst_relative, error / std::abs(exact));
        }
        CAPTURE(worst_relative / U, worst_near_one / U);
        CHECK(worst_relative <= 2 * U);
        CHECK(worst_near_one <= U);
        CHECK(result[0] == 0.0f);
    }
}
