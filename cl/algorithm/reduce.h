/* Boxes, and the box around many boxes. A stored box is two float4: lower, upper; w is the owner's. */
#pragma once
#include "math/lanes.h"
#pragma OPENCL FP_CONTRACT OFF

typedef struct Aabb {
    float4 lower;
    float4 upper;
} Aabb;

/* The box of nothing: it changes no union. */
STATIC Aabb aabb_empty(void)
{
    Aabb box;
    box.lower = (float4)(INFINITY);
    box.upper = (float4)(-INFINITY);
    return box;
}

/* The box around two. Comparisons, not fmin: their result for zeros of both signs is the same on every device. */
STATIC Aabb aabb_union(Aabb a, Aabb b)
{
    Aabb box;
    box.lower = b.lower < a.lower ? b.lower : a.lower;
    box.upper = a.upper < b.upper ? b.upper : a.upper;
    return box;
}

/* The centre; an exact half of each corner, so that nothing overflows. */
STATIC float4 aabb_centre(Aabb box)
{
    const float half_weight = 0.5;
    return half_weight * box.lower + half_weight * box.upper;
}

/* Half the surface area; 0 for the box of nothing. fma, so that no device rounds differently. */
STATIC float aabb_half_area(Aabb box)
{
    const float4 d = box.upper - box.lower;
    return box.lower.x > box.upper.x ? 0.0 : fma(d.x, d.y, fma(d.y, d.z, d.z * d.x));
}

/* The box around the stored boxes [first, end). */
STATIC Aabb reduce_boxes(global const float4* boxes, uint first, uint end)
{
    Aabb sum = aabb_empty();
    for (uint i = first; i < end; ++i) {
        Aabb box;
        box.lower = boxes[2 * i];
        box.upper = boxes[2 * i + 1];
        sum = aabb_union(sum, box);
    }
    return sum;
}
