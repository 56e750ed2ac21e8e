/* Ray against sphere (Haines, Guenther, Akenine-Moeller 2019, "Precision Improvements for Ray/Sphere Intersection",
 * Ray Tracing Gems 7). */
#pragma once
#include "geometry/ray.h"
#include "shared/primitive.h"

/* Distance where the ray meets the sphere: the near root, or the far one from inside. A ray that starts on the sphere
 * itself (on_it) meets it again only at the far end of a chord, and only when it goes inward. */
STATIC Mask sphere_hit(Primitive sphere, Vec3 origin, Vec3 direction, Mask on_it, Float* t)
{
    Float radius = (Float)(sphere.b.x);
    Vec3 f = sub3(origin, broadcast3(sphere.a));
    Float a = dot3(direction, direction);
    Float b = -dot3(f, direction);
    /* Take the discriminant from the distance between line and centre. */
    Vec3 across = fma3(direction, b / a, f);
    Float discriminant = a * (square(radius) - dot3(across, across));
    Float c = dot3(f, f) - square(radius);
    /* Solve without cancellation. */
    Float q = b + copy_sign(sqrt_of(discriminant), b);
    Float near_or_far = c / q;
    Float other = q / a;
    Float t0 = min_of(near_or_far, other);
    Float t1 = max_of(near_or_far, other);
    *t = on_it ? t1 : (t0 > 0.0 ? t0 : t1);
    /* An origin on a small sphere may be rounded off it: going inward it still meets the far side, where it comes
     * nearest if nowhere else. */
    return (on_it & (b > 0.0)) | (not(on_it) & (discriminant >= 0.0));
}
