// What the user asked for, as the numbers that kernels read.
#pragma once

#include "geometry/geometry.h"
#include "math/shared.h"
#include "render/film.h"
#include "scene/scene.h"

namespace etendue
{
// The accelerator a scene gets: the one it names, else none up to as many primitives as are faster tested one by one by
// this many lanes, and lbvh above.
AcceleratorType choose_accelerator(const AcceleratorDescription& wanted, std::size_t primitive_count,
                                   std::uint32_t lanes);

// Settings of a whole render; light is sampled only where there is any.
RenderSettings make_render_settings(const Scene& scene, const Geometry& geometry, AcceleratorType accelerator);

// What tells the error of a picture of the scene: its sampler decides.
ErrorEstimate error_estimate_of(const Scene& scene);

// The samples per pixel the scene asks for; the normals integrator takes one.
std::uint64_t wanted_samples(const Scene& scene);
} // namespace etendue
