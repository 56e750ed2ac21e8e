/* Where a new ray starts: moved along the geometric normal by the error bound of the point, so that it cannot lie on
 * the wrong side of its own surface, at any scale. */
#pragma once
#include "geometry/surface.h"

STATIC Vec3 offset_origin(Surface surface, Mask outward)
{
    Float distance = outward ? surface.p_error : -surface.p_error;
    return fma3(surface.ng, distance, surface.p);
}
