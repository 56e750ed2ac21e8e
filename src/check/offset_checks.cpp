// Rays that leave a floor: they do not meet it again, however grazing, and miss nothing close above it.
#include "check/bvh_checks.h"
#include "check/findings.h"
#include "check/rays.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace etendue
{
namespace
{
// Input 0: two triangles of a floor, then two of a sheet above. Inputs 1 to 3: primitive, b1, b2; 4 to 6: direction; 7:
// outward. Outputs: hits of the floor and of the sheet from there, without skipping any primitive.
const DeviceFunctions& functions()
{
    static const DeviceFunctions all(
        {"geometry/ray_offset.h", "geometry/triangle.h"},
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
    return all;
}

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
        functions().evaluate(device, "leave",
                             {floor, from.primitive, from.b1, from.b2, from.x, from.y, from.z,
                              std::vector<std::uint32_t>(from.b1.size(), outward), looks, std::vector<real4>(3)},
                             lanes);
    return {out.get<std::uint32_t>(0), out.get<std::uint32_t>(1)};
}

// The sheet reaches a floor's size beyond it.
constexpr long double SHEET_SIZE = 3;

constexpr std::size_t DEPARTURES = 4000;

// R3: away from the floor at any cosine and through it.
std::vector<CheckResult> check_grazing(const CheckContext& context)
{
    Violations violations;
    for (const long double height : {0.0l, 0.1l, 1.0l, 2.0l, 100.0l}) {
        const auto floor = floor_at(height, 1, 0.4l), far = floor_at(height + 10, 1, 0.4l);
        for (const long double cosine : {1.0l, 0.5l, 1e-1l, 1e-2l, 1e-3l, 1e-4l, 1e-5l, 1e-6l, 1e-7l})
            for (const std::uint32_t outward : {1u, 0u}) {
                violations.set_subject(fmt::format("height {:.3g}, cosine {:.3g}, {}", static_cast<double>(height),
                                                   static_cast<double>(cosine), outward ? "away" : "through"));
                const Departures from = departures(DEPARTURES, outward ? cosine : -cosine);
                const Met met = leave(*context.device, floor, far, from, outward, context.lanes);
                for (const std::uint32_t hits : met.floor) violations.expect(hits == 0, "floor met again");
                if (outward) continue;
                for (const std::uint32_t hits : met.sheet) violations.expect(hits == 0, "sheet above met from below");
            }
    }
    return {violations.result("grazing-self-hits")};
}

// R4: a parallel sheet is seen down to a gap of 1e-5 of the size.
std::vector<CheckResult> check_sheets(const CheckContext& context)
{
    Violations violations;
    for (const long double height : {0.0l, 0.1l, 1.0l})
        for (const long double gap : {1e-1l, 1e-2l, 1e-3l, 1e-4l, 1e-5l})
            for (const long double cosine : {1.0l, 0.5l, 1e-1l, 1e-2l, 1e-3l, 1e-4l, 1e-5l}) {
                // Flatter rays leave beside the sheet.
                if (gap > cosine) continue;
                const auto floor = floor_at(height, 1, 0.4l), sheet = floor_at(height + gap, SHEET_SIZE, 0.4l);
                violations.set_subject(fmt::format("height {:.3g}, gap {:.3g}, cosine {:.3g}",
                                                   static_cast<double>(height), static_cast<double>(gap),
                                                   static_cast<double>(cosine)));
                const Departures from = departures(DEPARTURES, cosine);
                for (const std::uint32_t hits : leave(*context.device, floor, sheet, from, 1, context.lanes).sheet)
                    violations.expect(hits > 0, "sheet missed");
            }
    return {violations.result("parallel-sheets")};
}
} // namespace

std::vector<Check> offset_checks()
{
    return {make_check("bvh", "grazing-self-hits", check_grazing), make_check("bvh", "parallel-sheets", check_sheets)};
}
} // namespace etendue
