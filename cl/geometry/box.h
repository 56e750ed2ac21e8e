/* Ray against axis-aligned box (slabs; Kay and Kajiya 1986). */
#pragma once
#include "geometry/ray.h"

/* What is computed once per ray. The padding of the box that stands for the origin's roundings is moved into two
 * origins: lower - (origin + padding) = (lower - padding) - origin. */
typedef struct BoxRay {
    Vec3 origin_lower, origin_upper;
    Vec3 inverse; /* 1 / direction, with infinities */
} BoxRay;

STATIC BoxRay make_box_ray(Ray ray)
{
    Float padding = RAY_BOX_PADDING * max_component(abs3(ray.origin));
    Vec3 padding3 = vec3(padding, padding, padding);
    BoxRay box_ray;
    box_ray.origin_lower = add3(ray.origin, padding3);
    box_ray.origin_upper = sub3(ray.origin, padding3);
    box_ray.inverse = vec3(1.0 / ray.direction.x, 1.0 / ray.direction.y, 1.0 / ray.direction.z);
    return box_ray;
}

/* Where the ray enters a padded box before t_max. A ray within a face plane gives 0 * inf = NaN on one side: min_of and
 * max_of then keep the other side, and padding made that the right one. */
STATIC Mask box_hit(real lower_x, real upper_x, real lower_y, real upper_y, real lower_z, real upper_z, BoxRay ray,
                    Float t_max, Float* t_enter)
{
    Vec3 l = ray.origin_lower, u = ray.origin_upper, inverse = ray.inverse;
    Float ax = (lower_x - l.x) * inverse.x, bx = (upper_x - u.x) * inverse.x;
    Float ay = (lower_y - l.y) * inverse.y, by = (upper_y - u.y) * inverse.y;
    Float az = (lower_z - l.z) * inverse.z, bz = (upper_z - u.z) * inverse.z;
    Float enter = max_of(max_of(min_of(ax, bx), min_of(ay, by)), max_of(min_of(az, bz), (Float)(0.0)));
    Float leave = min_of(min_of(max_of(ax, bx), max_of(ay, by)), max_of(az, bz));
    *t_enter = enter;
    return (enter <= leave * SLAB_FAR_FACTOR) & (enter <= t_max);
}
