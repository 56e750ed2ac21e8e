// What a render did, in numbers: filled while it runs, written by report.h.
#pragma once

#include "bvh/bvh.h"
#include "compute/canary.h"
#include "compute/device.h"
#include "compute/program.h"
#include "compute/specialization.h"
#include "math/shared.h"
#include "render/film.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace etendue
{
// Where an accident happened first: the lowest (sample, pixel) of its kind.
struct AccidentPlace {
    std::uint64_t sample = 0;
    std::uint32_t x = 0, y = 0; // pixel of the whole film
    std::uint32_t vertex = 0;
};

struct HealthRecord {
    std::uint64_t count = 0;
    std::optional<AccidentPlace> first;
    std::string replay; // the command that shows the path of the first, where there is one
};

// "non_finite_radiance" and so on, by HEALTH_*.
const char* health_name(std::size_t kind);

struct DeviceReport {
    DeviceInfo info;
    std::uint32_t compute_units = 0;
    Specialization specialization;
    std::vector<BuildReport> builds;
    CanaryReport canary;
    BvhStatistics bvh;
    double upload_seconds = 0.0, bvh_seconds = 0.0, compile_seconds = 0.0;
    double first_launch_seconds = 0.0; // the first unit, with whatever the driver compiles then
    double render_seconds = 0.0;       // the other units
    double kernel_seconds = 0.0;       // of all units, by the device's own clock
    std::uint64_t units = 0, samples = 0, first_launch_samples = 0;
    Device::Memory memory;
};

struct RenderReport {
    std::vector<DeviceReport> devices;
    AcceleratorType accelerator = ACCELERATOR_LBVH;
    Precision precision = Precision::single;
    bool fast_math = false;              // relaxed floating point was asked for: the picture may be wrong
    double setup_seconds = 0.0;          // opening devices, uploading, building, compiling
    double render_seconds = 0.0;         // all passes, first launch included
    double first_launch_seconds = 0.0;   // of the slowest device
    double warm_up_seconds = 0.0;        // before the render, all devices; 0 without a warm-up
    std::uint64_t samples_per_pixel = 0; // that every pixel has
    ErrorEstimate error_estimate = ErrorEstimate::samples;
    bool interrupted = false;
    std::array<std::uint64_t, COUNT_KINDS> counts{}; // by COUNT_*
    std::array<HealthRecord, HEALTH_KINDS> health{};
    std::vector<std::string> warnings;

    std::uint64_t rays() const;
    std::uint64_t accidents() const;
    // Share of lanes that carried a ray, over all steps; 1 when nothing ran.
    double busy_lanes() const;
    // Rays per second without the first launches, or of everything when there were no others.
    double rays_per_second() const;
};
} // namespace etendue
