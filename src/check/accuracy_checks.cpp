// Largest errors of OpenCL's operations and of our own elementary functions against double precision.
#include "check/device_checks.h"
#include "check/device_functions.h"
#include "check/findings.h"
#include "math/rounding.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include <fmt/format.h>

namespace etendue
{
namespace
{
using Results = std::vector<CheckResult>;

// Half an ulp is what correct rounding leaves; the reference itself is rounded to double precision.
constexpr double CORRECTLY_ROUNDED = 0.5 + 1e-6;
// OpenCL 1.2, table 7.2, where a device does not promise correct rounding.
constexpr double DIVISION_LIMIT = 2.5, ROOT_LIMIT = 3.0;

const DeviceFunctions& functions()
{
    static const DeviceFunctions all(
        {"math/elementary.h"},
        {{"operations", "float float float -> float float float float float float",
          "out0 = in0 + in1; out1 = in0 - in1; out2 = in0 * in1; out3 = in0 / in1; out4 = sqrt(in0);"
          "out5 = fma(in0, in1, in2);"},
         {"turn", "float -> float float", "Float s, c; sin_cos_two_pi(in0, &s, &c); out0 = s; out1 = c;"},
         {"log", "float -> float", "log_of(in0)"}});
    return all;
}

// In units of the last place of the exact result.
double ulps(float found, double exact)
{
    const double infinity = std::numeric_limits<double>::infinity();
    if (std::isnan(exact)) return std::isnan(found) ? 0.0 : infinity;
    const auto rounded = static_cast<float>(exact);
    if (std::isinf(rounded)) return found == rounded ? 0.0 : infinity;
    const int exponent = exact == 0.0 ? -126 : std::max(std::ilogb(exact), -126);
    return std::abs(found - exact) / std::ldexp(1.0, exponent - 23);
}

struct Operands {
    std::vector<float> a, b, c;
};

// Numbers of any bits, numbers of like size, and all pairs of special ones.
Operands operands(const CheckContext& context)
{
    std::mt19937_64 random(context.seed + 1);
    std::uniform_real_distribution<float> near_one(0.5f, 2.0f);
    const auto any = [&] {
        const auto bits = static_cast<std::uint32_t>(random());
        float value;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    };
    Operands o;
    const auto add = [&](float a, float b, float c) {
        o.a.push_back(a);
        o.b.push_back(b);
        o.c.push_back(c);
    };
    const auto count = static_cast<std::size_t>((1 << 17) * context.effort);
    for (std::size_t i = 0; i < count; ++i) {
        add(any(), any(), any());
        const float a = near_one(random), b = near_one(random);
        add(a, b, i % 2 ? -a * b : near_one(random));
    }
    const float infinity = std::numeric_limits<float>::infinity(), largest = std::numeric_limits<float>::max();
    const float specials[] = {0.0f,     -0.0f,     1.0f,     -1.0f,        3.0f,        0x1p-149f, -0x1p-149f,
                              1e-40f,   0x1p-126f, 0x1p-75f, 0x1p75f,      0x1p127f,    largest,   -largest,
                              infinity, -infinity, NAN,      1 + 0x1p-23f, 1 - 0x1p-24f};
    for (const float a : specials)
        for (const float b : specials)
            for (const float c : {0.0f, 1.0f, -largest, 0x1p-149f}) add(a, b, c);
    return o;
}

Results check_operations(const CheckContext& context)
{
    const Operands o = operands(context);
    const DeviceResults out = functions().evaluate(*context.device, "operations", {o.a, o.b, o.c}, context.lanes);
    const bool promised = context.device->info().correctly_rounded_divide;
    struct Operation {
        const char* name;
        double limit;
        std::function<double(double, double, double)> exact;
    };
    const Operation all[] = {
        {"add", CORRECTLY_ROUNDED, [](double a, double b, double) { return a + b; }},
        {"subtract", CORRECTLY_ROUNDED, [](double a, double b, double) { return a - b; }},
        {"multiply", CORRECTLY_ROUNDED, [](double a, double b, double) { return a * b; }},
        {"divide", promised ? CORRECTLY_ROUNDED : DIVISION_LIMIT, [](double a, double b, double) { return a / b; }},
        {"sqrt", promised ? CORRECTLY_ROUNDED : ROOT_LIMIT, [](double a, double, double) { return std::sqrt(a); }},
        {"fma", CORRECTLY_ROUNDED, [](double a, double b, double c) { return std::fma(a, b, c); }},
    };
    Results results;
    for (std::size_t k = 0; k < std::size(all); ++k) {
        const std::vector<float> found = out.get<float>(k);
        WorstError error;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double e = ulps(found[i], all[k].exact(o.a[i], o.b[i], o.c[i]));
            if (e > error.worst()) error.set_subject(fmt::format("{:a}, {:a}, {:a}", o.a[i], o.b[i], o.c[i]));
            error.add(e);
        }
        results.push_back(error.result(std::string("device-operations-") + all[k].name, all[k].limit, "ulp"));
    }
    return results;
}

// Sine and cosine of 2 pi t over their whole range, densely around every eighth of a turn.
Results check_turns(const CheckContext& context)
{
    std::vector<float> t;
    for (int i = -(1 << 17); i <= 1 << 17; ++i) t.push_back(static_cast<float>(std::ldexp(i, -16)));
    std::mt19937_64 random(context.seed + 2);
    std::uniform_real_distribution<float> u(0, 1);
    for (int i = 0; i < 1 << 17; ++i) t.push_back(u(random));
    for (int i = 0; i < 1 << 12; ++i) t.push_back(std::ldexp(u(random), -static_cast<int>(random() % 126)));
    for (int eighth = -16; eighth <= 16; ++eighth) {
        float below = static_cast<float>(eighth) / 8.0f, above = below;
        for (int step = 0; step < 64; ++step) {
            t.push_back(below = std::max(std::nextafter(below, -3.0f), -2.0f));
            t.push_back(above = std::min(std::nextafter(above, 3.0f), 2.0f));
        }
    }
    const DeviceResults out = functions().evaluate(*context.device, "turn", {t}, context.lanes);
    const auto sine = out.get<float>(0), cosine = out.get<float>(1);
    WorstError error;
    for (std::size_t i = 0; i < t.size(); ++i) {
        const double angle = 2 * std::numbers::pi * t[i];
        error.add(std::max(std::abs(sine[i] - std::sin(angle)), std::abs(cosine[i] - std::cos(angle))) /
                  FLOAT_ROUNDING);
    }
    return {error.result("device-sin-cos", 2, "u")};
}

// Logarithms of numbers of every size, and of what sampling asks for: 1 - k 2^-24.
Results check_logarithm(const CheckContext& context)
{
    std::vector<float> x{1.0f, std::numeric_limits<float>::min(), std::numeric_limits<float>::max()};
    std::mt19937_64 random(context.seed + 3);
    std::uniform_real_distribution<float> u(1, 2);
    for (int e = -126; e <= 127; ++e)
        for (int i = 0; i < 512; ++i) x.push_back(std::ldexp(u(random), e));
    for (int k = 0; k < 1 << 18; ++k) x.push_back(1.0f - std::ldexp(static_cast<float>(1 + 64 * k), -24));
    const auto found = functions().evaluate<float>(*context.device, "log", {x}, context.lanes);
    WorstError relative, near_one;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double exact = std::log(double{x[i]}), error = std::abs(found[i] - exact) / FLOAT_ROUNDING;
        if (std::abs(exact) < 0.5)
            near_one.add(error);
        else
            relative.add(error / std::abs(exact));
    }
    return {relative.result("device-log", 2, "u"), near_one.result("device-log-near-1", 1, "u")};
}
} // namespace

std::vector<Check> accuracy_checks()
{
    return {make_check("device", "device-operations", check_operations),
            make_check("device", "device-sin-cos", check_turns), make_check("device", "device-log", check_logarithm)};
}
} // namespace etendue
