/* Every struct that host and device share: SHARED_STRUCTS lists them for the layout test.
 *
 * The host reads the structs twice, with float and with double reals (src/math/shared.h): their files have guards with
 * names, which shared/again.h forgets. */
#ifndef SHARED_STRUCTS_H
#define SHARED_STRUCTS_H
#include "shared/bvh_node.h"
#include "shared/camera.h"
#include "shared/features.h"
#include "shared/light.h"
#include "shared/limits.h"
#include "shared/material.h"
#include "shared/primitive.h"
#include "shared/replay.h"
#include "shared/settings.h"
#include "shared/work.h"

#define SHARED_STRUCTS(X)                                                                                              \
    X(Camera)                                                                                                          \
    X(Primitive)                                                                                                       \
    X(PrimitiveSurface)                                                                                                \
    X(BvhNode)                                                                                                         \
    X(Material)                                                                                                        \
    X(Light)                                                                                                           \
    X(AliasBucket)                                                                                                     \
    X(RenderSettings)                                                                                                  \
    X(WorkUnit)                                                                                                        \
    X(SampleResult)                                                                                                    \
    X(SampleAov)                                                                                                       \
    X(PixelBlock)                                                                                                      \
    X(PixelAov)                                                                                                        \
    X(LaunchCounters)                                                                                                  \
    X(PathVertex)
#endif
