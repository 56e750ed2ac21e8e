/* Every struct that host and device share: SHARED_STRUCTS lists them for the layout test. */
#pragma once
#include "shared/bvh_node.h"
#include "shared/camera.h"
#include "shared/features.h"
#include "shared/light.h"
#include "shared/limits.h"
#include "shared/material.h"
#include "shared/primitive.h"
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
    X(LaunchCounters)
