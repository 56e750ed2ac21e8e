/* What sampling a BSDF gives. */
#pragma once
#include "math/frame.h"
#include "sampling/random.h"

/* Directions in the local frame. pdf = 0: nothing was sampled, the path ends. */
typedef struct BsdfSample {
    Vec3 wi;
    Color weight; /* f |cos| / pdf, the choice of the lobe included */
    Float pdf;    /* per solid angle; 1 for a delta lobe */
    Mask delta;   /* a single direction: light sampling cannot reach it */
    Float
        radiance_scale; /* part of the weight that undoes itself when the path leaves again: 1 / eta^2 on refraction */
} BsdfSample;

STATIC BsdfSample no_bsdf_sample(void)
{
    BsdfSample sample = {vec3((Float)(0.0), (Float)(0.0), (Float)(1.0)), black(), (Float)(0.0), to_mask(false),
                         (Float)(1.0)};
    return sample;
}
STATIC BsdfSample choose_bsdf_sample(Mask m, BsdfSample a, BsdfSample b)
{
    BsdfSample sample;
    sample.wi = choose3(m, a.wi, b.wi);
    sample.weight = choose3(m, a.weight, b.weight);
    sample.pdf = m ? a.pdf : b.pdf;
    sample.delta = (m & a.delta) | (not(m) & b.delta);
    sample.radiance_scale = m ? a.radiance_scale : b.radiance_scale;
    return sample;
}

/* The random numbers u and v of which sampling makes a direction. */
typedef struct BsdfInverse {
    Float u, v; /* -1: none, the density there is 0 or the lobe a delta */
} BsdfInverse;

STATIC BsdfInverse no_bsdf_inverse(void)
{
    BsdfInverse inverse = {(Float)(-1.0), (Float)(-1.0)};
    return inverse;
}

/* A colour from three parameters. */
STATIC Color load_color(global const real* parameters, Uint first, Mask active)
{
    return vec3(gather_real(parameters, first, active), gather_real(parameters, first + 1u, active),
                gather_real(parameters, first + 2u, active));
}
