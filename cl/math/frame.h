/* Orthonormal frame around a normal; in the local frame the normal is z. */
#pragma once
#include "math/vector.h"

typedef struct Frame {
    Vec3 s, t, n;
} Frame;

/* Complete a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1)). */
STATIC Frame make_frame(Vec3 n)
{
    Float sign = copy_sign((Float)(1.0), n.z);
    Float a = -1.0 / (sign + n.z);
    Float b = n.x * n.y * a;
    Frame frame;
    frame.s = vec3(fma(sign * n.x, n.x * a, (Float)(1.0)), sign * b, -sign * n.x);
    frame.t = vec3(b, fma(n.y, n.y * a, sign), -n.y);
    frame.n = n;
    return frame;
}
STATIC Vec3 to_local(Frame frame, Vec3 w)
{
    return vec3(dot3(w, frame.s), dot3(w, frame.t), dot3(w, frame.n));
}
STATIC Vec3 to_world(Frame frame, Vec3 w)
{
    return fma3(frame.s, w.x, fma3(frame.t, w.y, scale3(frame.n, w.z)));
}
/* On the same side of the surface; directions along it are on none. */
STATIC Mask same_hemisphere(Vec3 a, Vec3 b)
{
    return ((a.z > 0.0) & (b.z > 0.0)) | ((a.z < 0.0) & (b.z < 0.0));
}
