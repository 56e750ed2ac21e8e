// Triangles, disks and spheres that emit: solid angles in closed form, densities by quadrature, samples by chi-square.
#include "check/primitive_sets.h"
#include "support/chi_square.h"
#include "check/device_lights.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numbers>

namespace etendue
{
namespace
{
constexpr double PI = std::numbers::pi;
const Point RADIANCE{1, 2, 3};

Point point(const real4& v)
{
    return {v.s[0], v.s[1], v.s[2]};
}

// Van Oosterom and Strackee 1983, of the triangle's vertices as seen from a point.
double triangle_solid_angle(const Point& a, const Point& b, const Point& c)
{
    const double la = length(a), lb = length(b), lc = length(c);
    return std::abs(2 *
                    std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb));
}

// Solid angle of a primitive of any kind; a disk as a fan of triangles.
double solid_angle(const Primitive& p, const Point& from)
{
    const Point a = point(p.a) - from;
    if (p.a.s[3] == PRIMITIVE_SPHERE) {
        const double sine = p.b.s[0] / length(a);
        return sine >= 1 ? 4 * PI : 2 * PI * sine * sine / (1 + std::sqrt(1 - sine * sine));
    }
    if (p.a.s[3] == PRIMITIVE_TRIANGLE) return triangle_solid_angle(a, point(p.b) - from, point(p.c) - from);
    const std::array<Point, 2> frame = complete_frame(unit(point(p.b)));
    const auto rim = [&](int i) {
        const double angle = 2 * PI * i / 8192;
        return a + p.c.s[0] * (std::cos(angle) * frame[0] + std::sin(angle) * frame[1]);
    };
    double sum = 0;
    for (int i = 0; i < 8192; ++i) sum += triangle_solid_angle(a, rim(i), rim(i + 1));
    return sum;
}

Primitive disk(const Point& centre, const Point& normal, double radius)
{
    return {make_real4(centre[0], centre[1], centre[2], PRIMITIVE_DISK), make_real4(normal[0], normal[1], normal[2]),
            make_real4(radius, 0, 0)};
}

// Triangle under y = height whose geometric normal points down.
Primitive ceiling(double height, double size)
{
    return make_triangle(make_real4(-size, height, -size), make_real4(2 * size, height, 0),
                         make_real4(0, height, 1.5 * size));
}

LightScene light_of(const Primitive& primitive, uint light_flags = 0, uint surface_flags = 0)
{
    LightScene scene;
    scene.add_area(primitive, RADIANCE, 1, light_flags, surface_flags);
    return scene;
}

struct Case {
    std::string name;
    Primitive primitive;
    Point from{0, 0, 0};
};

// Seen from the side that emits.
std::vector<Case> cases()
{
    return {{"triangle", ceiling(1, 0.5)},
            {"triangle, tiny", ceiling(1, 1e-4)},
            {"triangle, huge", ceiling(1, 5)},
            {"triangle, near", ceiling(0.1, 0.5)},
            {"triangle, far", ceiling(1000, 0.5)},
            {"triangle, aslant", make_triangle(make_real4(1, 0.2, 1), make_real4(1.5, 1, 0.5), make_real4(2, 0.1, -1))},
            {"disk", disk({0, 1, 0}, {0, -1, 0}, 0.5)},
            {"disk, tiny", disk({0.1, 1, 0}, {0, -1, 0}, 1e-4)},
            {"disk, huge", disk({1, 1, 0}, {0, -1, 0}, 5)},
            {"disk, aslant", disk({0.5, 1, 0}, {-0.6, -0.8, 0}, 0.5)},
            {"sphere", make_sphere(1, 0.5, 0, 0.5)},
            {"sphere, tiny", make_sphere(1, 0.5, 0, 1e-4)},
            {"sphere, huge", make_sphere(0, 101, 0, 100)},
            {"sphere, near", make_sphere(0, 1.001, 0, 1)},
            {"sphere, far", make_sphere(0, 1000, 0, 1)},
            {"sphere from inside", make_sphere(0.3, 0.2, 0.1, 1)}};
}

// Spheres emit outwards; turned round to be seen from inside.
uint surface_flags(const Case& c)
{
    return c.name == "sphere from inside" ? SURFACE_FLIP_NORMAL : 0;
}
} // namespace

