/* Everything a kernel can leave out or fix, once. From these lists come the host's enums, the names in JSON and their
 * error messages, the device's dispatch, the build options, and the table in the README.
 *
 * A feature NAME is the macro HAS_NAME, always defined as 0 or 1; kernels say `if (HAS_NAME)`. */
#pragma once

/* X(NAME, name in JSON and of the functions name_evaluate/pdf/sample, what it adds) */
#define BSDF_LIST(X)                                                                                                   \
    X(DIFFUSE, diffuse, "Lambert's law on both sides of the surface")                                                  \
    X(MIRROR, mirror, "perfect mirror times a colour")                                                                 \
    X(DIELECTRIC, dielectric, "smooth glass or water: reflects and refracts by Fresnel's law")

#define LIGHT_LIST(X)                                                                                                  \
    X(AREA, area, "triangles, spheres and disks that emit")                                                            \
    X(ENVIRONMENT, environment, "light from infinitely far away")

/* Triangles are always there. */
#define SHAPE_LIST(X)                                                                                                  \
    X(SPHERE, sphere, "analytic spheres")                                                                              \
    X(DISK, disk, "analytic disks")

#define CAMERA_LIST(X) X(PINHOLE, pinhole, "perspective through a point")

#define ACCELERATOR_LIST(X)                                                                                            \
    X(BRUTE_FORCE, none, "every primitive is tested; for a few dozen of them the fastest way")                         \
    X(LBVH, lbvh, "binary tree in Morton order, built by kernels where it is large")

#define SAMPLER_LIST(X)                                                                                                \
    X(INDEPENDENT, independent, "independent random numbers (Philox)")                                                 \
    X(STRATIFIED, stratified, "each 64 samples of a pixel jittered in 8x8 cells")                                      \
    X(SOBOL, sobol, "Owen-scrambled Sobol points, new ones for each dimension of a path")

#define OPTION_LIST(X)                                                                                                 \
    X(VERTEX_NORMALS, vertex_normals, "shading normals interpolated over triangles")                                   \
    X(LIGHT_SAMPLING, light_sampling, "a point on a light is sampled at every vertex")                                 \
    X(EMISSION_SAMPLING, emission_sampling,                                                                            \
      "emission met by a BSDF-sampled ray counts after non-delta scattering too")                                      \
    X(UNIFORM_HEMISPHERE, uniform_hemisphere, "directions uniform over the hemisphere")                                \
    X(BALANCE_HEURISTIC, balance_heuristic, "lights found in two ways are weighed by the balance heuristic")           \
    X(SPHERE_AREA, sphere_area, "spheres that emit are sampled by area from outside too")                              \
    X(ROULETTE, roulette, "Russian roulette")                                                                          \
    X(FILTER, filter, "pixel filters other than the box")                                                              \
    X(AOV, aov, "albedo, normal and depth of the first hit")

/* X(NAME, default, what it fixes): macros that hold a number. */
#define CONSTANT_LIST(X)                                                                                               \
    X(LANES, 1, "paths that one work-item carries: 1, 4, 8 or 16")                                                     \
    X(STACK_SIZE, 32, "entries of the traversal stack: the smallest of 32, 64, 128 that holds the tree's depth")

/* Numbers of the kinds, in the order of the lists. */
#define FEATURE_ENUM_BSDF(NAME, name, text) BSDF_##NAME,
enum BsdfType { BSDF_LIST(FEATURE_ENUM_BSDF) BSDF_COUNT };
#define FEATURE_ENUM_LIGHT(NAME, name, text) LIGHT_##NAME,
enum LightType { LIGHT_LIST(FEATURE_ENUM_LIGHT) LIGHT_COUNT };
#define FEATURE_ENUM_ACCELERATOR(NAME, name, text) ACCELERATOR_##NAME,
enum AcceleratorType { ACCELERATOR_LIST(FEATURE_ENUM_ACCELERATOR) ACCELERATOR_COUNT };
#define FEATURE_ENUM_SAMPLER(NAME, name, text) SAMPLER_##NAME,
enum SamplerNumber { SAMPLER_LIST(FEATURE_ENUM_SAMPLER) SAMPLER_COUNT };
