// An independent estimate of a picture: a path tracer in double precision that tests every shape, in the simplest form
// that is correct. It shares no code with the kernels. Shading is flat (vertex normals only tell which side is out),
// the filter is the box, meshes are OBJ files, and roulette is its own; film size and max_depth are the scene's.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace etendue
{
struct ReferenceOptions {
    // Light is sampled uniformly over the area of all that emits, at every diffuse vertex; otherwise emission is only
    // met by scattered rays.
    bool sample_lights = true;
    std::uint32_t roulette_start = 4;    // vertices before roulette begins
    std::uint32_t batches = 32;          // independent estimates of the whole picture, at least 2: the errors' source
    std::uint32_t samples_per_batch = 1; // per pixel
    std::uint64_t seed = 1;
};

struct ReferencePicture {
    Vec3 mean{0.0}; // radiance averaged over the film, W/(sr m^2)
    Vec3 standard_error{0.0};
    std::vector<Vec3> pixels;          // means, row by row from the top
    std::vector<Vec3> pixel_variances; // of these means
};

// Render a scene on two threads. The same seed gives the same bits. Throws FileError for a mesh that it cannot read.
ReferencePicture render_reference(const Scene& scene, const ReferenceOptions& options = {});
} // namespace etendue
