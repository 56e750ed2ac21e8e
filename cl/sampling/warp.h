/* Maps of the unit square onto shapes, with the densities they give. u and v are in [0, 1). */
#pragma once
#include "math/elementary.h"
#include "math/vector.h"

/* Cosine-weighted direction about +z. */
STATIC Vec3 cosine_hemisphere_sample(Float u, Float v)
{
    Float sine, cosine;
    sin_cos_two_pi(u, &sine, &cosine);
    Float r = sqrt(v);
    return vec3(r * cosine, r * sine, sqrt(1.0 - v));
}
/* The u and v that give w. */
STATIC void cosine_hemisphere_invert(Vec3 w, Float* u, Float* v)
{
    Float turn = atan2pi(w.y, w.x) * 0.5;
    *u = turn < 0.0 ? turn + 1.0 : turn;
    *v = w.x * w.x + w.y * w.y;
}
/* Per solid angle. */
STATIC Float cosine_hemisphere_pdf(Vec3 w)
{
    return w.z > 0.0 ? w.z * INV_PI : (Float)(0.0);
}

/* Uniform direction about +z; z in (0, 1]. */
STATIC Vec3 uniform_hemisphere_sample(Float u, Float v)
{
    Float sine, cosine;
    sin_cos_two_pi(u, &sine, &cosine);
    Float z = 1.0 - v;
    Float r = sqrt_of(v * (2.0 - v));
    return vec3(r * cosine, r * sine, z);
}
STATIC Float uniform_hemisphere_pdf(Vec3 w)
{
    return w.z > 0.0 ? (Float)(INV_TWO_PI) : (Float)(0.0);
}

/* Uniform direction. */
STATIC Vec3 uniform_sphere_sample(Float u, Float v)
{
    Float sine, cosine;
    sin_cos_two_pi(u, &sine, &cosine);
    Float r = 2.0 * sqrt(v * (1.0 - v));
    return vec3(r * cosine, r * sine, 1.0 - 2.0 * v);
}
STATIC Float uniform_sphere_pdf(void)
{
    return (Float)(INV_FOUR_PI);
}

/* Uniform direction within a cone about +z; one_minus_cos = 1 - cos of its half angle, kept apart since the cosine of
 * a small cone has lost it. */
STATIC Vec3 uniform_cone_sample(Float u, Float v, Float one_minus_cos)
{
    Float sine, cosine;
    sin_cos_two_pi(u, &sine, &cosine);
    Float down = v * one_minus_cos;
    Float r = sqrt_of(down * (2.0 - down));
    return vec3(r * cosine, r * sine, 1.0 - down);
}
/* Per solid angle, inside the cone. */
STATIC Float uniform_cone_pdf(Float one_minus_cos)
{
    return INV_TWO_PI / one_minus_cos;
}

/* Barycentric coordinates (of the second and third vertex), uniform over a triangle. */
STATIC Vec2 uniform_triangle_sample(Float u, Float v)
{
    Float root = sqrt(u);
    return vec2(root * (1.0 - v), root * v);
}

/* A point of the unit disk, uniform by area. */
STATIC Vec2 uniform_disk_sample(Float u, Float v)
{
    Float sine, cosine;
    sin_cos_two_pi(u, &sine, &cosine);
    Float r = sqrt(v);
    return vec2(r * cosine, r * sine);
}
STATIC Float uniform_disk_pdf_area(void)
{
    return (Float)(INV_PI);
}

/* Offset from the centre of a tent of radius 1. */
STATIC Float tent_sample(Float u)
{
    Float low = sqrt(2.0 * u) - 1.0;
    Float high = 1.0 - sqrt_of(2.0 - 2.0 * u);
    return u < 0.5 ? low : high;
}

/* Offset by a round Gaussian of standard deviation 1 cut off at a radius, by inversion (Box and Muller 1958); mass is
 * its part within the radius, 1 - exp(-radius^2 / 2). */
STATIC Vec2 truncated_gaussian_sample(Float u, Float v, Float radius, Float mass)
{
    Float sine, cosine;
    sin_cos_two_pi(u, &sine, &cosine);
    Float r = min_of(sqrt_of(-2.0 * log_of(1.0 - v * mass)), radius);
    return vec2(r * cosine, r * sine);
}
