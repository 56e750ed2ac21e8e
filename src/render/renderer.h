// Renders a scene onto a film, on one device or several at once.
#pragma once

#include "compute/device.h"
#include "geometry/geometry.h"
#include "render/film.h"
#include "render/megakernel.h"
#include "render/render_report.h"
#include "render/schedule.h"
#include "scene/scene.h"
#include "util/stopwatch.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace etendue
{
struct RenderOptions {
    std::vector<DeviceInfo> devices; // at least one
    std::uint32_t threads = 0;       // compute units of each device; 0: all
    std::uint32_t lanes = 0;         // 0: as suits each device
    bool specialize = true;          // false: the general kernel
    Precision precision = Precision::single;
    bool fast_math = false; // an experiment: relaxed floating point, even where the canary warns of it
    KernelCache cache;
    LaunchShape shape;
};

// How far a render is.
struct RenderProgress {
    double fraction = 0.0; // of the samples asked for, or of the time
    std::uint64_t samples_per_pixel = 0;
    std::uint64_t rays = 0;
};

// What is there after a pass: every pixel of the film has the same number of samples.
struct PassEnd {
    std::uint64_t samples_per_pixel = 0;
    double render_seconds = 0.0; // since render() began, without the time spent in after_pass
    double kernel_seconds = 0.0; // of all devices, by their own clocks
    std::uint64_t rays = 0;
};

// When to stop, and whom to tell.
struct RenderLimits {
    std::uint64_t samples_per_pixel = 1;
    std::optional<double> seconds;                     // of rendering; the next pass is predicted to fit
    std::function<bool()> stop = [] { return false; }; // asked before each launch, from any worker's thread
    std::function<void(const RenderProgress&)> progress = [](const RenderProgress&) {
    }; // after each launch, one at a time
    // Asked after each pass that was not stopped, while nothing runs and the clock stands still: whether to go on.
    // Passes end at 1, 2, 4, ... samples up to SAMPLES_PER_BLOCK, then at every multiple of it.
    std::function<bool(const PassEnd&)> after_pass = [](const PassEnd&) { return true; };
};

class Renderer
{
public:
    // Opens the devices, uploads, builds the tree, asks the canary, compiles. `geometry` outlives the renderer. Throws
    // DeviceError, also when a canary finds that a device does not compute strictly (unless with fast_math);
    // BuildError, UsageError for impossible options.
    Renderer(const Scene& scene, const Geometry& geometry, bool has_aov, const RenderOptions& options);
    ~Renderer();

    // Launch the kernels once on every device as the render will, and forget what comes back: drivers compile and
    // allocate at the first launch. Call it before render(), if at all. Throws DeviceError.
    void warm_up();

    // Add samples [0, samples_per_pixel) to a film that has none, and tell it how to estimate its error. Returns when
    // done, out of time, or stopped; then the pixels may have unequal numbers of samples. Call it once. Throws
    // DeviceError.
    void render(Film& film, const RenderLimits& limits);

    // Complete after render().
    const RenderReport& report() const { return report_; }

    // Keep compiled kernels for the next run, unless the driver does so itself; call it when the picture is written.
    void store_in_cache();

private:
    struct Worker;
    void run_pass(Film& film, const Pass& pass, const RenderLimits& limits);
    void work(Worker& worker, Film& film, Schedule& schedule, const RenderLimits& limits);
    void add_counters(const Worker& worker, const WorkUnit& unit, const LaunchCounters& counters);
    void tell(const RenderLimits& limits);
    double kernel_seconds() const;

    std::vector<std::unique_ptr<Worker>> workers_;
    RenderReport report_;
    std::mutex mutex_; // guards report_ and progress while workers run
    std::uint64_t samples_done_ = 0, crop_pixels_ = 0;
    double render_seconds() const { return watch_.seconds() - paused_seconds_; } // since render() began
    Stopwatch watch_;
    double paused_seconds_ = 0.0; // in after_pass
};
} // namespace etendue
