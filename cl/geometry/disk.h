/* Ray against disk. */
#pragma once
#include "geometry/ray.h"
#include "shared/primitive.h"

STATIC Mask disk_hit(Primitive disk, Vec3 origin, Vec3 direction, Float* t)
{
    Vec3 normal = broadcast3(disk.b);
    Vec3 to_centre = sub3(broadcast3(disk.a), origin);
    Float slope = dot3(normal, direction);
    *t = dot3(normal, to_centre) / slope;
    Vec3 from_centre = sub3(scale3(direction, *t), to_centre);
    return (slope != 0.0) & (dot3(from_centre, from_centre) <= (Float)(disk.c.x * disk.c.x));
}
