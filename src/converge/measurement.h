// One render of one configuration with one seed, looked at where the checkpoints say; and what it costs to begin.
#pragma once

#include "converge/checkpoints.h"
#include "converge/picture.h"
#include "converge/preparation.h"
#include "math/vector.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace etendue
{
// Seconds of everything before the first sample.
struct StartSeconds {
    double load = 0.0;     // reading the scene
    double geometry = 0.0; // with its meshes
    double open = 0.0;     // of the devices
    double upload = 0.0;
    double bvh = 0.0;          // with its kernels, where there are any
    double compile = 0.0;      // of the path kernels
    double first_launch = 0.0; // in which some drivers compile too

    double total() const { return load + geometry + open + upload + bvh + compile + first_launch; }
};

// The film at a checkpoint.
struct Snapshot {
    std::size_t checkpoint = 0;  // its number; where one look serves several, the last
    std::uint64_t samples = 0;   // per pixel
    double render_seconds = 0.0; // since the render began; looking at it does not count
    double kernel_seconds = 0.0; // by the devices' own clocks
    std::uint64_t rays = 0;
    std::uint64_t accidents = 0;
    double relative_error = 0.0; // as the film estimates it
    FilmPixels pixels;
};

struct MeasurementOptions {
    Checkpoints checkpoints;
    std::uint64_t seed = 0;
    std::function<bool()> stop = [] { return false; };
    std::function<void(double)> progress = [](double) {};
    std::function<void(const Snapshot&)> look = [](const Snapshot&) {}; // at each checkpoint
};

struct Measurement {
    StartSeconds start;          // with whatever kernels were kept from before
    double look_seconds = 0.0;   // reading the film and what `look` did: in no other time
    double render_seconds = 0.0; // to the last checkpoint
    bool complete = false;       // every checkpoint was reached
    RenderReport report;
};

// Warm up, then render to the last checkpoint. Throws DeviceError and BuildError.
Measurement measure(const PreparedConfiguration& prepared, const MeasurementOptions& options);

// What a first run on this machine costs before its first sample: every kernel compiled as if never seen before.
StartSeconds measure_cold_start(const PreparedConfiguration& prepared);
} // namespace etendue
