/* Emissive triangles, disks and spheres. Triangles and disks are sampled by area, spheres from outside by solid angle
 * unless the settings say otherwise.
 */
#pragma once
#include "light/light_sample.h"

/* A point on the light, its oriented unit normal, and the density of the direction to it per solid angle. */
typedef struct AreaPoint {
    Vec3 to_point; /* from the shading point */
    Vec3 normal;
    Float pdf;
} AreaPoint;

/* Turn a density by area into one by solid angle: distance^2 / (area |cos|). */
STATIC Float area_to_solid_angle(Vec3 to_point, Vec3 normal, Float area)
{
    Float distance2 = dot3(to_point, to_point);
    Float cosine = abs_of(dot3(normal, to_point)) / sqrt(distance2);
    return cosine > MIN_COSINE ? distance2 / (area * cosine) : (Float)(0.0);
}

STATIC AreaPoint triangle_light_sample(Vec3 a, Vec3 b, Vec3 c, Vec3 from, Float u, Float v)
{
    Vec2 bary = uniform_triangle_sample(u, v);
    Vec3 e1 = sub3(b, a), e2 = sub3(c, a);
    Vec3 normal = cross3(e1, e2);
    Float twice_area = length3(normal);
    AreaPoint point;
    point.to_point = fma3(e1, bary.x, fma3(e2, bary.y, sub3(a, from)));
    point.normal = scale3(normal, 1.0 / twice_area);
    point.pdf = area_to_solid_angle(point.to_point, point.normal, 0.5 * twice_area);
    return point;
}

STATIC AreaPoint disk_light_sample(Vec3 centre, Vec3 normal, Float radius, Vec3 from, Float u, Float v)
{
    Vec2 on_disk = uniform_disk_sample(u, v);
    Frame frame = make_frame(normal);
    AreaPoint point;
    point.to_point = fma3(frame.s, radius * on_disk.x, fma3(frame.t, radius * on_disk.y, sub3(centre, from)));
    point.normal = normal;
    point.pdf = area_to_solid_angle(point.to_point, normal, PI * square(radius));
    return point;
}

/* 1 - cos of the cone that a sphere fills, from its sine squared: no cancellation for small cones. */
STATIC Float sphere_one_minus_cos(Float sin2)
{
    return sin2 / (1.0 + sqrt_of(1.0 - sin2));
}

/* Outside: uniform over the cone of directions (Shirley, Wang, Zimmerman 1996), or over the half of the area that is
 * seen; inside: uniform over the area. */
STATIC AreaPoint sphere_light_sample(Vec3 centre, Float radius, Vec3 from, bool by_cone, Float u, Float v)
{
    Vec3 to_centre = sub3(centre, from);
    Float distance2 = dot3(to_centre, to_centre);
    Float sin2 = square(radius) / distance2;
    Mask outside = sin2 < 1.0;
    AreaPoint point;
    /* Sample a direction within the cone and follow it to the near side of the sphere. */
    Float one_minus_cos = sphere_one_minus_cos(sin2);
    Frame frame = make_frame(scale3(to_centre, 1.0 / sqrt(distance2)));
    Vec3 in_cone = uniform_cone_sample(u, v, one_minus_cos);
    Vec3 wi = to_world(frame, in_cone);
    Float along = dot3(to_centre, wi);
    Vec3 across = fma3(wi, -along, to_centre);
    Float half_chord = sqrt_of(square(radius) - dot3(across, across));
    Vec3 near = scale3(wi, along - half_chord);
    /* Or a point anywhere on it. */
    Vec3 normal = uniform_sphere_sample(u, v);
    Vec3 anywhere = fma3(normal, radius, to_centre);
    Mask in_direction = outside & to_mask(by_cone);
    point.to_point = choose3(in_direction, near, anywhere);
    point.normal = choose3(in_direction, scale3(sub3(near, to_centre), 1.0 / radius), normal);
    Float by_area = area_to_solid_angle(anywhere, normal, 4.0 * PI * square(radius));
    Mask hidden = outside & (dot3(normal, anywhere) > 0.0);
    by_area = hidden ? (Float)(0.0) : by_area;
    point.pdf = in_direction ? uniform_cone_pdf(one_minus_cos) : by_area;
    return point;
}

