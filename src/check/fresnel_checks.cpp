// Fresnel's equations against extended precision, most of all around the critical angle.
#include "check/bsdf_checks.h"
#include "check/device_functions.h"
#include "check/findings.h"

#include <cmath>
#include <random>

#include <fmt/format.h>

namespace etendue
{
namespace
{
const DeviceFunctions& functions()
{
    static const DeviceFunctions all({"bsdf/fresnel.h"}, {{"fresnel", "float float -> float float",
                                                           "Float eta_cos_t;\n"
                                                           "out0 = fresnel_dielectric(in0, in1, &eta_cos_t);\n"
                                                           "out1 = eta_cos_t;\n"}});
    return all;
}

// From Snell's law, with the reflected amplitude of each polarisation (Born and Wolf, Principles of Optics, 1.5.2).
double reflectance(float cos_i, float eta)
{
    const long double c = cos_i, n = eta;
    const long double cos_t2 = ((n - 1) * (n + 1) + c * c) / (n * n);
    if (cos_t2 <= 0) return 1;
    const long double t = std::sqrt(cos_t2);
    const long double s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
    return static_cast<double>((s * s + p * p) / 2);
}

struct Pairs {
    std::vector<float> cos_i, eta;
};

struct Reflected {
    std::vector<float> r, eta_cos_t;
};

Reflected fresnel(const CheckContext& context, const Pairs& pairs)
{
    const DeviceResults results =
        functions().evaluate(*context.device, "fresnel", {pairs.cos_i, pairs.eta}, context.lanes);
    return {results.get<float>(0), results.get<float>(1)};
}

float steps_from(float x, int steps)
{
    for (; steps > 0; --steps) x = std::nextafter(x, 2.0f);
    for (; steps < 0; ++steps) x = std::nextafter(x, -1.0f);
    return x;
}

constexpr int STEPS = 64;

// 64 steps to both sides of the critical cosine sqrt(1 - eta^2), for a million pairs.
Pairs around_the_critical_angle(std::uint64_t seed)
{
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<float> u(0.2f, 0.9999f); // below, Brewster's angle comes as close
    Pairs pairs;
    for (int i = 0; i < 8128; ++i) {
        const float n = u(random);
        const float critical = static_cast<float>(std::sqrt(1 - double{n} * n));
        for (int step = -STEPS; step <= STEPS; ++step) {
            pairs.cos_i.push_back(steps_from(critical, step));
            pairs.eta.push_back(n);
        }
    }
    return pairs;
}

// Reflectances rise to 1 without a jump, and are 1 beyond.
std::vector<CheckResult> check_critical_angle(const CheckContext& context)
{
    const Pairs pairs = around_the_critical_angle(context.seed + 31);
    const Reflected found = fresnel(context, pairs);
    Violations violations;
    WorstError error;
    for (std::size_t i = 0; i < found.r.size(); ++i) {
        const float r = found.r[i];
        const double expected = reflectance(pairs.cos_i[i], pairs.eta[i]);
        error.add(std::abs(r - expected));
        if (!(r >= 0 && r <= 1) || (i % (2 * STEPS + 1) == 0))
            violations.set_subject(fmt::format("eta {}", pairs.eta[i]));
        violations.expect(r >= 0 && r <= 1, "out of [0, 1]");
        violations.expect(expected != 1 || (r == 1 && found.eta_cos_t[i] == 0), "not total");
        // Beyond the rounding of both polarisations.
        violations.expect(i % (2 * STEPS + 1) == 0 || r <= found.r[i - 1] + 0x1p-20f, "rising with the cosine");
    }
    return {violations.result("fresnel-critical-angle", Rule::bound),
            error.result("fresnel-critical-angle-error", 1e-4, "absolute")};
}

// At any angle and index, half of them close to grazing or close to equal indices; and at the ends of the range.
std::vector<CheckResult> check_everywhere(const CheckContext& context)
{
    std::mt19937_64 random(context.seed + 37);
    std::uniform_real_distribution<float> u(0, 1);
    Pairs pairs;
    for (int i = 0; i < 1 << 18; ++i) {
        const float x = u(random);
        pairs.cos_i.push_back(i % 2 ? x : x * x * x * x);
        pairs.eta.push_back(i % 4 < 2 ? std::pow(100.0f, 2 * u(random) - 1) : 1 + 1e-4f * (u(random) - 0.5f));
    }
    for (const float cosine : {0.0f, 1e-45f, 0x1p-126f, 0x1p-60f, 0x1p-24f, 1 - 0x1p-24f, 1.0f})
        for (const float eta : {1e-2f, 0.5f, 1 - 0x1p-24f, 1.0f, 1 + 0x1p-23f, 1.5f, 100.0f}) {
            pairs.cos_i.push_back(cosine);
            pairs.eta.push_back(eta);
        }
    const Reflected found = fresnel(context, pairs);
    Violations violations;
    WorstError error;
    for (std::size_t i = 0; i < found.r.size(); ++i) {
        violations.expect(found.r[i] >= 0 && found.r[i] <= 1 && std::isfinite(found.eta_cos_t[i]), "out of [0, 1]");
        // Along a boundary between equal indices, where the square of the cosine is no float: 0 or 1, as one likes.
        if (pairs.cos_i[i] < 0x1p-60f && pairs.eta[i] == 1) continue;
        error.add(std::abs(found.r[i] - reflectance(pairs.cos_i[i], pairs.eta[i])));
    }
    return {violations.result("fresnel-range", Rule::bound), error.result("fresnel-error", 1e-5, "absolute")};
}
} // namespace

std::vector<Check> fresnel_checks()
{
    return {make_check("bsdf", "fresnel-critical-angle", check_critical_angle),
            make_check("bsdf", "fresnel", check_everywhere)};
}
} // namespace etendue
