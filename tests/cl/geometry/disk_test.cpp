// The disk test against long double.
#include "check/rays.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace etendue;

namespace
{
const DeviceFunctions functions({"geometry/disk.h"},
                                {{"disk", "Primitive* float float float float float float -> mask float",
                                  "out0 = disk_hit(in0[0], vec3(in1, in2, in3), vec3(in4, in5, in6), &out1);"}});

struct Found {
    std::vector<std::uint32_t> hit;
    std::vector<float> t;
};

Found meet(const Device& device, const Primitive& disk, const RayColumns& rays, std::uint32_t lanes = 0)
{
    const DeviceResults out = functions.evaluate(device, "disk", rays.arguments({disk}), lanes);
    return {out.get<std::uint32_t>(0), out.get<float>(1)};
}

RayColumns rays_around(const Primitive& disk, std::size_t count)
{
    Randoms randoms;
    RayColumns rays;
    while (rays.size() < count) {
        const Long3 origin = 2.0l * randoms.point();
        const Long3 across = unit(cross(randoms.direction(), to_long(disk.b)));
        const Long3 target = to_long(disk.a) + (0.75l + 0.75l * randoms.number()) * disk.c.s[0] * across;
        rays.add(origin, (1.0l + 0.9l * randoms.number()) * (target - origin));
    }
    return rays;
}
} // namespace

TEST_CASE("a disk is met from both sides where long double says")
{
    Randoms randoms;
    for (int k = 0; k < 6; ++k) {
        const Primitive disk = make_disk(0.5l * randoms.point(), randoms.direction(), k % 2 ? 0.7l : 0.01l);
        const RayColumns rays = rays_around(disk, 2000);
        const Long3 centre = to_long(disk.a), normal = to_long(disk.b);
        const long double radius = disk.c.s[0];
        for (Device& device : test_devices()) {
            const Found found = meet(device, disk, rays);
            std::size_t front = 0, back = 0, outside = 0, wrong = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const Long3 o = rays.origin(i), d = rays.direction(i);
                const long double slope = dot(normal, d), t = dot(normal, centre - o) / slope;
                const long double r = length(o + t * d - centre);
                // Ten roundings of the distance, more at a slant.
                const long double along =
                    10 * UNIT_ROUNDOFF_OF_FLOAT * length(centre - o) * length(d) / std::abs(slope);
                const long double error = along + 10 * UNIT_ROUNDOFF_OF_FLOAT * (length(centre - o) + length(t * d));
                if (r < radius - error) {
                    ++(slope < 0 ? front : back);
                    const long double t_error = along / length(d) + 4 * UNIT_ROUNDOFF_OF_FLOAT * std::abs(t) *
                                                                        (1 + length(d) / std::abs(slope));
                    wrong += !found.hit[i] || !(std::abs(found.t[i] - t) <= t_error);
                } else if (r > radius + error) {
                    ++outside;
                    wrong += found.hit[i] != 0;
                }
            }
            CHECK(front > 100);
            CHECK(back > 100);
            CHECK(outside > 100);
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("rays parallel to a disk do not meet it, within its plane or beside it")
{
    const Primitive disk = make_disk({0, 0, 0}, {0, 0, 1}, 1);
    RayColumns rays;
    for (const long double z : {-1.0l, 0.0l, 1.0l})
        for (const long double zero : {-0.0l, 0.0l}) rays.add({-3, 0, z}, {1, 0.25l, zero});
    for (Device& device : test_devices())
        CHECK(meet(device, disk, rays).hit == std::vector<std::uint32_t>(rays.size(), 0u));
}

TEST_CASE("the rim belongs to a disk, and one behind the ray is at a negative distance")
{
    const Primitive disk = make_disk({0, 0, 0}, {0, 0, 1}, 0.5l);
    RayColumns rays;
    rays.add({0.5l, 0, 2}, {0, 0, -2});
    rays.add({0.5l + 0x1p-20l, 0, 2}, {0, 0, -2});
    rays.add({0.25l, 0, 2}, {0, 0, 2});
    for (Device& device : test_devices()) {
        const Found found = meet(device, disk, rays);
        CHECK(found.hit[0] == 1);
        CHECK(found.t[0] == 1.0f);
        CHECK(found.hit[1] == 0);
        CHECK((!found.hit[2] || found.t[2] == -1.0f));
    }
}

TEST_CASE("a disk is met with the same bits at every number of lanes")
{
    const Primitive disk = make_disk({0.1l, 0.2l, 0.3l}, unit({1, 2, 3}), 0.7l);
    const RayColumns rays = rays_around(disk, 1001);
    for (Device& device : test_devices()) {
        const Found one = meet(device, disk, rays, 1);
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const Found several = meet(device, disk, rays, lanes);
            CAPTURE(lanes);
            CHECK(one.hit == several.hit);
            CHECK(one.t == several.t);
        }
    }
}