/* Density with which a sphere light is sampled in the direction of a point on it. */
STATIC Float sphere_light_pdf(Vec3 centre, Float radius, Vec3 from, Vec3 to_point, Vec3 normal, bool by_cone)
{
    Vec3 to_centre = sub3(centre, from);
    Float sin2 = square(radius) / dot3(to_centre, to_centre);
    Float by_area = area_to_solid_angle(to_point, normal, 4.0 * PI * square(radius));
    Mask in_direction = (sin2 < 1.0) & to_mask(by_cone);
    return in_direction ? uniform_cone_pdf(sphere_one_minus_cos(sin2)) : by_area;
}

STATIC bool spheres_by_cone(SceneView view)
{
    return !(HAS_SPHERE_AREA && view.settings->sphere_area);
}

/* Sample the lights `primitive` of the active lanes from a point; radiance and the choice of the light are the
 * caller's. */
STATIC AreaPoint area_light_sample(SceneView view, Uint primitive, Mask active, Vec3 from, Float u, Float v)
{
    Vec3 a, b, c;
    Float kind, unused;
    gather_real4(view.primitives[i].a, primitive, active, &a.x, &a.y, &a.z, &kind);
    gather_real4(view.primitives[i].b, primitive, active, &b.x, &b.y, &b.z, &unused);
    gather_real4(view.primitives[i].c, primitive, active, &c.x, &c.y, &c.z, &unused);
    AreaPoint point = triangle_light_sample(a, b, c, from, u, v);
    if (HAS_DISK && any_of(active & (kind == PRIMITIVE_DISK))) {
        AreaPoint disk = disk_light_sample(a, b, c.x, from, u, v);
        Mask mine = kind == PRIMITIVE_DISK;
        point.to_point = choose3(mine, disk.to_point, point.to_point);
        point.normal = choose3(mine, disk.normal, point.normal);
        point.pdf = mine ? disk.pdf : point.pdf;
    }
    if (HAS_SPHERE && any_of(active & (kind == PRIMITIVE_SPHERE))) {
        AreaPoint sphere = sphere_light_sample(a, b.x, from, spheres_by_cone(view), u, v);
        Mask mine = kind == PRIMITIVE_SPHERE;
        point.to_point = choose3(mine, sphere.to_point, point.to_point);
        point.normal = choose3(mine, sphere.normal, point.normal);
        point.pdf = mine ? sphere.pdf : point.pdf;
    }
    /* Orient the normal as the surface is oriented. */
    Uint unused0, unused1, unused2, flags;
    gather_members(view.surfaces[i], primitive, active, material, &unused0, light, &unused1, normal, &unused2, flags,
                   &flags);
    point.normal = choose3((flags & SURFACE_FLIP_NORMAL) != 0u, negate3(point.normal), point.normal);
    return point;
}

/* The density, per solid angle, with which area_light_sample from ray.origin finds the point that the ray has hit. */
STATIC Float area_light_pdf(SceneView view, Surface surface, Mask active, Ray ray, Hit hit)
{
    Vec3 to_point = scale3(ray.direction, hit.t);
    Float pdf = area_to_solid_angle(to_point, surface.ng, surface.area);
    if (HAS_SPHERE) {
        Vec3 centre;
        Float radius, kind, unused;
        gather_real4(view.primitives[i].a, hit.primitive, active, &centre.x, &centre.y, &centre.z, &kind);
        gather_real4(view.primitives[i].b, hit.primitive, active, &radius, &unused, &unused, &unused);
        pdf = kind == PRIMITIVE_SPHERE
                  ? sphere_light_pdf(centre, radius, ray.origin, to_point, surface.ng, spheres_by_cone(view))
                  : pdf;
    }
    return pdf;
}
