/* Every tolerance, rounding step and "almost zero" of the kernels, with its name and derivation. */
#pragma once
#include "math/lanes.h"

/* u: half the distance from 1 to the next number; one rounding errs by at most u relatively. */
#if REAL_IS_DOUBLE
#define UNIT_ROUNDOFF 0x1p-53
#define INFINITE ((real)INFINITY)
#else
#define UNIT_ROUNDOFF 0x1p-24
#define INFINITE INFINITY
#endif

/* Bound of the relative error of n roundings in a row (Higham 2002, lemma 3.1). */
#define GAMMA(n) ((n)*UNIT_ROUNDOFF / (1.0 - (n)*UNIT_ROUNDOFF))

/* A point of a triangle from barycentrics takes 7 roundings; as a bound for the distance that an origin is moved along
 * the normal, the largest axis counts (moving by the bound of each axis alone self-hits on floors near y = 0). */
#define TRIANGLE_POINT_ERROR GAMMA(7)

/* A point of a sphere or disk is projected onto it: normalise (4 roundings), scale and add the centre (2), and the
 * same again where the far side of a chord is met. */
#define CURVED_POINT_ERROR GAMMA(12)

/* The far distance of a slab is enlarged so that the three roundings of each distance cannot lose a hit (Ize 2013). */
#define SLAB_FAR_FACTOR (1.0 + 2.0 * GAMMA(3))

/* A box is enlarged by this times the largest |coordinate| of the ray's origin, since the triangle test rounds (vertex
 * - origin): four roundings across the ray and about eight along it. With the padding of the box itself
 * (bvh/primitive_box.h) the tree then finds, bit for bit, what testing every triangle finds. */
#define RAY_BOX_PADDING GAMMA(12)

/* Survival below 1/64 trades a little work for weights that no one wants to average. */
#define MIN_SURVIVAL 0.015625

/* A cosine below this is no direction along a surface that floats can tell from the surface itself. */
#define MIN_COSINE 0x1p-60

STATIC Float min_of(Float a, Float b)
{
    return a < b ? a : b;
}
STATIC Float max_of(Float a, Float b)
{
    return a > b ? a : b;
}
STATIC Float square(Float x)
{
    return x * x;
}

#if REAL_IS_DOUBLE
STATIC Float abs_of(Float x)
{
    return fabs(x);
}
STATIC Float copy_sign(Float magnitude, Float sign_of)
{
    return copysign(magnitude, sign_of);
}
#else
STATIC Float abs_of(Float x)
{
    return from_bits(uint_bits(x) & 0x7fffffffu);
}
STATIC Float copy_sign(Float magnitude, Float sign_of)
{
    return from_bits((uint_bits(magnitude) & 0x7fffffffu) | (uint_bits(sign_of) & 0x80000000u));
}
#endif

/* Ask the bits: compilers may assume that no comparison meets a NaN. */
STATIC Mask is_finite(Float x)
{
#if REAL_IS_DOUBLE
    return (ulong_bits(x) & 0x7ffffffffffffffful) < 0x7ff0000000000000ul;
#else
    return (uint_bits(x) & 0x7fffffffu) < 0x7f800000u;
#endif
}

/* sqrt of what is zero or more but for rounding */
STATIC Float sqrt_of(Float x)
{
    return sqrt(x < 0.0 ? (Float)(0.0) : x);
}

/* a b - c d with the right sign and an error below 1.5 ulp (Kahan; Jeannerod, Louvet, Muller 2013). */
STATIC Float difference_of_products(Float a, Float b, Float c, Float d)
{
    Float cd = c * d;
    Float error = fma(-c, d, cd);
    return fma(a, b, -cd) + error;
}

/* a + b = sum + error, exactly (Knuth). */
STATIC Float two_sum(Float a, Float b, Float* error)
{
    Float sum = a + b;
    Float b_part = sum - a;
    *error = (a - (sum - b_part)) + (b - b_part);
    return sum;
}
