// The sphere test against long double: from outside, inside and the sphere itself, small and far.
#include "check/rays.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace etendue;

namespace
{
// Input 7: whether the ray starts on the sphere.
const DeviceFunctions functions({"geometry/sphere.h"},
                                {{"sphere", "Primitive* float float float float float float mask -> mask float",
                                  "out0 = sphere_hit(in0[0], vec3(in1, in2, in3), vec3(in4, in5, in6), in7, &out1);"}});

struct Found {
    std::vector<std::uint32_t> hit;
    std::vector<float> t;
};

Found meet(const Device& device, const Primitive& sphere, const RayColumns& rays, bool on_it = false,
           std::uint32_t lanes = 0)
{
    const std::vector<std::uint32_t> on(rays.size(), on_it);
    const DeviceResults out = functions.evaluate(device, "sphere", rays.arguments({sphere}, {on}), lanes);
    return {out.get<std::uint32_t>(0), out.get<float>(1)};
}

// Roots of |origin + t direction - centre| = radius, and how far from the centre the line passes.
struct Roots {
    long double nearest_approach, half_chord, middle, speed;

    Roots(const Primitive& sphere, const Long3& origin, const Long3& direction)
    {
        const Long3 f = origin - to_long(sphere.a);
        const long double radius = sphere.b.s[0];
        speed = length(direction);
        middle = -dot(f, direction) / (speed * speed);
        nearest_approach = length(cross(f, direction)) / speed;
        half_chord = std::sqrt(std::max(0.0l, (radius - nearest_approach) * (radius + nearest_approach))) / speed;
    }
    long double near() const { return middle - half_chord; }
    long double far() const { return middle + half_chord; }
};
} // namespace

TEST_CASE("a sphere is met from outside where long double says, whatever its radius and distance")
{
    Randoms randoms;
    for (const long double radius : {1e-4l, 1.0l})
        for (const long double distance : {1.0l, 30.0l, 1000.0l}) {
            // Floats cannot aim at a sphere that is this small and far.
            if (distance > 1e6l * radius) continue;
            const Primitive sphere = make_sphere({0.3l, -0.2l, 0.1l}, radius);
            RayColumns rays;
            for (int i = 0; i < 2000; ++i) {
                const Long3 origin = to_long(sphere.a) + (radius + distance) * randoms.direction();
                const Long3 target = to_long(sphere.a) + 1.5l * radius * randoms.direction();
                rays.add(origin, (1.0l + 0.5l * randoms.number()) * unit(target - origin));
            }
            for (Device& device : test_devices()) {
                const Found found = meet(device, sphere, rays);
                std::size_t inside = 0, outside = 0, wrong = 0;
                for (std::size_t i = 0; i < rays.size(); ++i) {
                    const Roots roots(sphere, rays.origin(i), rays.direction(i));
                    // The line is displaced by a few roundings of the distance to the centre.
                    const long double across = 8 * UNIT_ROUNDOFF_OF_FLOAT * (distance + radius);
                    const long double r = sphere.b.s[0], margin = r - roots.nearest_approach;
                    if (margin < -across) {
                        ++outside;
                        wrong += found.hit[i] != 0;
                    } else if (margin > across) {
                        ++inside;
                        const long double slope = r / (roots.half_chord * roots.speed);
                        const long double error = across * (1 + 2 * slope) / roots.speed;
                        wrong += !found.hit[i] || !(std::abs(found.t[i] - roots.near()) <= error);
                    }
                }
                INFO("radius " << static_cast<double>(radius) << ", distance " << static_cast<double>(distance));
                CHECK(inside > 200);
                CHECK(outside > 100);
                CHECK(wrong == 0);
            }
        }
}

