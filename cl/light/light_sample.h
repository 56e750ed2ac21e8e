/* What sampling a light gives. */
#pragma once
#include "geometry/surface.h"
#include "sampling/random.h"
#include "sampling/warp.h"
#include "shared/scene_view.h"

/* pdf = 0: no light from there. */
typedef struct LightSample {
    Vec3 wi;        /* unit, from the shading point to the light */
    Vec3 to_light;  /* the same, as far as the light (unit for the environment) */
    Float t_max;    /* in lengths of to_light */
    Uint primitive; /* the one sampled, or NO_INDEX */
    Color radiance; /* that arrives along wi if nothing blocks it */
    Float pdf;      /* per solid angle, the choice of the light included */
} LightSample;
