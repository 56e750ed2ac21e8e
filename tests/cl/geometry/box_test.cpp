// The box test: it never misses what lies in a padded box, and agrees with slabs in long double elsewhere.
#include "check/rays.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>

using namespace etendue;

namespace
{
// Input 0: one box, whose lower and upper corner are vertices a and b; input 7: t_max.
const DeviceFunctions functions({"geometry/box.h"},
                                {{"box", "Primitive* float float float float float float float -> mask float",
                                  R"(
    real4 lower = in0[0].a, upper = in0[0].b;
    Ray ray = {vec3(in1, in2, in3), vec3(in4, in5, in6), in7, (Uint)(NO_INDEX), (Uint)(NO_INDEX)};
    out0 = box_hit(lower.x, upper.x, lower.y, upper.y, lower.z, upper.z, make_box_ray(ray), in7, &out1);)"}});

constexpr float INFINITE = std::numeric_limits<float>::infinity();

struct Entries {
    std::vector<std::uint32_t> hit;
    std::vector<float> t;
};

Entries enter_box(const Device& device, const Long3& lower, const Long3& upper, const RayColumns& rays,
                  std::vector<float> t_max = {}, std::uint32_t lanes = 0)
{
    t_max.resize(rays.size(), INFINITE);
    const DeviceResults out =
        functions.evaluate(device, "box", rays.arguments({make_triangle(lower, upper, {})}, {t_max}), lanes);
    return {out.get<std::uint32_t>(0), out.get<float>(1)};
}

// The corners of what the box of a tree encloses, one ulp of the largest coordinate farther out.
Long3 padded(const Long3& corner, long double sign)
{
    const long double ulp = 0x1p-23l;
    return corner + sign * ulp * Long3{1, 1, 1};
}

std::size_t misses(const Entries& entries)
{
    return static_cast<std::size_t>(std::count(entries.hit.begin(), entries.hit.end(), 0u));
}
} // namespace

TEST_CASE("rays along the faces and edges of what a padded box encloses never miss it")
{
    const Long3 lower{-1, -0.5l, 0.25l}, upper{1, 0.75l, 0.25l}; // flat: the box of a floor
    RayColumns rays;
    for (const std::size_t axis : {0u, 1u, 2u})
        for (const long double sign : {-1.0l, 1.0l})
            for (const long double zero : {-0.0l, 0.0l})
                for (const long double u : {0.0l, 0.5l, 1.0l})
                    for (const long double v : {0.0l, 0.5l, 1.0l}) {
                        const std::size_t second = (axis + 1) % 3, third = (axis + 2) % 3;
                        Long3 origin, direction{zero, zero, zero};
                        origin[axis] = -4 * sign;
                        origin[second] = lower[second] + u * (upper[second] - lower[second]);
                        origin[third] = lower[third] + v * (upper[third] - lower[third]);
                        direction[axis] = sign;
                        rays.add(origin, direction);
                        // Start on the boundary itself, too.
                        origin[axis] = sign > 0 ? lower[axis] : upper[axis];
                        rays.add(origin, direction);
                    }
    for (Device& device : test_devices())
        CHECK(misses(enter_box(device, padded(lower, -1), padded(upper, 1), rays)) == 0);
}

TEST_CASE("a point in a box is reached before the distance to it by rays from anywhere")
{
    const Long3 lower{-1, -0.5l, 0.25l}, upper{1, 0.75l, 0.875l};
    Randoms randoms;
    RayColumns rays;
    std::vector<float> to_target;
    for (int i = 0; i < 20000; ++i) {
        // Aim at corners, edges, faces and the inside in turn.
        Long3 target = lower;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool at_corner = static_cast<std::size_t>(i) % 4 > axis;
            const long double u = 0.5l + 0.5l * randoms.number();
            target[axis] += (at_corner ? std::round(u) : u) * (upper[axis] - lower[axis]);
        }
        // Go back from the target, so that only the origin is rounded.
        const long double t = 2.0l + randoms.number();
        RayColumns ray;
        ray.add({}, randoms.direction());
        rays.add(target - t * ray.direction(0), ray.direction(0));
        to_target.push_back(static_cast<float>(t) * (1 + 0x1p-20f));
    }
    for (Device& device : test_devices()) {
        // Origins of size 4 are rounded by as much as 2^-22.
        const Long3 margin{0x1p-22l, 0x1p-22l, 0x1p-22l};
        CHECK(misses(enter_box(device, lower - margin, upper + margin, rays, to_target)) == 0);
    }
}

TEST_CASE("a box agrees with slabs in long double, the distance where it is entered included")
{
    const Long3 lower{-0.5l, -0.25l, -0.125l}, upper{0.25l, 0.5l, 0.375l};
    Randoms randoms;
    RayColumns rays;
    for (int i = 0; i < 20000; ++i) rays.add(randoms.point(), randoms.direction());
    for (Device& device : test_devices()) {
        const Entries found = enter_box(device, lower, upper, rays);
        std::size_t hits = 0, wrong = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            long double enter = 0, leave = std::numeric_limits<long double>::infinity();
            // The box is wider by 12 roundings of the origin.
            const Long3 origin = rays.origin(i);
            const long double margin =
                12 * UNIT_ROUNDOFF_OF_FLOAT * std::max({std::abs(origin[0]), std::abs(origin[1]), std::abs(origin[2])});
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const long double o = rays.origin(i)[axis], d = rays.direction(i)[axis];
                const auto [first, last] =
                    std::minmax({(lower[axis] - margin - o) / d, (upper[axis] + margin - o) / d});
                enter = std::max(enter, first);
                leave = std::min(leave, last);
            }
            // Three roundings of each distance, the enlarged far one, and those of the origin with its margin.
            long double steepest = 0;
            for (std::size_t axis = 0; axis < 3; ++axis)
                steepest = std::max(steepest, 2 * std::abs(origin[axis] / rays.direction(i)[axis]));
            const long double error = UNIT_ROUNDOFF_OF_FLOAT * (10 * std::max(enter, std::abs(leave)) + steepest);
            if (leave - enter > error) {
                ++hits;
                wrong += !found.hit[i] || std::abs(found.t[i] - enter) > error;
            } else if (enter - leave > 2 * error)
                wrong += found.hit[i];
        }
        CHECK(hits > 1000);
        CHECK(hits < 19000);
        CHECK(wrong == 0);
    }
}

