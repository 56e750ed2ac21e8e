// Rays that leave a surface: they do not meet it again, however grazing, and miss nothing close above it.
#include "check/rays.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numbers>
#include <numeric>

using namespace etendue;

namespace
{
// Input 0: two triangles of a floor, then two of a sheet above. Inputs 1 to 3: primitive, b1, b2; 4 to 6: direction; 7:
// outward. Outputs: hits of the floor and of the sheet from there, without skipping any primitive.
const DeviceFunctions
    functions({"geometry/ray_offset.h", "geometry/triangle.h"},
              {{"leave", "Primitive* uint float float float float float mask PrimitiveSurface* real4* -> uint uint",
                R"(
    Ray arrival = {vec3(in4, in5, in6), vec3(in4, in5, in6), (Float)(INFINITY), (Uint)(NO_INDEX), (Uint)(NO_INDEX)};
    Hit hit = {(Float)(1.0), in1, in2, in3};
    Surface surface = make_surface(in0, in8, in9, to_mask(1), arrival, hit);
    Vec3 origin = offset_origin(surface, in7);
    RayShear shear = make_ray_shear(vec3(in4, in5, in6));
    out0 = out1 = (Uint)(0u);
    for (uint id = 0; id < 4; id++) {
        Float t, b1, b2;
        Mask met = triangle_hit(in0[id], origin, shear, &t, &b1, &b2) & (t > 0.0);
        if (id < 2) out0 += met ? (Uint)(1u) : (Uint)(0u);
        else out1 += met ? (Uint)(1u) : (Uint)(0u);
    })"}});

// Two triangles of the plane y, from -size to size, with the normal up; turned in the plane by an angle.
std::vector<Primitive> floor_at(long double y, long double size, long double angle)
{
    const long double c = size * std::cos(angle), s = size * std::sin(angle);
    const Long3 p{c - s, y, c + s}, q{c + s, y, s - c}, r{s - c, y, -c - s}, o{-c - s, y, c - s};
    return {make_triangle(p, q, r), make_triangle(p, r, o)};
}

struct Departures {
    std::vector<std::uint32_t> primitive;
    std::vector<float> b1, b2, x, y, z;
};

// Departures from all over a floor, many of them beside the diagonal, at a cosine to the normal.
Departures departures(std::size_t count, long double cosine)
{
    Randoms randoms;
    Departures all;
    for (std::size_t i = 0; i < count; ++i) {
        const long double u = 0.5l + 0.5l * randoms.number(), v = 0.5l + 0.5l * randoms.number();
        const long double b1 = (i % 2 ? 1e-6l : 1.0l) * u;
        const long double phi = std::numbers::pi_v<long double> * randoms.number();
        const long double sine = std::sqrt(1 - cosine * cosine);
        all.primitive.push_back(i / 2 % 2);
        // The diagonal is the edge opposite to vertex 1 of the first triangle and to vertex 2 of the second.
        const long double other = v * (1 - b1);
        all.b1.push_back(static_cast<float>(i / 2 % 2 ? other : b1));
        all.b2.push_back(static_cast<float>(i / 2 % 2 ? b1 : other));
        all.x.push_back(static_cast<float>(sine * std::cos(phi)));
        all.y.push_back(static_cast<float>(cosine));
        all.z.push_back(static_cast<float>(sine * std::sin(phi)));
    }
    return all;
}

struct Met {
    std::vector<std::uint32_t> floor, sheet;
};

Met leave(const Device& device, std::vector<Primitive> floor, const std::vector<Primitive>& sheet,
          const Departures& from, std::uint32_t outward, std::uint32_t lanes = 0)
{
    floor.insert(floor.end(), sheet.begin(), sheet.end());
    const std::vector<PrimitiveSurface> looks(4, {0, NO_INDEX, NO_INDEX, 0});
    const DeviceResults out =
        functions.evaluate(device, "leave",
                           {floor, from.primitive, from.b1, from.b2, from.x, from.y, from.z,
                            std::vector<std::uint32_t>(from.b1.size(), outward), looks, std::vector<real4>(3)},
                           lanes);
    return {out.get<std::uint32_t>(0), out.get<std::uint32_t>(1)};
}

std::uint32_t sum(const std::vector<std::uint32_t>& counts)
{
    return std::accumulate(counts.begin(), counts.end(), 0u);
}

// The sheet reaches a floor's size beyond it: rays at this cosine cannot leave below it.
constexpr long double SHEET_SIZE = 3, LEAST_COSINE_AT_SHEET = 1e-5l;

constexpr long double COSINES[] = {1.0l, 0.5l, 1e-1l, 1e-2l, 1e-3l, 1e-4l, 1e-5l, 1e-6l, 1e-7l};
} // namespace

TEST_CASE("rays that leave a floor of two triangles meet neither, but a sheet close above")
{
    for (const long double height : {0.0l, 0.1l, 1.0l})
        for (const long double angle : {0.0l, 0.4l}) {
            const auto floor = floor_at(height, 1, angle), sheet = floor_at(height + 1e-5l, SHEET_SIZE, angle);
            for (const long double cosine : COSINES) {
                const Departures from = departures(4000, cosine);
                INFO("height " << static_cast<double>(height) << ", cosine " << static_cast<double>(cosine));
                for (Device& device : test_devices()) {
                    const Met met = leave(device, floor, sheet, from, 1);
                    CHECK(sum(met.floor) == 0);
                    if (cosine < LEAST_COSINE_AT_SHEET) continue;
                    CHECK(std::count(met.sheet.begin(), met.sheet.end(), 0u) == 0);
                }
            }
        }
}

TEST_CASE("rays that go through a floor do not meet it again, nor the sheet above")
{
    for (const long double height : {0.0l, 0.1l, 1.0l}) {
        const auto floor = floor_at(height, 1, 0.4l), sheet = floor_at(height + 1e-5l, SHEET_SIZE, 0.4l);
        for (const long double cosine : COSINES)
            for (Device& device : test_devices()) {
                const Met met = leave(device, floor, sheet, departures(4000, -cosine), 0);
                CHECK(sum(met.floor) == 0);
                CHECK(sum(met.sheet) == 0);
            }
    }
}

TEST_CASE("an origin on the wrong side meets its floor, at every number of lanes")
{
    const auto floor = floor_at(1, 1, 0.4l), sheet = floor_at(2, SHEET_SIZE, 0.4l);
    const Departures from = departures(1001, 0.5l);
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(sum(leave(device, floor, sheet, from, 0, lanes).floor) >= 990);
}
