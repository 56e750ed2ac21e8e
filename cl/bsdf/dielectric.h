/* Smooth boundary between air (outside, the side of the normal) and glass: reflects or refracts into one direction. */
#pragma once
#include "bsdf/fresnel.h"
#include "bsdf/sample.h"

typedef struct DielectricParameters {
    Float ior;  /* index of the inside over that of the outside */
    Color tint; /* multiplies both lobes */
} DielectricParameters;

STATIC DielectricParameters dielectric_load(global const real* parameters, Uint first, Mask active)
{
    DielectricParameters p = {gather_real(parameters, first, active), load_color(parameters, first + 1u, active)};
    return p;
}

STATIC Color dielectric_albedo(DielectricParameters p)
{
    return p.tint;
}

/* Delta lobes have no value that a light sample could use. */
STATIC Color dielectric_evaluate(DielectricParameters p, Vec3 wo, Vec3 wi)
{
    return black();
}
STATIC Float dielectric_pdf(DielectricParameters p, Vec3 wo, Vec3 wi)
{
    return (Float)(0.0);
}
STATIC BsdfInverse dielectric_invert(DielectricParameters p, Vec3 wo, Vec3 wi)
{
    return no_bsdf_inverse();
}

/* Choose reflection with probability R, by an integer threshold; the weight is f |cos| / probability: the tint, but for
 * what the integer cannot hold. Radiance is scaled by 1 / eta^2 on refraction (Veach 1997, section 5.2). */
STATIC BsdfSample dielectric_sample(DielectricParameters p, Vec3 wo, RandomBlock random)
{
    /* Face the normal towards wo. */
    Float side = copy_sign((Float)(1.0), wo.z);
    Float cos_i = abs_of(wo.z);
    Float eta = wo.z > 0.0 ? p.ior : 1.0 / p.ior;
    Float eta_cos_t;
    Float reflectance = fresnel_dielectric(cos_i, eta, &eta_cos_t);
    /* Choose a lobe. */
    Mask total = reflectance >= 1.0;
    Uint threshold = to_uint(total ? (Float)(0.0) : reflectance * 0x1p32);
    Float probability = total ? (Float)(1.0) : to_float(threshold) * 0x1p-32;
    Mask reflect = total | below_threshold(random.z, threshold);
    /* Follow it: mirror, or Snell's law with the tangential part divided by eta. */
    Vec3 mirrored = vec3(-wo.x, -wo.y, wo.z);
    Vec3 refracted = vec3(-wo.x / eta, -wo.y / eta, -side * (eta_cos_t / eta));
    Float scale = 1.0 / square(eta);
    BsdfSample sample = no_bsdf_sample();
    sample.wi = choose3(reflect, mirrored, refracted);
    Float weight = reflect ? reflectance / probability : (1.0 - reflectance) / (1.0 - probability) * scale;
    sample.weight = scale3(p.tint, weight);
    sample.radiance_scale = reflect ? (Float)(1.0) : scale;
    sample.pdf = wo.z != 0.0 ? (Float)(1.0) : (Float)(0.0);
    sample.delta = to_mask(true);
    return sample;
}
