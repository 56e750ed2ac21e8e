// Each check of area lights is one line over all their cases; the environment has its own.
#include "check/light_checks.h"

#include "check/findings.h"
#include "check/light_cases.h"
#include "check/random_words.h"
#include "math/rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr double PI = std::numbers::pi;
// Bins of two numbers that are uniform, and enough samples to see that they are out by 2 %: one light of each kind is
// looked at as finely as BSDFs are; across the smallest lights floats have few points.
struct Resolution {
    std::size_t columns, rows;
    double samples;
};
constexpr Resolution FINE{64, 128, 1 << 22}, PLAIN{16, 16, 1 << 19}, COARSE{8, 8, 330000};
// Of a sample's point, that its random numbers may be off by.
constexpr double INVERSION_ROUNDINGS = 8;
constexpr std::size_t BATCH = std::size_t{1} << 16; // what a cache holds

using Kind = LightCase::Kind;
using Results = std::vector<CheckResult>;

std::vector<Point> directions_of(const std::vector<DeviceLightSample>& samples)
{
    std::vector<Point> directions;
    for (const auto& s : samples) directions.push_back(s.to_light);
    return directions;
}

DeviceLights lights_of(const CheckContext& context, const LightCase& c, uint light_flags = 0)
{
    return DeviceLights(*context.device, light_of(c.primitive, light_flags, c.surface_flags), context.lanes, c.by_area);
}

bool is_tiniest(const LightCase& c)
{
    return c.name.find("1e-12") != std::string::npos; // floats have hundreds of points on it, no more
}

// The mean of one over the density of samples is the solid angle.
Results check_solid_angle(const CheckContext& context)
{
    WorstError error;
    Violations violations;
    for (const LightCase& c : light_cases()) {
        if (c.kind == Kind::lopsided) continue;
        const auto samples = lights_of(context, c).sample(c.from, even_words(1 << 16));
        double sum = 0;
        std::size_t without = 0;
        for (const auto& s : samples) {
            without += !(s.pdf > 0);
            sum += s.pdf > 0 ? 1 / s.pdf : 0;
        }
        error.set_subject(c.name);
        error.add(std::abs(sum / static_cast<double>(samples.size()) / solid_angle(c.primitive, c.from) - 1));
        violations.set_subject(c.name);
        // Rounding may turn a rim of the smallest sphere away; by area most of a sphere is turned away.
        const bool may_lose = c.kind == Kind::tiny && c.primitive.a.s[3] == PRIMITIVE_SPHERE;
        const std::size_t allowed = c.by_area ? samples.size() * 9 / 10 : may_lose ? samples.size() / 10000 : 0;
        violations.expect(without <= allowed, "samples without a density");
    }
    return {error.result("light-solid-angle", 1e-3, "relative"), violations.result("light-solid-angle-samples")};
}

// All of a sphere's area, though it is seen from outside.
bool is_whole_sphere(const LightCase& c)
{
    const Primitive& p = c.primitive;
    return p.a.s[3] == PRIMITIVE_SPHERE && (c.by_area || length(point_of(p.a) - c.from) < p.b.s[0]);
}

// The share of samples on the side of the light that is seen: by area, the cap of a sphere.
double seen_share(const LightCase& c)
{
    return c.by_area ? 0.5 * (1 - c.primitive.b.s[0] / length(point_of(c.primitive.a) - c.from)) : 1;
}

// The density integrates to the share of samples that are seen over all directions that meet the light.
Results check_density_integral(const CheckContext& context)
{
    constexpr std::size_t DIRECTIONS = 1 << 17;
    WorstError error;
    Violations violations;
    for (const LightCase& c : light_cases()) {
        if (c.kind == Kind::tiny || c.kind == Kind::lopsided) continue;
        // Directions that cover a cone around the light, or the sphere, evenly.
        const auto named = [&](const char* part) { return c.name.find(part) != std::string::npos; };
        const bool everywhere = named("huge") || named("near") || named("inside");
        const Point a = point_of(c.primitive.a) - c.from;
        const double size = c.primitive.a.s[3] == PRIMITIVE_TRIANGLE
                                ? std::max(length(point_of(c.primitive.b) - point_of(c.primitive.a)),
                                           length(point_of(c.primitive.c) - point_of(c.primitive.a)))
                                : double{std::max(c.primitive.b.s[0], c.primitive.c.s[0])};
        const double sine = everywhere ? 1 : std::min(1.0, size / length(a));
        const double one_minus_cos = everywhere ? 2 : sine >= 1 ? 1 : sine * sine / (1 + std::sqrt(1 - sine * sine));
        const Point axis = unit(a);
        const auto [s, t] = complete_frame(axis);
        std::vector<Point> directions;
        for (std::size_t i = 0; i < DIRECTIONS; ++i) {
            const auto [u, v] = even_point(i);
            const double down = v * one_minus_cos, r = std::sqrt(down * (2 - down));
            directions.push_back((1 - down) * axis + r * (std::cos(2 * PI * u) * s + std::sin(2 * PI * u) * t));
        }
        double integral = 0;
        std::size_t met = 0;
        for (const DeviceLightHit& hit : lights_of(context, c).meet(c.from, directions)) {
            met += hit.primitive == 0;
            integral += hit.primitive == 0 ? hit.pdf : 0;
        }
        integral *= 2 * PI * one_minus_cos / static_cast<double>(DIRECTIONS);
        violations.set_subject(c.name);
        violations.expect(met > DIRECTIONS / 50, "too few directions meet it");
        error.set_subject(c.name);
        error.add(std::abs(integral / seen_share(c) - 1));
    }
    return {error.result("light-density-integral", 4e-3, "relative"),
            violations.result("light-density-integral-directions")};
}

