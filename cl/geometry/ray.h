/* Rays and hits in lanes. */
#pragma once
#include "math/vector.h"
#include "shared/limits.h"

/* The direction need not be unit: t counts in its lengths. Closest hits have 0 < t <= t_max; what blocks has
 * 0 < t < t_max. */
typedef struct Ray {
    Vec3 origin;
    Vec3 direction;
    Float t_max;
    Uint from; /* primitive on which the origin lies, or NO_INDEX */
    Uint to;   /* primitive that cannot block (a shadow ray's target), or NO_INDEX */
} Ray;

/* Closest hit so far. Barycentrics of the second and third vertex, triangles only. */
typedef struct Hit {
    Float t;
    Uint primitive; /* NO_INDEX: nothing */
    Float b1, b2;
} Hit;

STATIC Hit no_hit(Float t_max)
{
    Hit hit = {t_max, (Uint)(NO_INDEX), (Float)(0.0), (Float)(0.0)};
    return hit;
}

/* A ray that can be traced: everything finite, t_max not NaN, and a direction. */
STATIC Mask is_valid_ray(Ray ray)
{
    Float longest = max_component(abs3(ray.direction));
    return is_finite3(ray.origin) & is_finite3(ray.direction) & (longest > 0.0) & (ray.t_max >= 0.0);
}

/* Every candidate passes here: a nearer one is taken, and of equal ones that of the lowest primitive; an
 * infinite distance (from determinants that underflow) is no hit. */
STATIC Mask hit_accept(Hit hit, Float t, Uint primitive)
{
    return (t > 0.0) & (t < (Float)(INFINITE)) & ((t < hit.t) | ((t == hit.t) & (primitive < hit.primitive)));
}
STATIC void hit_update(Hit* hit, Mask accepted, Float t, Uint primitive, Float b1, Float b2)
{
    hit->t = accepted ? t : hit->t;
    hit->primitive = accepted ? primitive : hit->primitive;
    hit->b1 = accepted ? b1 : hit->b1;
    hit->b2 = accepted ? b2 : hit->b2;
}
