/* What a user sets and a kernel reads: numbers, never structure, so that no edit of them compiles anything. */
#ifndef SHARED_SETTINGS_H
#define SHARED_SETTINGS_H
#include "shared/camera.h"
#include "shared/real.h"

#define FILTER_BOX 0u
#define FILTER_TENT 1u
#define FILTER_GAUSSIAN 2u

#define ROULETTE_OFF 0u
#define ROULETTE_CONSTANT 1u
#define ROULETTE_THROUGHPUT 2u

typedef struct RenderSettings {
    Camera camera;
    uint width; /* of the whole film, pixels */
    uint height;
    uint seed_low;
    uint seed_high;
    uint max_depth;          /* surface vertices at which light is gathered; 0xffffffff = no limit */
    uint filter;             /* FILTER_* */
    uint roulette;           /* ROULETTE_* */
    uint roulette_start;     /* number of vertices before roulette begins */
    uint sample_lights;      /* 0 or 1: light sampling at each vertex */
    uint count_emission;     /* 0 or 1: emission met by a BSDF-sampled ray counts (weighted when sample_lights) */
    uint uniform_hemisphere; /* 0 or 1: directions uniform over the hemisphere instead of by the BSDF */
    uint accelerator;        /* ACCELERATOR_* of features.h */
    uint primitive_count;
    uint light_count;
    uint alias_shift;          /* 32 - log2(number of alias buckets) */
    uint environment_light;    /* index of the environment in Light[], or NO_INDEX */
    uint sampler;              /* SAMPLER_* of features.h */
    uint replicates;           /* of the Sobol sequence: 1 or 2 */
    uint balance_heuristic;    /* 0 or 1: weigh by the balance heuristic instead of the power heuristic */
    uint sphere_area;          /* 0 or 1: sample lights that are spheres by area from outside too, instead of by cone */
    real4 filter_parameters;   /* radius; gaussian: sigma, both in pixels, and the mass within the radius; 0 */
    real4 roulette_parameters; /* constant survival probability; 0; 0; 0 */
    real4 scene_bounds;        /* centre and radius of the bounding sphere of the geometry */
} RenderSettings;
#endif
