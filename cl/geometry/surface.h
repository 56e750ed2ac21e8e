/* The shading point: where a hit lies, with a bound of its rounding error, and which way it faces. */
#pragma once
#include "geometry/ray.h"
#include "math/elementary.h"
#include "math/frame.h"
#include "shared/primitive.h"

typedef struct Surface {
    Vec3 p;
    Float p_error; /* how far an origin must move along the normal to lie on its own side */
    Vec3 ng;       /* unit geometric normal, oriented (out of a solid) */
    Vec3 ns;       /* unit shading normal, on the side of ng */
    Vec3 wo;       /* unit, back along the ray */
    Uint primitive;
    Uint material;
    Uint light; /* NO_INDEX: does not emit */
    Float area; /* of the primitive */
} Surface;

/* Triangle: p from barycentrics, error 7 roundings of the largest axis of sum |b_i v_i|. */
STATIC void triangle_surface(Vec3 a, Vec3 b, Vec3 c, Hit hit, Vec3* p, Float* p_error, Vec3* ng, Float* area)
{
    Float b0 = 1.0 - hit.b1 - hit.b2;
    *p = fma3(a, b0, fma3(b, hit.b1, scale3(c, hit.b2)));
    Vec3 size = fma3(abs3(a), abs_of(b0), fma3(abs3(b), hit.b1, scale3(abs3(c), hit.b2)));
    *p_error = TRIANGLE_POINT_ERROR * max_component(size);
    Vec3 normal = cross3(sub3(b, a), sub3(c, a));
    Float twice_area = length3(normal);
    *ng = scale3(normal, 1.0 / twice_area);
    *area = 0.5 * twice_area;
}

/* Sphere: the point is moved onto the sphere along its radius. */
STATIC void sphere_surface(Vec3 centre, Float radius, Ray ray, Hit hit, Vec3* p, Float* p_error, Vec3* ng, Float* area)
{
    *ng = normalize3(sub3(fma3(ray.direction, hit.t, ray.origin), centre));
    *p = fma3(*ng, radius, centre);
    *area = 4.0 * PI * square(radius);
    *p_error = CURVED_POINT_ERROR * (max_component(abs3(centre)) + radius);
}

/* The direction back, on the side of the sphere on which the ray starts. Along the rim the rounded point's normal does
 * not know the side, and a path taken for inside there would be reflected totally for ever. */
STATIC Vec3 sphere_wo(Vec3 centre, Float radius, Ray ray, Hit hit, Vec3 ng, Vec3 wo)
{
    Vec3 f = sub3(ray.origin, centre);
    Mask outside = (ray.from != hit.primitive) & (dot3(f, f) > square(radius));
    Float facing = dot3(ng, wo);
    /* Mirror it, and a few roundings more, for its own components are rounded. */
    Float move = 2.0 * abs_of(facing) + 4.0 * UNIT_ROUNDOFF;
    return choose3(outside == (facing > 0.0), wo, fma3(ng, outside ? move : -move, wo));
}

/* Disk: the point is moved onto the plane along its normal. */
STATIC void disk_surface(Vec3 centre, Vec3 normal, Float radius, Ray ray, Hit hit, Vec3* p, Float* p_error, Vec3* ng,
                         Float* area)
{
    *ng = normal;
    Vec3 from_centre = sub3(fma3(ray.direction, hit.t, ray.origin), centre);
    *p = add3(fma3(normal, -dot3(normal, from_centre), from_centre), centre);
    *area = PI * square(radius);
    *p_error = CURVED_POINT_ERROR * (max_component(abs3(centre)) + radius);
}

/* The surface that the active lanes have hit. */
STATIC Surface make_surface(global const Primitive* primitives, global const PrimitiveSurface* surfaces,
                            global const real4* normals, Mask active, Ray ray, Hit hit)
{
    Surface surface;
    surface.primitive = hit.primitive;
    surface.wo = negate3(normalize3(ray.direction));
    /* Load the primitive and what it looks like. */
    Vec3 a, b, c;
    Float kind, unused;
    gather_real4(primitives[i].a, hit.primitive, active, &a.x, &a.y, &a.z, &kind);
    gather_real4(primitives[i].b, hit.primitive, active, &b.x, &b.y, &b.z, &unused);
    gather_real4(primitives[i].c, hit.primitive, active, &c.x, &c.y, &c.z, &unused);
    Uint normal_index, flags;
    gather_members(surfaces[i], hit.primitive, active, material, &surface.material, light, &surface.light, normal,
                   &normal_index, flags, &flags);
    /* Place the point. */
    triangle_surface(a, b, c, hit, &surface.p, &surface.p_error, &surface.ng, &surface.area);
    if (HAS_SPHERE) {
        Mask is_sphere = kind == PRIMITIVE_SPHERE;
        if (any_of(active & is_sphere)) {
            Vec3 p, ng;
            Float p_error, area;
            sphere_surface(a, b.x, ray, hit, &p, &p_error, &ng, &area);
            surface.p = choose3(is_sphere, p, surface.p);
            surface.ng = choose3(is_sphere, ng, surface.ng);
            surface.p_error = is_sphere ? p_error : surface.p_error;
            surface.area = is_sphere ? area : surface.area;
            surface.wo = choose3(is_sphere, sphere_wo(a, b.x, ray, hit, ng, surface.wo), surface.wo);
        }
    }
    if (HAS_DISK) {
        Mask is_disk = kind == PRIMITIVE_DISK;
        if (any_of(active & is_disk)) {
            Vec3 p, ng;
            Float p_error, area;
            disk_surface(a, b, c.x, ray, hit, &p, &p_error, &ng, &area);
            surface.p = choose3(is_disk, p, surface.p);
            surface.ng = choose3(is_disk, ng, surface.ng);
            surface.p_error = is_disk ? p_error : surface.p_error;
            surface.area = is_disk ? area : surface.area;
        }
    }
    /* Orient it. */
    Mask flip = (flags & SURFACE_FLIP_NORMAL) != 0u;
    surface.ng = choose3(flip, negate3(surface.ng), surface.ng);
    surface.ns = surface.ng;
    if (HAS_VERTEX_NORMALS) {
        Mask smooth = active & (normal_index != NO_INDEX);
        if (any_of(smooth)) {
            /* Interpolate the vertex normals, and keep to the side of the geometric normal. */
            Vec3 n0, n1, n2;
            gather_real4(normals[i], normal_index, smooth, &n0.x, &n0.y, &n0.z, &unused);
            gather_real4(normals[i], normal_index + 1u, smooth, &n1.x, &n1.y, &n1.z, &unused);
            gather_real4(normals[i], normal_index + 2u, smooth, &n2.x, &n2.y, &n2.z, &unused);
            Vec3 n = fma3(n0, 1.0 - hit.b1 - hit.b2, fma3(n1, hit.b1, scale3(n2, hit.b2)));
            n = choose3(dot3(n, surface.ng) < 0.0, negate3(n), n);
            /* Fall back to the geometric normal where the interpolated one vanishes or faces away from the viewer. */
            Mask usable = smooth & (dot3(n, n) > 0.0) & (dot3(n, surface.wo) * dot3(surface.ng, surface.wo) > 0.0);
            surface.ns = choose3(usable, normalize3(choose3(usable, n, surface.ng)), surface.ns);
        }
    }
    return surface;
}
