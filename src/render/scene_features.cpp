// Features by looking at what is there.
#include "render/scene_features.h"

#include "util/error.h"

#include <fmt/format.h>

namespace etendue
{
namespace
{
void set_bsdf(Specialization& s, uint type)
{
#define SET_BSDF_FEATURE(NAME, name, text)                                                                             \
    if (type == BSDF_##NAME) s.set(Feature::NAME);
    BSDF_LIST(SET_BSDF_FEATURE)
#undef SET_BSDF_FEATURE
}

void set_light(Specialization& s, uint type)
{
#define SET_LIGHT_FEATURE(NAME, name, text)                                                                            \
    if (type == LIGHT_##NAME) s.set(Feature::NAME);
    LIGHT_LIST(SET_LIGHT_FEATURE)
#undef SET_LIGHT_FEATURE
}

void set_sampler(Specialization& s, uint number)
{
#define SET_SAMPLER_FEATURE(NAME, name, text)                                                                          \
    if (number == SAMPLER_##NAME) s.set(Feature::NAME);
    SAMPLER_LIST(SET_SAMPLER_FEATURE)
#undef SET_SAMPLER_FEATURE
}
} // namespace

std::uint32_t stack_class(std::uint32_t depth)
{
    for (const std::uint32_t size : {32u, 64u, 128u})
        if (depth <= size) return size;
    throw DeviceError(fmt::format("The tree is {} nodes deep, and a traversal stack holds 128 at most.", depth));
}

Specialization scene_features(const Scene& scene, const Geometry& geometry, const RenderSettings& settings,
                              bool has_aov, std::uint32_t lanes, std::uint32_t bvh_depth)
{
    Specialization s;
    s.lanes = lanes;
    s.stack_size = stack_class(bvh_depth);
    // Materials count where a primitive has them.
    for (const PrimitiveSurface& surface : geometry.surfaces) set_bsdf(s, geometry.materials[surface.material].type);
    for (const Light& light : geometry.lights) set_light(s, light.type);
    s.set(Feature::SPHERE, geometry.sphere_count > 0);
    s.set(Feature::DISK, geometry.disk_count > 0);
    s.set(Feature::PINHOLE);
    s.set(settings.accelerator == ACCELERATOR_LBVH ? Feature::LBVH : Feature::BRUTE_FORCE);
    set_sampler(s, settings.sampler);
    s.set(Feature::VERTEX_NORMALS, !geometry.normals.empty());
    s.set(Feature::LIGHT_SAMPLING, settings.sample_lights != 0);
    s.set(Feature::EMISSION_SAMPLING, settings.count_emission != 0 && !geometry.lights.empty());
    s.set(Feature::UNIFORM_HEMISPHERE, settings.uniform_hemisphere != 0);
    s.set(Feature::BALANCE_HEURISTIC, settings.balance_heuristic != 0);
    s.set(Feature::SPHERE_AREA, settings.sphere_area != 0);
    s.set(Feature::ROULETTE, settings.roulette != ROULETTE_OFF);
    s.set(Feature::FILTER, scene.film.filter != FilterType::box);
    s.set(Feature::AOV, has_aov);
    return s;
}

Specialization film_features(bool has_aov, Precision precision)
{
    Specialization s;
    s.precision = precision;
    s.set(Feature::AOV, has_aov);
    return s;
}
} // namespace etendue
