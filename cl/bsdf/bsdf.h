/* Evaluate, pdf and sample of whatever material each lane has met. Directions in the local frame, away from the
 * surface. */
#pragma once
#include "bsdf/all.h"
#include "shared/scene_view.h"

typedef struct MaterialLanes {
    Uint type, flags, first_parameter;
} MaterialLanes;

STATIC MaterialLanes load_material(SceneView view, Uint material, Mask active)
{
    MaterialLanes m;
    Uint unused;
    gather_members(view.materials[i], material, active, type, &m.type, flags, &m.flags, first_parameter,
                   &m.first_parameter, padding, &unused);
    return m;
}

/* Each of the five asks every kind that is compiled in and that some active lane has met. Lanes of a Mask `mine` take
 * what their kind answers. */
#define BSDF_MINE(NAME) (active & (m.type == BSDF_##NAME))
#define BSDF_PARAMETERS(name) name##_load(view.parameters, m.first_parameter, mine)

/* f, without the cosine; 0 for delta lobes. */
STATIC Color bsdf_evaluate(SceneView view, MaterialLanes m, Mask active, Vec3 wo, Vec3 wi)
{
    Color f = black();
#define BSDF_EVALUATE(NAME, name, text)                                                                                \
    if (HAS_##NAME) {                                                                                                  \
        Mask mine = BSDF_MINE(NAME);                                                                                   \
        if (any_of(mine)) f = choose3(mine, name##_evaluate(BSDF_PARAMETERS(name), wo, wi), f);                        \
    }
    BSDF_LIST(BSDF_EVALUATE)
    return f;
}

/* Density of bsdf_sample per solid angle; 0 for delta lobes. */
STATIC Float bsdf_pdf(SceneView view, MaterialLanes m, Mask active, Vec3 wo, Vec3 wi)
{
    Float pdf = (Float)(0.0);
#define BSDF_PDF(NAME, name, text)                                                                                     \
    if (HAS_##NAME) {                                                                                                  \
        Mask mine = BSDF_MINE(NAME);                                                                                   \
        if (any_of(mine)) pdf = mine ? name##_pdf(BSDF_PARAMETERS(name), wo, wi) : pdf;                                \
    }
    BSDF_LIST(BSDF_PDF)
    return pdf;
}

STATIC BsdfSample bsdf_sample(SceneView view, MaterialLanes m, Mask active, Vec3 wo, RandomBlock random)
{
    BsdfSample sample = no_bsdf_sample();
#define BSDF_SAMPLE(NAME, name, text)                                                                                  \
    if (HAS_##NAME) {                                                                                                  \
        Mask mine = BSDF_MINE(NAME);                                                                                   \
        if (any_of(mine)) sample = choose_bsdf_sample(mine, name##_sample(BSDF_PARAMETERS(name), wo, random), sample); \
    }
    BSDF_LIST(BSDF_SAMPLE)
    return sample;
}

/* The random numbers of which bsdf_sample makes wi. Checks call it in double precision. */
STATIC BsdfInverse bsdf_invert(SceneView view, MaterialLanes m, Mask active, Vec3 wo, Vec3 wi)
{
    BsdfInverse inverse = no_bsdf_inverse();
#define BSDF_INVERT(NAME, name, text)                                                                                  \
    if (HAS_##NAME) {                                                                                                  \
        Mask mine = BSDF_MINE(NAME);                                                                                   \
        if (any_of(mine)) {                                                                                            \
            BsdfInverse answer = name##_invert(BSDF_PARAMETERS(name), wo, wi);                                         \
            inverse.u = mine ? answer.u : inverse.u;                                                                   \
            inverse.v = mine ? answer.v : inverse.v;                                                                   \
        }                                                                                                              \
    }
    BSDF_LIST(BSDF_INVERT)
    return inverse;
}

/* Colour for a denoiser: what the surface reflects of white light from everywhere, roughly. */
STATIC Color bsdf_albedo(SceneView view, MaterialLanes m, Mask active)
{
    Color albedo = black();
#define BSDF_ALBEDO(NAME, name, text)                                                                                  \
    if (HAS_##NAME) {                                                                                                  \
        Mask mine = BSDF_MINE(NAME);                                                                                   \
        if (any_of(mine)) albedo = choose3(mine, name##_albedo(BSDF_PARAMETERS(name)), albedo);                        \
    }
    BSDF_LIST(BSDF_ALBEDO)
    return albedo;
}