// A sample lies on the light, with the radiance and the density that a ray to it finds.
Results check_agreement(const CheckContext& context)
{
    Violations violations;
    for (const LightCase& c : light_cases()) {
        violations.set_subject(c.name);
        const DeviceLights lights = lights_of(context, c);
        const auto count = static_cast<std::size_t>((1 << 14) * context.effort);
        const auto samples = lights.sample(c.from, random_words(count, context.seed + 43));
        const auto hits = lights.meet(c.from, directions_of(samples));
        std::size_t missed = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            violations.expect(samples[i].radiance == LIGHT_RADIANCE && samples[i].primitive == 0, "sample's radiance");
            if (hits[i].primitive != 0) {
                ++missed;
                continue;
            }
            // By area the density at a sphere's rim is infinite.
            const bool at_rim = c.by_area && samples[i].pdf * solid_angle(c.primitive, c.from) > 10;
            if (samples[i].pdf > 0 && !at_rim)
                violations.expect(std::abs(hits[i].pdf / samples[i].pdf - 1) <= 1e-3, "density of the ray");
            violations.expect(hits[i].radiance == LIGHT_RADIANCE || !(samples[i].pdf > 0), "radiance of the ray");
        }
        // Rounding may put a sample beside the rim; of the tiniest lights it decides.
        violations.expect(missed <= samples.size() / (is_tiniest(c)          ? 2
                                                      : c.kind == Kind::tiny ? 50
                                                                             : 1000),
                          "samples beside it");
    }
    return {violations.result("light-agreement", Rule::bound)};
}

// The two random numbers of a sample, in double: of triangles and disks by area, of spheres from outside by the cone,
// unless it is their whole area.
// Turns are measured from a direction of its own. Numbers of a point that is not on the light are -1.
std::array<double, 2> invert(const LightCase& c, const Point& to_light)
{
    const Primitive& p = c.primitive;
    const Point a = point_of(p.a), b = point_of(p.b), to_a = a - c.from, on_light = c.from + to_light;
    const auto turn_and = [](double x, double y, double other) -> std::array<double, 2> {
        const double turn = std::atan2(y, x) / (2 * PI);
        return {turn - std::floor(turn), other > 1.01 ? -1 : std::min(other, 1.0)};
    };
    if (p.a.s[3] == PRIMITIVE_TRIANGLE) {
        // Barycentric coordinates b1, b2: (b1 + b2)^2 and b2 / (b1 + b2) are uniform.
        const Point e1 = b - a, e2 = point_of(p.c) - a, normal = cross(e1, e2);
        const double b1 = dot(cross(on_light - a, e2), normal) / dot(normal, normal);
        const double b2 = dot(cross(e1, on_light - a), normal) / dot(normal, normal);
        const bool outside = b1 < -1e-2 || b2 < -1e-2 || b1 + b2 > 1.01;
        // At the first corner any share will do.
        const double along = b1 + b2, share = along > 0 ? std::clamp(b2 / along, 0.0, 1.0) : 0.0;
        return {outside ? -1 : std::clamp(along * along, 0.0, 1.0), share};
    }
    if (p.a.s[3] == PRIMITIVE_DISK) {
        const auto [e, f] = complete_frame(unit(b));
        const double x = dot(on_light - a, e) / p.c.s[0], y = dot(on_light - a, f) / p.c.s[0];
        return turn_and(x, y, x * x + y * y);
    }
    if (is_whole_sphere(c)) {
        const Point n = unit(on_light - a);
        return turn_and(n[0], n[1], 0.5 * (1 - n[2]));
    }
    // The squared distance from the axis gives 1 - cos without cancellation.
    const Point axis = unit(to_a), across = cross(axis, unit(to_light));
    const auto [e, f] = complete_frame(axis);
    const double sin2 = dot(across, across), limit = std::pow(p.b.s[0] / length(to_a), 2);
    const double v = sin2 / (1 + std::sqrt(1 - sin2)) / (limit / (1 + std::sqrt(1 - limit)));
    return turn_and(dot(to_light, e), dot(to_light, f), v);
}