TEST_CASE("from inside the far wall of a sphere is met, in every direction")
{
    Randoms randoms;
    for (const long double radius : {1e-4l, 1.0l}) {
        const Primitive sphere = make_sphere({0, 0, 0}, radius);
        RayColumns rays;
        for (int i = 0; i < 5000; ++i) {
            const Long3 at = randoms.direction();
            rays.add(0.99l * std::abs(randoms.number()) * radius * at, randoms.direction());
        }
        for (Device& device : test_devices()) {
            const Found found = meet(device, sphere, rays);
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const Roots roots(sphere, rays.origin(i), rays.direction(i));
                // 16 roundings of the radius, more where the wall is near and met at a slant.
                const long double slope = sphere.b.s[0] / roots.half_chord;
                const long double error = 16 * UNIT_ROUNDOFF_OF_FLOAT * radius * slope;
                wrong += !found.hit[i] || !(std::abs(found.t[i] - roots.far()) <= error);
            }
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("a ray that starts on a sphere meets it at the other end of the chord, outward never")
{
    Randoms randoms;
    for (const long double radius : {1e-4l, 1.0l}) {
        const Primitive sphere = make_sphere({0.3l, -0.2l, 0.1l}, radius);
        RayColumns rays;
        for (int i = 0; i < 5000; ++i) rays.add(to_long(sphere.a) + radius * randoms.direction(), randoms.direction());
        for (Device& device : test_devices()) {
            const Found found = meet(device, sphere, rays, true);
            std::size_t inward = 0, wrong = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const Long3 normal = unit(rays.origin(i) - to_long(sphere.a));
                const long double cosine = dot(normal, unit(rays.direction(i)));
                // The origin is rounded off the sphere by this much.
                const long double error = 16 * UNIT_ROUNDOFF_OF_FLOAT * (0.3l + radius);
                if (cosine > error / radius) wrong += found.hit[i] != 0;
                // A line nearer to a tangent than that may pass beside the sphere.
                if (cosine > -0.01l || cosine * cosine < 4 * error / radius) continue;
                ++inward;
                const long double chord = -2 * radius * cosine;
                wrong += !found.hit[i] || !(std::abs(found.t[i] - chord) <= error * (1 + 1 / std::abs(cosine)));
            }
            CHECK(inward > 2000);
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("a tangent, the rays just beside it and a sphere behind are decided as they lie")
{
    const Primitive sphere = make_sphere({0, 0, 0}, 1);
    RayColumns rays;
    rays.add({1, 0, 4}, {0, 0, -1});
    rays.add({1 - 0x1p-24l, 0, 4}, {0, 0, -1});
    rays.add({1 + 0x1p-23l, 0, 4}, {0, 0, -1});
    rays.add({0, 0, 4}, {0, 0, -2});
    rays.add({0, 0, 4}, {0, 0, 1});
    for (Device& device : test_devices()) {
        const Found found = meet(device, sphere, rays);
        for (const std::size_t i : {0u, 1u, 3u}) CHECK(found.hit[i] == 1);
        CHECK(found.hit[2] == 0);
        CHECK(found.t[0] == 4.0f);
        CHECK(std::abs(found.t[1] - 4.0f) <= 1e-3f);
        CHECK(found.t[3] == 1.5f);
        // Behind, the distance is negative: no ray accepts it.
        CHECK((!found.hit[4] || found.t[4] < 0.0f));
    }
}

TEST_CASE("a sphere is met with the same bits at every number of lanes")
{
    Randoms randoms;
    RayColumns rays;
    for (int i = 0; i < 1001; ++i) rays.add(3.0l * randoms.direction(), -1.0l * randoms.direction());
    for (Device& device : test_devices()) {
        const Found one = meet(device, make_sphere({}, 1), rays, false, 1);
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const Found several = meet(device, make_sphere({}, 1), rays, false, lanes);
            CAPTURE(lanes);
            CHECK(one.hit == several.hit);
            for (std::size_t i = 0; i < rays.size(); ++i)
                if (one.hit[i]) CHECK(one.t[i] == several.t[i]);
        }
    }
}