TEST_CASE("the mean of one over the density of an area light's samples is its solid angle")
{
    for (const Device& device : test_devices())
        for (const Case& c : cases()) {
            double sum = 0;
            const auto samples =
                DeviceLights(device, light_of(c.primitive, 0, surface_flags(c))).sample(c.from, even_words(1 << 16));
            std::size_t without = 0;
            for (const auto& s : samples) {
                without += !(s.pdf > 0);
                sum += s.pdf > 0 ? 1 / s.pdf : 0;
            }
            CAPTURE(c.name);
            // Rounding may turn a rim of the smallest sphere away.
            CHECK(without <= (c.name == "sphere, tiny" ? samples.size() / 10000 : 0));
            CHECK(sum / static_cast<double>(samples.size()) == Approx(solid_angle(c.primitive, c.from)).epsilon(1e-3));
        }
}

TEST_CASE("the density of an area light integrates to 1 over all directions that meet it")
{
    constexpr std::size_t DIRECTIONS = 1 << 17;
    for (const Device& device : test_devices())
        for (const Case& c : cases()) {
            if (c.name.find("tiny") != std::string::npos) continue; // floats have too few directions towards it
            // Directions that cover a cone around the light, or the sphere, evenly.
            const bool everywhere = c.name.find("huge") != std::string::npos ||
                                    c.name.find("near") != std::string::npos ||
                                    c.name.find("inside") != std::string::npos;
            const Point a = point(c.primitive.a) - c.from;
            const double size = c.primitive.a.s[3] == PRIMITIVE_TRIANGLE
                                    ? std::max(length(point(c.primitive.b) - point(c.primitive.a)),
                                               length(point(c.primitive.c) - point(c.primitive.a)))
                                    : double{std::max(c.primitive.b.s[0], c.primitive.c.s[0])};
            const double sine = everywhere ? 1 : std::min(1.0, size / length(a));
            const double one_minus_cos = everywhere  ? 2
                                         : sine >= 1 ? 1
                                                     : sine * sine / (1 + std::sqrt(1 - sine * sine));
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
            const DeviceLights lights(device, light_of(c.primitive, 0, surface_flags(c)));
            for (const DeviceLightHit& hit : lights.meet(c.from, directions)) {
                met += hit.primitive == 0;
                integral += hit.primitive == 0 ? hit.pdf : 0;
            }
            integral *= 2 * PI * one_minus_cos / static_cast<double>(DIRECTIONS);
            CAPTURE(c.name, met);
            CHECK(met > DIRECTIONS / 50);
            CHECK(integral == Approx(1).epsilon(4e-3));
        }
}

TEST_CASE("a sample of an area light lies on it, with the radiance and the density that a ray to it finds")
{
    for (const Device& device : test_devices())
        for (const Case& c : cases()) {
            const DeviceLights lights(device, light_of(c.primitive, 0, surface_flags(c)));
            const auto samples = lights.sample(c.from, random_words(1 << 14, 43));
            std::vector<Point> directions;
            for (const auto& s : samples) directions.push_back(s.to_light);
            const auto hits = lights.meet(c.from, directions);
            std::size_t missed = 0, wrong_density = 0, wrong_radiance = 0;
            for (std::size_t i = 0; i < samples.size(); ++i) {
                wrong_radiance += samples[i].radiance != RADIANCE || samples[i].primitive != 0;
                if (hits[i].primitive != 0) {
                    ++missed;
                    continue;
                }
                wrong_density += std::abs(hits[i].pdf / samples[i].pdf - 1) > 1e-3;
                wrong_radiance += hits[i].radiance != RADIANCE;
            }
            CAPTURE(c.name);
            // Rounding may put a sample beside the rim.
            CHECK(missed <= samples.size() / (c.name.find("tiny") != std::string::npos ? 50 : 1000));
            CHECK(wrong_density == 0);
            CHECK(wrong_radiance == 0);
        }
}

