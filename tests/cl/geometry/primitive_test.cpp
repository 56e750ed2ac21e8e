// One primitive of any kind against rays that start on it or go to it.
#include "check/rays.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

using namespace etendue;

namespace
{
// Inputs 7 to 9: from, to, active. The primitive's id is 3.
const DeviceFunctions
    functions({"geometry/primitive.h"},
              {{"primitive", "Primitive* float float float float float float uint uint mask -> mask float float float",
                R"(
    Ray ray = {vec3(in1, in2, in3), vec3(in4, in5, in6), (Float)(INFINITY), in7, in8};
    out1 = out2 = out3 = (Float)(-1.0);
    out0 = primitive_hit(in0[0], 3u, in9, prepare_ray(ray), &out1, &out2, &out3);)"}});

struct Found {
    std::vector<std::uint32_t> hit;
    std::vector<float> t, b1, b2;
};

struct Trip {
    std::uint32_t from = NO_INDEX, to = NO_INDEX, active = 1;
};

// The same ray on several trips.
Found meet(const Device& device, const Primitive& primitive, const Long3& origin, const Long3& direction,
           const std::vector<Trip>& trips, std::uint32_t lanes)
{
    RayColumns rays;
    std::vector<std::uint32_t> from, to, active;
    for (const Trip& trip : trips) {
        rays.add(origin, direction);
        from.push_back(trip.from);
        to.push_back(trip.to);
        active.push_back(trip.active);
    }
    const DeviceResults out =
        functions.evaluate(device, "primitive", rays.arguments({primitive}, {from, to, active}), lanes);
    return {out.get<std::uint32_t>(0), out.get<float>(1), out.get<float>(2), out.get<float>(3)};
}

const Primitive TRIANGLE = make_triangle({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
const Primitive SPHERE = make_sphere({0, 0, 0}, 0.5l);
const Primitive DISK = make_disk({0, 0, 0}, {0, 0, 1}, 1);

const std::vector<Trip> TRIPS{{}, {3}, {NO_INDEX, 3}, {2, 4}, {NO_INDEX, NO_INDEX, 0}, {3, 3}, {0, 0}};
} // namespace

TEST_CASE("the kind of a primitive decides how it is met")
{
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const Found triangle = meet(device, TRIANGLE, {0, 1, 2}, {0, 0, -1}, {{}}, lanes);
            CHECK(triangle.hit[0] == 1);
            CHECK(triangle.t[0] == 2.0f);
            CHECK(triangle.b1[0] == 0.25f);
            CHECK(triangle.b2[0] == 0.5f);
            const Found sphere = meet(device, SPHERE, {0, 0, 2}, {0, 0, -1}, {{}}, lanes);
            CHECK(sphere.hit[0] == 1);
            CHECK(sphere.t[0] == 1.5f);
            CHECK(sphere.b1[0] == 0.0f);
            CHECK(sphere.b2[0] == 0.0f);
            const Found disk = meet(device, DISK, {0.5l, 0, 2}, {0, 0, -4}, {{}}, lanes);
            CHECK(disk.hit[0] == 1);
            CHECK(disk.t[0] == 0.5f);
            CHECK(disk.b1[0] == 0.0f);
            CHECK(disk.b2[0] == 0.0f);
            CHECK(meet(device, SPHERE, {0.75l, 0, 2}, {0, 0, -1}, {{}}, lanes).hit[0] == 0);
            CHECK(meet(device, DISK, {0.75l, 0.75l, 2}, {0, 0, -1}, {{}}, lanes).hit[0] == 0);
        }
}

TEST_CASE("triangles and disks are skipped by rays from them and to them, and by inactive lanes")
{
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS)
            for (const Primitive& primitive : {TRIANGLE, DISK})
                CHECK(meet(device, primitive, {0.25l, 0, 2}, {0, 0, -1}, TRIPS, lanes).hit ==
                      std::vector<std::uint32_t>{1, 0, 0, 1, 0, 0, 1});
}

TEST_CASE("a sphere is met again from itself at the end of a chord, and skipped by rays to it")
{
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const Found inward = meet(device, SPHERE, {0, 0, 0.5l}, {0, 0, -1}, TRIPS, lanes);
            CHECK(inward.hit == std::vector<std::uint32_t>{1, 1, 0, 1, 0, 0, 1});
            CHECK(inward.t[1] == 1.0f);
            CHECK(meet(device, SPHERE, {0, 0, 0.5l}, {0, 0, 1}, {{3}}, lanes).hit[0] == 0);
        }
}