// Roundings of a point on the light over the size of the light: how well its numbers can be told.
double relative_rounding(const LightCase& c)
{
    const Primitive& p = c.primitive;
    const Point a = point_of(p.a), to_a = a - c.from;
    const double distance = length(to_a) + length(c.from);
    if (p.a.s[3] == PRIMITIVE_TRIANGLE) {
        const Point e1 = point_of(p.b) - a, e2 = point_of(p.c) - a;
        const double longest = std::max(length(e1), length(e2));
        return FLOAT_ROUNDING * (distance + longest) * longest / length(cross(e1, e2));
    }
    const double radius = p.a.s[3] == PRIMITIVE_DISK ? p.c.s[0] : p.b.s[0];
    return FLOAT_ROUNDING * (distance + radius) / radius;
}

// The random numbers that a sample was made of are found again from its point.
Results check_inversion(const CheckContext& context)
{
    WorstError error;
    const auto count = static_cast<std::size_t>((1 << 16) * context.effort);
    const std::vector<RandomWords> random = random_words(count, context.seed + 61);
    for (const LightCase& c : light_cases()) {
        if (is_tiniest(c)) continue;
        error.set_subject(c.name);
        const bool is_triangle = c.primitive.a.s[3] == PRIMITIVE_TRIANGLE;
        const auto samples = lights_of(context, c).sample(c.from, random);
        std::optional<double> first_turn;
        for (std::size_t i = 0; i < count; ++i) {
            const double u = (random[i][2] >> 8) * 0x1p-24, v = (random[i][3] >> 8) * 0x1p-24;
            const std::array<double, 2> found = invert(c, samples[i].to_light);
            // Near the first corner of a triangle, the centre or a pole the other number is hard to tell.
            const double along = is_triangle ? u : v, along_error = found[is_triangle ? 0 : 1] - along;
            double across_error = found[1] - v;
            if (!is_triangle) {
                // The light's own direction of turns, as the first sample that can tell has it.
                if (!first_turn && v > 0.25 && v < 0.75) first_turn = found[0] - u;
                across_error = std::remainder(found[0] - u - first_turn.value_or(0), 1.0);
                if (!first_turn) continue;
            }
            const double across = std::sqrt(along * (is_whole_sphere(c) ? 1 - along : 1));
            error.add(std::max(std::abs(along_error), across * std::abs(across_error)) / relative_rounding(c));
        }
    }
    return {error.result("light-inversion", INVERSION_ROUNDINGS, "roundings")};
}

std::size_t batches_of(const CheckContext& context, const Resolution& bins)
{
    return static_cast<std::size_t>(std::ceil(bins.samples * context.effort / BATCH));
}

std::vector<double> uniform_probabilities(const Histogram& histogram)
{
    const std::size_t bins = histogram.columns() * histogram.rows();
    return std::vector<double>(bins, 1.0 / static_cast<double>(bins));
}

Results check_distribution(const CheckContext& context)
{
    DistributionTests tests(context);
    for (const LightCase& c : light_cases()) {
        if (is_tiniest(c) || context.stop()) continue;
        const Resolution& bins = c.kind == Kind::tiny ? COARSE : c.kind == Kind::typical ? FINE : PLAIN;
        const DeviceLights lights = lights_of(context, c);
        Histogram histogram(bins.columns, bins.rows);
        for (std::size_t batch = 0; batch < batches_of(context, bins); ++batch)
            for (const auto& s : lights.sample(c.from, random_words(BATCH, context.seed + 3000 + batch))) {
                const auto [x, y] = invert(c, s.to_light);
                histogram.add(x, y);
            }
        tests.add(c.name, histogram, uniform_probabilities(histogram));
    }
    return {tests.result("light-distribution")};
}

// From behind a light is dark, exactly, unless it has two sides or is turned round.
Results check_behind(const CheckContext& context)
{
    const std::vector<LightCase> seen_from_behind{{"triangle", ceiling_light(1, 0.5), {0, 2, 0}},
                                                  {"disk", disk_light({0, 1, 0}, {0, -1, 0}, 0.5), {0.1, 2, 0}},
                                                  {"inside of a sphere", sphere_light({0, 1, 0}, 0.5), {0.1, 1.2, 0}}};
    Violations violations;
    for (LightCase c : seen_from_behind)
        for (const uint flags : {0u, LIGHT_TWO_SIDED})
            for (const uint turned : {0u, SURFACE_FLIP_NORMAL}) {
                c.surface_flags = turned;
                const DeviceLights lights = lights_of(context, c, flags);
                const auto samples = lights.sample(c.from, random_words(1 << 12, context.seed + 53));
                const auto hits = lights.meet(c.from, directions_of(samples));
                std::size_t lit = 0, seen = 0;
                for (std::size_t i = 0; i < samples.size(); ++i) {
                    lit += samples[i].pdf != 0;
                    seen += hits[i].pdf != 0 || hits[i].radiance != Point{0, 0, 0};
                }
                violations.set_subject(fmt::format("{}, flags {}, turned {}", c.name, flags, turned));
                const bool dark = flags == 0 && turned == 0;
                violations.expect(dark ? lit == 0 : lit == samples.size(), "light of samples");
                violations.expect(dark ? seen == 0 : seen >= samples.size() - 4, "light of rays");
            }
    return {violations.result("light-behind", Rule::exact)};
}

