/* Ray against axis-aligned box (slabs; Kay and Kajiya 1986). */
#pragma once
#include "geometry/ray.h"

/* Where the ray enters a padded box before t_max; inverse is 1 / direction with infinities. A ray within a face plane
 * gives 0 * inf = NaN on one side: min_of and max_of then keep the other side, and padding made that the right one. */
STATIC Mask box_hit(real lower_x, real upper_x, real lower_y, real upper_y, real lower_z, real upper_z, Vec3 origin,
                    Vec3 inverse, Float t_max, Float* t_enter)
{
    Float ax = (lower_x - origin.x) * inverse.x, bx = (upper_x - origin.x) * inverse.x;
    Float ay = (lower_y - origin.y) * inverse.y, by = (upper_y - origin.y) * inverse.y;
    Float az = (lower_z - origin.z) * inverse.z, bz = (upper_z - origin.z) * inverse.z;
    Float enter = max_of(max_of(min_of(ax, bx), min_of(ay, by)), max_of(min_of(az, bz), (Float)(0.0)));
    Float leave = min_of(min_of(max_of(ax, bx), max_of(ay, by)), max_of(az, bz));
    *t_enter = enter;
    return (enter <= leave * SLAB_FAR_FACTOR) & (enter <= t_max);
}
