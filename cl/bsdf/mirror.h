/* Perfect mirror on both sides: all light from the mirrored direction, times a colour. */
#pragma once
#include "bsdf/sample.h"

typedef struct MirrorParameters {
    Color reflectance;
} MirrorParameters;

STATIC MirrorParameters mirror_load(global const real* parameters, Uint first, Mask active)
{
    MirrorParameters p = {load_color(parameters, first, active)};
    return p;
}

STATIC Color mirror_albedo(MirrorParameters p)
{
    return p.reflectance;
}

/* A delta lobe has no value that a light sample could use. */
STATIC Color mirror_evaluate(MirrorParameters p, Vec3 wo, Vec3 wi)
{
    return black();
}
STATIC Float mirror_pdf(MirrorParameters p, Vec3 wo, Vec3 wi)
{
    return (Float)(0.0);
}
STATIC BsdfInverse mirror_invert(MirrorParameters p, Vec3 wo, Vec3 wi)
{
    return no_bsdf_inverse();
}

STATIC BsdfSample mirror_sample(MirrorParameters p, Vec3 wo, RandomBlock random)
{
    BsdfSample sample = no_bsdf_sample();
    sample.wi = vec3(-wo.x, -wo.y, wo.z);
    sample.weight = p.reflectance;
    sample.pdf = wo.z != 0.0 ? (Float)(1.0) : (Float)(0.0);
    sample.delta = to_mask(true);
    return sample;
}
