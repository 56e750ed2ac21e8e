// Structs between float and double.
#include "render/precision.h"

#include "math/rounding.h"

#include <cstddef>
#include <cstring>

namespace etendue
{
namespace
{
real4 narrow4(const fp64::real4& v)
{
    return make_real4(v.s[0], v.s[1], v.s[2], v.s[3]);
}

// The whole numbers of the settings lie in one piece behind the camera.
constexpr std::size_t NUMBERS = offsetof(RenderSettings, filter_parameters) - offsetof(RenderSettings, width);
static_assert(offsetof(fp64::RenderSettings, width) == 2 * offsetof(RenderSettings, width));
static_assert(offsetof(fp64::RenderSettings, filter_parameters) >= offsetof(fp64::RenderSettings, width) + NUMBERS);
// Whoever adds a real4 converts it below.
static_assert(sizeof(Camera) == 4 * sizeof(real4));
static_assert(sizeof(RenderSettings) == sizeof(Camera) + NUMBERS + 3 * sizeof(real4));
static_assert(sizeof(BvhNode) == 4 * sizeof(real4));
static_assert(sizeof(Primitive) == 3 * sizeof(real4));
static_assert(sizeof(Light) == 2 * sizeof(real4));
static_assert(sizeof(PixelBlock) == 3 * sizeof(real4));
static_assert(sizeof(PixelAov) == 2 * sizeof(real4));
static_assert(sizeof(PathVertex) == 8 * sizeof(real4) + 8 * sizeof(uint));
} // namespace

fp64::real widen(real x)
{
    return x;
}

fp64::real4 widen(const real4& v)
{
    return {{v.s[0], v.s[1], v.s[2], v.s[3]}};
}

fp64::RenderSettings widen(const RenderSettings& s)
{
    fp64::RenderSettings wide{};
    wide.camera = {widen(s.camera.position), widen(s.camera.forward), widen(s.camera.right), widen(s.camera.up)};
    std::memcpy(reinterpret_cast<char*>(&wide) + offsetof(fp64::RenderSettings, width),
                reinterpret_cast<const char*>(&s) + offsetof(RenderSettings, width), NUMBERS);
    wide.filter_parameters = widen(s.filter_parameters);
    wide.roulette_parameters = widen(s.roulette_parameters);
    wide.scene_bounds = widen(s.scene_bounds);
    return wide;
}

fp64::BvhNode widen(const BvhNode& node)
{
    return {widen(node.x), widen(node.y), widen(node.z), node.child};
}

fp64::Primitive widen(const Primitive& primitive)
{
    return {widen(primitive.a), widen(primitive.b), widen(primitive.c)};
}

fp64::Light widen(const Light& light)
{
    return {light.type, light.primitive, light.flags, light.padding, widen(light.radiance)};
}

fp64::PixelBlock widen(const PixelBlock& block)
{
    // A float sum and what it lost are one double.
    fp64::PixelBlock wide{widen(block.sum), {}, widen(block.m2)};
    for (int c = 0; c < 3; ++c) wide.sum.s[c] -= static_cast<double>(block.compensation.s[c]);
    return wide;
}

fp64::PixelAov widen(const PixelAov& aov)
{
    return {widen(aov.albedo), widen(aov.normal)};
}

fp64::PathVertex widen(const PathVertex& v)
{
    return {widen(v.position),
            widen(v.geometric_normal),
            widen(v.shading_normal),
            widen(v.direction),
            widen(v.throughput),
            widen(v.emission),
            widen(v.radiance),
            widen(v.light_pdfs),
            v.primitive,
            v.material,
            v.bsdf,
            v.light,
            v.delta,
            v.inside,
            v.goes_on,
            v.accident};
}

PixelBlock narrow(const fp64::PixelBlock& block)
{
    const auto sum = [&](int c) { return block.sum.s[c] - block.compensation.s[c]; };
    const auto lost = [&](int c) { return rounded_to_float(sum(c)) - sum(c); };
    return {make_real4(sum(0), sum(1), sum(2), block.sum.s[3]), make_real4(lost(0), lost(1), lost(2)),
            narrow4(block.m2)};
}

PixelAov narrow(const fp64::PixelAov& aov)
{
    return {narrow4(aov.albedo), narrow4(aov.normal)};
}
} // namespace etendue
