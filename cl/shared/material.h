/* A material is a type and a place in one array of parameters (colours are three reals). */
#ifndef SHARED_MATERIAL_H
#define SHARED_MATERIAL_H
#include "shared/real.h"

typedef struct Material {
    uint type;            /* BSDF_* of features.h */
    uint flags;           /* MATERIAL_* */
    uint first_parameter; /* index into the parameter array, in the order of the parameter table */
    uint padding;
} Material;

/* Scatters only into single directions: light sampling cannot reach it. */
#define MATERIAL_DELTA 1u
#endif
