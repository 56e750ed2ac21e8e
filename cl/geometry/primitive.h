/* One primitive against the rays of a pack. */
#pragma once
#include "geometry/disk.h"
#include "geometry/sphere.h"
#include "geometry/triangle.h"

/* What is computed once per ray. */
typedef struct PreparedRay {
    Ray ray;
    RayShear shear;
} PreparedRay;

STATIC PreparedRay prepare_ray(Ray ray)
{
    PreparedRay prepared;
    prepared.ray = ray;
    prepared.shear = make_ray_shear(ray.direction);
    return prepared;
}

/* Candidate hit of the active lanes; rays skip the primitive they start on (but spheres, which can be met again) and
 * the one they go to. */
STATIC Mask primitive_hit(Primitive primitive, uint id, Mask active, PreparedRay prepared, Float* t, Float* b1,
                          Float* b2)
{
    Ray ray = prepared.ray;
    Mask on_it = ray.from == (Uint)(id);
    Mask candidate = active & (ray.to != (Uint)(id));
    if (HAS_SPHERE && primitive.a.w == PRIMITIVE_SPHERE) {
        *b1 = *b2 = (Float)(0.0);
        return candidate & sphere_hit(primitive, ray.origin, ray.direction, on_it, t);
    }
    candidate &= not(on_it);
    if (HAS_DISK && primitive.a.w == PRIMITIVE_DISK) {
        *b1 = *b2 = (Float)(0.0);
        return candidate & disk_hit(primitive, ray.origin, ray.direction, t);
    }
    return candidate & triangle_hit(primitive, ray.origin, prepared.shear, t, b1, b2);
}
