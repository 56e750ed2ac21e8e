/* What rays meet. Primitives are stored triangles first, then spheres, then disks; the index is the primitive's id and
 * the lowest id wins a tie. Coordinates are the normalised ones of Geometry (recentred, scaled by a power of two). */
#ifndef SHARED_PRIMITIVE_H
#define SHARED_PRIMITIVE_H
#include "shared/real.h"

#define PRIMITIVE_TRIANGLE 0
#define PRIMITIVE_SPHERE 1
#define PRIMITIVE_DISK 2

/*            a            b                c
 * triangle   vertex 0     vertex 1         vertex 2
 * sphere     centre       (radius, 0, 0)   unused
 * disk       centre       unit normal      (radius, 0, 0)
 * a.w holds the PRIMITIVE_* kind as a number; b.w and c.w are 0. */
typedef struct Primitive {
    real4 a;
    real4 b;
    real4 c;
} Primitive;

/* How a primitive looks, by primitive id. */
typedef struct PrimitiveSurface {
    uint material; /* index into Material[] */
    uint light;    /* index into Light[], or NO_INDEX */
    uint normal;   /* index of the first of three real4 vertex normals, or NO_INDEX */
    uint flags;    /* SURFACE_* */
} PrimitiveSurface;

/* The geometric normal cross(b - a, c - a) of a triangle, or that of a sphere (outward) or disk, is turned round. */
#define SURFACE_FLIP_NORMAL 1u
#endif