TEST_CASE("a box behind the ray or beyond t_max is not met, and from inside it is entered at once")
{
    RayColumns rays;
    rays.add({0, 0, 3}, {0, 0, 1});
    rays.add({0, 0, 3}, {0, 0, -1});
    rays.add({0, 0, 3}, {0, 0, -1});
    rays.add({0, 0, 3}, {0, 0, -1});
    rays.add({0, 0, 3}, {0, 0, -2});
    rays.add({0, 0, 0.5l}, {0, 0, 1});
    rays.add({2, 0, 3}, {0, 0, -1});
    const std::vector<float> t_max{INFINITE, INFINITE, 1.75f, 2.0f, 1.0f, 0.0f, INFINITE};
    for (Device& device : test_devices()) {
        const Entries found = enter_box(device, {-1, -1, -1}, {1, 1, 1}, rays, t_max);
        CHECK(found.hit == std::vector<std::uint32_t>{0, 1, 0, 1, 1, 1, 0});
        CHECK(found.t[1] == Approx(2.0).epsilon(4e-6));
        CHECK(found.t[4] == Approx(1.0).epsilon(4e-6));
        CHECK(found.t[5] == 0.0f);
    }
}

TEST_CASE("a box is met with the same bits at every number of lanes")
{
    Randoms randoms;
    RayColumns rays;
    for (int i = 0; i < 1001; ++i) rays.add(randoms.point(), randoms.direction());
    for (Device& device : test_devices()) {
        const Entries one = enter_box(device, {-1, -0.5l, 0}, {0.5l, 0.5l, 0.5l}, rays, {}, 1);
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const Entries several = enter_box(device, {-1, -0.5l, 0}, {0.5l, 0.5l, 0.5l}, rays, {}, lanes);
            CAPTURE(lanes);
            CHECK(one.hit == several.hit);
            CHECK(one.t == several.t);
        }
    }
}