// From a point in its plane a flat light is dark; from the surface and the centre of a sphere nothing is infinite.
Results check_plane(const CheckContext& context)
{
    const std::vector<LightCase> in_plane{{"triangle", ceiling_light(1, 0.5), {3, 1, 0}},
                                          {"triangle, on it", ceiling_light(1, 0.5), {0.1, 1, 0}},
                                          {"disk", disk_light({0, 1, 0}, {0, -1, 0}, 0.5), {3, 1, 0}}};
    Violations violations;
    for (const LightCase& c : in_plane)
        for (const uint flags : {0u, LIGHT_TWO_SIDED}) {
            violations.set_subject(c.name);
            for (const auto& s : lights_of(context, c, flags).sample(c.from, even_words(512)))
                violations.expect(s.pdf == 0, "light in the plane");
        }
    const LightCase sphere{"sphere", sphere_light({0, 0, 0}, 1)};
    for (const double height : {1.0, 0.0, 1 - 0x1p-24, 1 + 0x1p-23}) {
        violations.set_subject(fmt::format("sphere at height {:.9g}", height));
        for (const auto& s : lights_of(context, sphere, LIGHT_TWO_SIDED).sample({0, height, 0}, even_words(512)))
            violations.expect(std::isfinite(s.pdf) && s.pdf >= 0, "density not finite or negative");
    }
    return {violations.result("light-plane", Rule::exact)};
}

// Samples of a constant environment are uniform over the sphere, unlimited in distance, and give back their numbers.
Results check_environment(const CheckContext& context)
{
    LightScene sky;
    sky.add_environment(LIGHT_RADIANCE);
    const DeviceLights lights(*context.device, sky, context.lanes);
    Violations violations;
    Histogram histogram(FINE.columns, FINE.rows);
    for (std::size_t batch = 0; batch < batches_of(context, FINE); ++batch) {
        const std::vector<RandomWords> random = random_words(BATCH, context.seed + 4000 + batch);
        const auto samples = lights.sample({0.1, 0.2, 0.3}, random);
        for (std::size_t i = 0; i < BATCH; ++i) {
            const DeviceLightSample& s = samples[i];
            const double turn = std::atan2(s.wi[1], s.wi[0]) / (2 * PI), height = 0.5 * (1 - s.wi[2]);
            histogram.add(turn - std::floor(turn), std::clamp(height, 0.0, 1.0));
            violations.expect(s.t_max == std::numeric_limits<double>::infinity() && s.primitive == NO_INDEX,
                              "distance");
            violations.expect(s.radiance == LIGHT_RADIANCE, "radiance");
            violations.expect(std::abs(s.pdf * 4 * PI - 1) <= 1e-6, "density");
            violations.expect(std::abs(length(s.wi) - 1) <= 1e-6 && s.to_light == s.wi, "not of unit length");
            const double u = (random[i][2] >> 8) * 0x1p-24, v = (random[i][3] >> 8) * 0x1p-24;
            violations.expect(std::abs(height - v) <= 1e-6, "height");
            violations.expect(std::hypot(s.wi[0], s.wi[1]) * std::abs(std::remainder(turn - u, 1.0)) <= 1e-6,
                              "azimuth");
        }
    }
    DistributionTests tests(context);
    tests.add("environment", histogram, uniform_probabilities(histogram));
    return {violations.result("light-environment", Rule::bound), tests.result("light-environment-distribution")};
}
} // namespace

std::vector<Check> light_checks()
{
    const auto check = [](const char* name, Results (*run)(const CheckContext&), std::size_t statistical_tests = 0) {
        return make_check("sampling", name, run, statistical_tests);
    };
    return {check("light-solid-angle", check_solid_angle),
            check("light-density-integral", check_density_integral),
            check("light-agreement", check_agreement),
            check("light-inversion", check_inversion),
            check("light-distribution", check_distribution, light_cases().size()),
            check("light-behind", check_behind),
            check("light-plane", check_plane),
            check("light-environment", check_environment, 1)};
}
} // namespace etendue