TEST_CASE("samples of an area light are uniform: over the area of triangles and disks, over the cone of spheres")
{
    for (const Device& device : test_devices())
        for (const Case& c : cases()) {
            Histogram histogram(16, 16);
            const Primitive& p = c.primitive;
            const Point a = point(p.a), b = point(p.b), to_a = a - c.from;
            const DeviceLights lights(device, light_of(p, 0, surface_flags(c)));
            for (const auto& s : lights.sample(c.from, random_words(1 << 19, 47))) {
                const auto add_turn = [&](double x, double y, double other) {
                    const double turn = std::atan2(y, x) / (2 * PI);
                    histogram.add(turn - std::floor(turn), std::min(other, 1.0));
                };
                const Point on_light = c.from + s.to_light;
                if (p.a.s[3] == PRIMITIVE_TRIANGLE) {
                    // Barycentric coordinates b1, b2: (b1 + b2)^2 and b2 / (b1 + b2) are uniform.
                    const Point e1 = b - a, e2 = point(p.c) - a, normal = cross(e1, e2);
                    const double b1 = dot(cross(on_light - a, e2), normal) / dot(normal, normal);
                    const double b2 = dot(cross(e1, on_light - a), normal) / dot(normal, normal);
                    const auto clamp = [](double x) { return std::min(std::max(x, 0.0), 1.0); };
                    const bool outside = b1 < -1e-2 || b2 < -1e-2 || b1 + b2 > 1.01;
                    histogram.add(outside ? -1 : clamp(b2 / (b1 + b2)), clamp((b1 + b2) * (b1 + b2)));
                } else if (p.a.s[3] == PRIMITIVE_DISK) {
                    const auto [e, f] = complete_frame(unit(b));
                    const double x = dot(on_light - a, e) / p.c.s[0], y = dot(on_light - a, f) / p.c.s[0];
                    add_turn(x, y, x * x + y * y > 1.01 ? -1 : x * x + y * y);
                } else if (length(to_a) < p.b.s[0]) {
                    const Point n = unit(on_light - a);
                    add_turn(n[0], n[1], 0.5 * (1 + n[2]));
                } else {
                    // The squared distance from the axis gives 1 - cos without cancellation.
                    const Point axis = unit(to_a), across = cross(axis, unit(s.to_light));
                    const auto [e, f] = complete_frame(axis);
                    const double sin2 = dot(across, across), limit = std::pow(p.b.s[0] / length(to_a), 2);
                    const double v = sin2 / (1 + std::sqrt(1 - sin2)) / (limit / (1 + std::sqrt(1 - limit)));
                    add_turn(dot(s.to_light, e), dot(s.to_light, f), v > 1.01 ? -1 : v);
                }
            }
            check_histogram(c.name, histogram, std::vector<double>(256, 1.0 / 256));
        }
}

TEST_CASE("from behind an area light is dark, exactly, unless it has two sides")
{
    const std::vector<Case> seen_from_behind{{"triangle", ceiling(1, 0.5), {0, 2, 0}},
                                             {"disk", disk({0, 1, 0}, {0, -1, 0}, 0.5), {0.1, 2, 0}},
                                             {"inside of a sphere", make_sphere(0, 1, 0, 0.5), {0.1, 1.2, 0}}};
    for (const Device& device : test_devices())
        for (const Case& c : seen_from_behind)
            for (const uint flags : {0u, LIGHT_TWO_SIDED})
                for (const uint turned : {0u, SURFACE_FLIP_NORMAL}) {
                    const DeviceLights lights(device, light_of(c.primitive, flags, turned));
                    const auto samples = lights.sample(c.from, random_words(1 << 12, 53));
                    std::vector<Point> directions;
                    for (const auto& s : samples) directions.push_back(s.to_light);
                    const auto hits = lights.meet(c.from, directions);
                    std::size_t lit = 0, seen = 0;
                    for (std::size_t i = 0; i < samples.size(); ++i) {
                        lit += samples[i].pdf != 0;
                        seen += hits[i].pdf != 0 || hits[i].radiance != Point{0, 0, 0};
                    }
                    CAPTURE(c.name, flags, turned);
                    const bool dark = flags == 0 && turned == 0;
                    CHECK((dark ? lit == 0 : lit == samples.size()));
                    CHECK((dark ? seen == 0 : seen >= samples.size() - 4));
                }
}

TEST_CASE("from a point in its plane a flat light is dark, and from its surface nothing is infinite")
{
    const std::vector<Case> in_plane{{"triangle", ceiling(1, 0.5), {3, 1, 0}},
                                     {"triangle, on it", ceiling(1, 0.5), {0.1, 1, 0}},
                                     {"disk", disk({0, 1, 0}, {0, -1, 0}, 0.5), {3, 1, 0}}};
    for (const Device& device : test_devices())
        for (const Case& c : in_plane)
            for (const uint flags : {0u, LIGHT_TWO_SIDED})
                for (const auto& s :
                     DeviceLights(device, light_of(c.primitive, flags)).sample(c.from, even_words(512))) {
                    CAPTURE(c.name);
                    CHECK(s.pdf == 0);
                }
    // On a sphere, and at its centre.
    const LightScene sphere = light_of(make_sphere(0, 0, 0, 1), LIGHT_TWO_SIDED);
    for (const Device& device : test_devices())
        for (const Point& from : {Point{0, 1, 0}, Point{0, 0, 0}, Point{0, 1 - 0x1p-24, 0}, Point{0, 1 + 0x1p-23, 0}})
            for (const auto& s : DeviceLights(device, sphere).sample(from, even_words(512))) {
                CAPTURE(from[1]);
                CHECK(std::isfinite(s.pdf));
                CHECK(s.pdf >= 0);
            }
}
} // namespace etendue
