/* Vectors and colours in lanes. */
#pragma once
#include "math/numerics.h"

typedef struct Vec2 {
    Float x, y;
} Vec2;
typedef struct Vec3 {
    Float x, y, z;
} Vec3;
typedef Vec3 Color;

STATIC Vec2 vec2(Float x, Float y)
{
    Vec2 v = {x, y};
    return v;
}
STATIC Vec3 vec3(Float x, Float y, Float z)
{
    Vec3 v = {x, y, z};
    return v;
}
/* the same uniform vector in every lane */
STATIC Vec3 broadcast3(real4 v)
{
    return vec3((Float)(v.x), (Float)(v.y), (Float)(v.z));
}
STATIC Color black(void)
{
    return vec3((Float)(0.0), (Float)(0.0), (Float)(0.0));
}
STATIC Color white(void)
{
    return vec3((Float)(1.0), (Float)(1.0), (Float)(1.0));
}

STATIC Vec3 add3(Vec3 a, Vec3 b)
{
    return vec3(a.x + b.x, a.y + b.y, a.z + b.z);
}
STATIC Vec3 sub3(Vec3 a, Vec3 b)
{
    return vec3(a.x - b.x, a.y - b.y, a.z - b.z);
}
STATIC Vec3 mul3(Vec3 a, Vec3 b)
{
    return vec3(a.x * b.x, a.y * b.y, a.z * b.z);
}
STATIC Vec3 scale3(Vec3 a, Float s)
{
    return vec3(a.x * s, a.y * s, a.z * s);
}
STATIC Vec3 negate3(Vec3 a)
{
    return vec3(-a.x, -a.y, -a.z);
}
/* a + b s, each axis with one rounding */
STATIC Vec3 fma3(Vec3 b, Float s, Vec3 a)
{
    return vec3(fma(b.x, s, a.x), fma(b.y, s, a.y), fma(b.z, s, a.z));
}
STATIC Vec3 choose3(Mask m, Vec3 a, Vec3 b)
{
    return vec3(m ? a.x : b.x, m ? a.y : b.y, m ? a.z : b.z);
}

STATIC Float dot3(Vec3 a, Vec3 b)
{
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}
STATIC Vec3 cross3(Vec3 a, Vec3 b)
{
    return vec3(difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
                difference_of_products(a.x, b.y, a.y, b.x));
}
STATIC Float max_component(Vec3 a)
{
    return max_of(a.x, max_of(a.y, a.z));
}
STATIC Vec3 abs3(Vec3 a)
{
    return vec3(abs_of(a.x), abs_of(a.y), abs_of(a.z));
}
STATIC Float length3(Vec3 a)
{
    return sqrt(dot3(a, a));
}
/* Unit vector; a must not be zero. */
STATIC Vec3 normalize3(Vec3 a)
{
    return scale3(a, 1.0 / length3(a));
}
STATIC Mask is_finite3(Vec3 a)
{
    return is_finite(a.x) & is_finite(a.y) & is_finite(a.z);
}
