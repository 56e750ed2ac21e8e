/* What a replay tells of a path: one record for each surface it met, and one where it left the scene. */
#ifndef SHARED_REPLAY_H
#define SHARED_REPLAY_H
#include "shared/real.h"

/* Lengths and places in the normalised coordinates of Geometry. Where nothing was met, primitive, material, bsdf and
 * light are NO_INDEX, t is infinite, and place and normals are 0. */
typedef struct PathVertex {
    real4 position;         /* w = how far the next ray's origin is moved along the normal: the bound of its error */
    real4 geometric_normal; /* w = t, the distance from the vertex before */
    real4 shading_normal;   /* w = density of the next direction per solid angle; 0 where none was sampled */
    real4 direction;        /* of the next ray, 0 where none was sampled; w = 0 */
    real4 throughput;       /* after scattering and roulette; w = the part of it that refraction will undo */
    real4 emission;         /* radiance so far with what was met here; w = 0 */
    real4 radiance;         /* and with the light sampled here; w = 0 */
    real4 light_pdfs; /* per solid angle: x of the light sample here, y of its direction under BSDF sampling, both 0
                         where none was drawn; z of the emission met here under light sampling; w = 0 */
    uint primitive;
    uint material; /* index into Material[] */
    uint bsdf;     /* BSDF_* of features.h */
    uint light;    /* index into Light[], NO_INDEX where it does not emit */
    uint delta;    /* 1: the next direction comes from a delta lobe */
    uint inside;   /* 1: met from behind the geometric normal */
    uint goes_on;  /* 1: there is a next ray */
    uint accident; /* 0, or kind + 1 + 16 * vertex of the first accident (HEALTH_*) */
} PathVertex;
#endif
