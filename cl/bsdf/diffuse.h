/* Lambert: f = albedo / pi on both sides of the surface; no transmission. */
#pragma once
#include "bsdf/sample.h"
#include "sampling/warp.h"

typedef struct DiffuseParameters {
    Color albedo;
} DiffuseParameters;

STATIC DiffuseParameters diffuse_load(global const real* parameters, Uint first, Mask active)
{
    DiffuseParameters p = {load_color(parameters, first, active)};
    return p;
}

STATIC Color diffuse_albedo(DiffuseParameters p)
{
    return p.albedo;
}

/* f, without the cosine. */
STATIC Color diffuse_evaluate(DiffuseParameters p, Vec3 wo, Vec3 wi)
{
    return choose3(same_hemisphere(wo, wi), scale3(p.albedo, (Float)(INV_PI)), black());
}

/* Density of diffuse_sample per solid angle. */
STATIC Float diffuse_pdf(DiffuseParameters p, Vec3 wo, Vec3 wi)
{
    return same_hemisphere(wo, wi) ? abs_of(wi.z) * INV_PI : (Float)(0.0);
}

STATIC BsdfInverse diffuse_invert(DiffuseParameters p, Vec3 wo, Vec3 wi)
{
    BsdfInverse inverse;
    cosine_hemisphere_invert(wi, &inverse.u, &inverse.v);
    Mask sampled = same_hemisphere(wo, wi);
    inverse.u = sampled ? inverse.u : (Float)(-1.0);
    inverse.v = sampled ? inverse.v : (Float)(-1.0);
    return inverse;
}

STATIC BsdfSample diffuse_sample(DiffuseParameters p, Vec3 wo, RandomBlock random)
{
    Vec3 up = cosine_hemisphere_sample(uniform_float(random.x), uniform_float(random.y));
    BsdfSample sample = no_bsdf_sample();
    sample.wi = vec3(up.x, up.y, copy_sign(up.z, wo.z));
    sample.weight = p.albedo;
    sample.pdf = wo.z != 0.0 ? up.z * INV_PI : (Float)(0.0);
    return sample;
}
