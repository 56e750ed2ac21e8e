/* The scene as kernels see it: SCENE_ARGUMENTS are the arguments of every kernel that reads it, SCENE_VIEW() gathers
 * them into one struct. The host passes them in the same order (src/render/device_scene.h). */
#pragma once
#include "shared/structs.h"

typedef struct SceneView {
    global const RenderSettings* settings;
    global const BvhNode* nodes;
    global const uint* leaf_primitives;
    global const Primitive* primitives;
    global const PrimitiveSurface* surfaces;
    global const real4* normals;
    global const Material* materials;
    global const real* parameters;
    global const Light* lights;
    global const AliasBucket* light_table;
} SceneView;

#define SCENE_ARGUMENTS                                                                                                \
    global const RenderSettings *settings, global const BvhNode *nodes, global const uint *leaf_primitives,            \
        global const Primitive *primitives, global const PrimitiveSurface *surfaces, global const real4 *normals,      \
        global const Material *materials, global const real *parameters, global const Light *lights,                   \
        global const AliasBucket *light_table

#define SCENE_VIEW()                                                                                                   \
    {                                                                                                                  \
        settings, nodes, leaf_primitives, primitives, surfaces, normals, materials, parameters, lights, light_table    \
    }
