// What a scene needs of the kernels: the rest is left out.
#pragma once

#include "compute/specialization.h"
#include "geometry/geometry.h"
#include "math/shared.h"
#include "scene/scene.h"

#include <cstdint>

namespace etendue
{
// The smallest stack class that holds a tree of this depth. Throws DeviceError when none does.
std::uint32_t stack_class(std::uint32_t depth);

// Features of the path kernel for this scene. `settings` are those it will run with.
Specialization scene_features(const Scene& scene, const Geometry& geometry, const RenderSettings& settings,
                              bool has_aov, std::uint32_t lanes, std::uint32_t bvh_depth);

// What is left of a specialization for the kernels that only add up samples: the same binary for every scene.
Specialization film_features(bool has_aov, Precision precision = Precision::single);
} // namespace etendue
