/* All lights of the scene: choose one, sample it; what a ray that meets one sees, and how likely it was sampled. */
#pragma once
#include "light/area.h"
#include "light/environment.h"
#include "sampling/distribution.h"

/* Emission of the light that a ray has met, and its density under light_sample from the ray's origin. */
typedef struct LightHit {
    Color radiance;
    Float pdf; /* per solid angle, the choice of the light included */
} LightHit;

/* Choose a light by the alias table and a point on it, seen from a point. Lanes without a sample get pdf = 0. */
STATIC LightSample light_sample(SceneView view, Mask active, Vec3 from, RandomBlock random)
{
    /* Choose. */
    Uint light = alias_sample(view.light_table, view.settings->alias_shift, random.x, random.y, active);
    Color radiance;
    Float probability;
    gather_real4(view.lights[i].radiance, light, active, &radiance.x, &radiance.y, &radiance.z, &probability);
    Uint type, primitive, flags, unused;
    gather_members(view.lights[i], light, active, type, &type, primitive, &primitive, flags, &flags, padding, &unused);
    Float u = uniform_float(random.z), v = uniform_float(random.w);
    /* Sample its kind. */
    LightSample sample = environment_light_sample(radiance, u, v);
    sample.pdf = (Float)(0.0);
    if (HAS_AREA) {
        Mask mine = active & (type == LIGHT_AREA);
        if (any_of(mine)) {
            AreaPoint point = area_light_sample(view, primitive, mine, from, u, v);
            Vec3 wi = normalize3(point.to_point);
            Mask lit = mine & (((flags & LIGHT_TWO_SIDED) != 0u) | (dot3(point.normal, wi) < 0.0));
            sample.wi = choose3(mine, wi, sample.wi);
            sample.to_light = choose3(mine, point.to_point, sample.to_light);
            sample.t_max = mine ? (Float)(1.0) : sample.t_max;
            sample.primitive = mine ? primitive : sample.primitive;
            sample.pdf = lit ? point.pdf : sample.pdf;
        }
    }
    if (HAS_ENVIRONMENT) {
        Mask mine = active & (type == LIGHT_ENVIRONMENT);
        sample.pdf = mine ? environment_light_pdf() : sample.pdf;
    }
    sample.pdf = active ? sample.pdf * probability : (Float)(0.0);
    return sample;
}

/* What the active lanes' rays see of the surface they have hit: emission to the side of wo, or 0. */
STATIC LightHit light_hit(SceneView view, Surface surface, Mask active, Ray ray, Hit hit)
{
    LightHit result = {black(), (Float)(0.0)};
    Mask emits = active & (surface.light != NO_INDEX);
    if (HAS_AREA && any_of(emits)) {
        Color radiance;
        Float probability;
        gather_real4(view.lights[i].radiance, surface.light, emits, &radiance.x, &radiance.y, &radiance.z,
                     &probability);
        Uint flags, unused0, unused1, unused2;
        gather_members(view.lights[i], surface.light, emits, type, &unused0, primitive, &unused1, flags, &flags,
                       padding, &unused2);
        Mask lit = emits & (((flags & LIGHT_TWO_SIDED) != 0u) | (dot3(surface.ng, surface.wo) > 0.0));
        result.radiance = choose3(lit, radiance, black());
        result.pdf = lit ? probability * area_light_pdf(view, surface, emits, ray, hit) : (Float)(0.0);
    }
    return result;
}

/* What rays that leave the scene see. */
STATIC LightHit light_escape(SceneView view)
{
    LightHit result = {black(), (Float)(0.0)};
    uint environment = view.settings->environment_light;
    if (HAS_ENVIRONMENT && environment != NO_INDEX) {
        real4 radiance = view.lights[environment].radiance;
        result.radiance = broadcast3(radiance);
        result.pdf = (Float)(radiance.w) * environment_light_pdf();
    }
    return result;
}
