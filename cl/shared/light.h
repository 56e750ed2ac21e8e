/* One thing that emits. An area light is one primitive, so that a mesh of n emissive triangles is n lights. */
#ifndef SHARED_LIGHT_H
#define SHARED_LIGHT_H
#include "shared/real.h"

typedef struct Light {
    uint type;      /* LIGHT_* of features.h */
    uint primitive; /* for area lights */
    uint flags;     /* LIGHT_TWO_SIDED */
    uint padding;
    real4 radiance; /* emitted radiance, W/(sr m^2); w is the probability that the light is chosen */
} Light;

/* Emits from both sides of its surface; else only to the side of the geometric normal. */
#define LIGHT_TWO_SIDED 1u

/* One bucket of the integer alias table (a power of two of them): choose this bucket's own light when a 32-bit random
 * integer is below threshold, else alias. A full bucket has alias = own index. Sampling is exact in integers. */
typedef struct AliasBucket {
    uint threshold;
    uint alias;
} AliasBucket;
#endif
