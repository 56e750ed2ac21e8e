// Single samples of a render once more, vertex by vertex, in either precision: the numbers and the result are those of
// the render, bit for bit.
#pragma once

#include "compute/kernel.h"
#include "geometry/geometry.h"
#include "math/precision.h"
#include "math/shared.h"
#include "math/vector.h"
#include "render/device_scene.h"
#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace etendue
{
// A sample of a pixel of the whole film.
struct ReplaySample {
    std::uint32_t x = 0, y = 0;
    std::uint64_t sample = 0;
};

// The command line, for a shell, that replays a sample of a render of the scene in `file`; `options` are what changed
// the picture: "--size", "8x8" and so on.
std::string replay_command(const std::string& file, const ReplaySample& sample, std::uint64_t seed,
                           const std::vector<std::string>& options);

struct PathRecord {
    std::vector<fp64::PathVertex> vertices; // of either precision, widened; the first ones if there are too many
    std::uint32_t vertex_count = 0;         // of the whole path, the place where it left the scene included
    Vec3 radiance{0.0};                     // 0 after an accident
    std::uint32_t accident = 0;             // 0, or kind + 1 + 16 * vertex (HEALTH_*)
};

struct ReplayOptions {
    bool specialize = true; // false: the general kernel
    KernelCache cache;
    bool fast_math = false; // relaxed floating point, as in the render
};

// A device with a scene and the replay kernel.
class Replayer
{
public:
    // Throws DeviceError (no double precision where that is asked for, too), BuildError, and UsageError for an
    // integrator without paths. The device outlives the replayer.
    Replayer(const Device& device, const Scene& scene, const Geometry& geometry, Precision precision,
             const ReplayOptions& options = {});

    // One record a sample, in their order. Throws UsageError for a pixel outside the film, DeviceError.
    std::vector<PathRecord> replay(std::span<const ReplaySample> samples, std::uint32_t max_vertices);

    void store_in_cache() { program_.store_in_cache(); }

private:
    template<typename Reals>
    void launch(std::span<const ReplaySample> samples, std::uint32_t max_vertices, std::vector<PathRecord>& records);

    const Device* device_;
    Precision precision_;
    RenderSettings settings_;
    DeviceScene scene_;
    Program program_;
    Kernel kernel_;
};

// The same for one call.
std::vector<PathRecord> replay(const Device& device, const Scene& scene, const Geometry& geometry, Precision precision,
                               std::span<const ReplaySample> samples, std::uint32_t max_vertices,
                               const ReplayOptions& options = {});
} // namespace etendue
