/* The padded box of one primitive. */
#pragma once
#include "algorithm/reduce.h"
#include "shared/primitive.h"

/* How far a box is pushed outwards, in units in the last place of its largest |coordinate|.
 *
 * Triangles: the vertices are exact, but the ray test rounds them: it shears (vertex - origin), so that the triangle it
 * sees lies up to 4 u (|vertex| + |origin|) beside the true one, and its distance a few u more. The tree must enter
 * every box whose triangle the test would accept, so the part of the vertex is added here: 8 units, at least 8 u of the
 * largest |coordinate|. The part of the origin is added by the traversal, see RAY_BOX_PADDING in math/numerics.h.
 *
 * Spheres and disks: centre +- radius rounds (1/2 unit), and their ray tests round |centre - origin| (a few units of
 * the distance, which in normalised coordinates is about 1): the unit is therefore that of the largest |coordinate| or
 * of 1, whichever is more, and there are 8 of them. */
#define TRIANGLE_BOX_PADDING 8.0
#define ANALYTIC_BOX_PADDING 8.0

/* PRIMITIVE_*, whatever number is stored. */
STATIC uint primitive_kind(Primitive primitive)
{
    if (primitive.a.w == PRIMITIVE_TRIANGLE) return PRIMITIVE_TRIANGLE;
    return primitive.a.w == PRIMITIVE_SPHERE ? PRIMITIVE_SPHERE : PRIMITIVE_DISK;
}

/* The bits of |x|: as an integer they order as the numbers do, non-finite ones last (NON_FINITE_BITS and up). */
STATIC uint magnitude_bits(float x)
{
    return as_uint(x) & 0x7fffffffu;
}
#define NON_FINITE_BITS 0x7f800000u

/* The largest magnitude_bits of x, y, z. */
STATIC uint largest_magnitude_bits(float4 v)
{
    return max(max(magnitude_bits(v.x), magnitude_bits(v.y)), magnitude_bits(v.z));
}

/* One unit in the last place of a finite number with these bits: exponent 23 lower, at least the least normal number.
 */
STATIC float ulp_from_bits(uint bits)
{
    return as_float((max(bits >> 23, 24u) - 23u) << 23);
}

/* The box, padded; aabb_empty() when anything in it is not finite. w = 0. */
STATIC Aabb primitive_box(Primitive primitive)
{
    Aabb box;
    uint largest;
    float padding;
    const uint kind = primitive_kind(primitive);
    if (kind == PRIMITIVE_TRIANGLE) {
        const Aabb corner_a = {primitive.a, primitive.a};
        const Aabb corner_b = {primitive.b, primitive.b};
        const Aabb corner_c = {primitive.c, primitive.c};
        box = aabb_union(aabb_union(corner_a, corner_b), corner_c);
        largest = max(max(largest_magnitude_bits(primitive.a), largest_magnitude_bits(primitive.b)),
                      largest_magnitude_bits(primitive.c));
        padding = TRIANGLE_BOX_PADDING * ulp_from_bits(min(largest, NON_FINITE_BITS));
    } else {
        /* A disk lies in the sphere around it. */
        const float radius = fabs(kind == PRIMITIVE_SPHERE ? primitive.b.x : primitive.c.x);
        box.lower = primitive.a - radius;
        box.upper = primitive.a + radius;
        largest = max(largest_magnitude_bits(box.lower), largest_magnitude_bits(box.upper));
        padding = ANALYTIC_BOX_PADDING * ulp_from_bits(max(min(largest, NON_FINITE_BITS), magnitude_bits(1.0)));
    }
    box.lower -= padding;
    box.upper += padding;

    /* Padding may overflow, so look again. */
    largest = max(largest, max(largest_magnitude_bits(box.lower), largest_magnitude_bits(box.upper)));
    if (largest >= NON_FINITE_BITS) box = aabb_empty();
    box.lower.w = 0.0;
    box.upper.w = 0.0;
    return box;
}
