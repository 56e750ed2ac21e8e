/* Watertight ray against triangle (Woop, Benthin, Wald 2013, JCGT 2(1)), with edge functions as Kahan's difference of
 * products, so that no compiler's contraction can open a crack. */
#pragma once
#include "geometry/ray.h"
#include "shared/primitive.h"

/* Rows of the shear that maps the ray's direction to z: coordinates across the ray are dot(x, p - origin) and
 * dot(y, p - origin), the distance dot(z, p - origin). One entry of x and y is 1, one is 0: those products are exact.
 */
typedef struct RayShear {
    Vec3 x, y, z;
} RayShear;

STATIC RayShear make_ray_shear(Vec3 d)
{
    /* Take the largest axis of the direction as depth. */
    Vec3 a = abs3(d);
    Mask x_largest = (a.x >= a.y) & (a.x >= a.z);
    Mask y_largest = not(x_largest) & (a.y >= a.z);
    Float zero = (Float)(0.0), one = (Float)(1.0);
    Float depth = x_largest ? d.x : (y_largest ? d.y : d.z);
    Float scale = 1.0 / depth;
    Float shear_x = -(x_largest ? d.y : (y_largest ? d.z : d.x)) / depth;
    Float shear_y = -(x_largest ? d.z : (y_largest ? d.x : d.y)) / depth;
    /* Write the rows for depth axis x, y or z; the other two axes follow cyclically. */
    RayShear shear;
    shear.x = vec3(x_largest ? shear_x : (y_largest ? zero : one), x_largest ? one : (y_largest ? shear_x : zero),
                   x_largest ? zero : (y_largest ? one : shear_x));
    shear.y = vec3(x_largest ? shear_y : (y_largest ? one : zero), x_largest ? zero : (y_largest ? shear_y : one),
                   x_largest ? one : (y_largest ? zero : shear_y));
    shear.z = vec3(x_largest ? scale : zero, y_largest ? scale : zero, (x_largest | y_largest) ? zero : scale);
    return shear;
}

/* Distance and barycentrics where the line of the ray meets a triangle; both sides count. */
STATIC Mask triangle_hit(Primitive triangle, Vec3 origin, RayShear shear, Float* t, Float* b1, Float* b2)
{
    /* Shear the vertices. */
    Vec3 a = sub3(broadcast3(triangle.a), origin);
    Vec3 b = sub3(broadcast3(triangle.b), origin);
    Vec3 c = sub3(broadcast3(triangle.c), origin);
    Float ax = dot3(shear.x, a), ay = dot3(shear.y, a);
    Float bx = dot3(shear.x, b), by = dot3(shear.y, b);
    Float cx = dot3(shear.x, c), cy = dot3(shear.y, c);
    /* Evaluate the scaled barycentrics: all of one sign inside. */
    Float u = difference_of_products(cx, by, cy, bx);
    Float v = difference_of_products(ax, cy, ay, cx);
    Float w = difference_of_products(bx, ay, by, ax);
    Mask inside = ((u >= 0.0) & (v >= 0.0) & (w >= 0.0)) | ((u <= 0.0) & (v <= 0.0) & (w <= 0.0));
    Float determinant = u + v + w;
    inside &= determinant != 0.0;
    /* Interpolate the distance. */
    Float inverse = 1.0 / determinant;
    Float distance = fma(u, dot3(shear.z, a), fma(v, dot3(shear.z, b), w * dot3(shear.z, c)));
    *t = distance * inverse;
    *b1 = v * inverse;
    *b2 = w * inverse;
    return inside;
}
