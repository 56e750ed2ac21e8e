// Workers, passes, and what they report.
#include "render/renderer.h"

#include "render/render_settings.h"
#include "render/scene_features.h"
#include "util/stopwatch.h"

#include <algorithm>
#include <exception>
#include <thread>

#include <fmt/format.h>

namespace etendue
{
namespace
{
// Launches this long keep Ctrl-C prompt, and on a GPU the driver's watchdog quiet.
constexpr double LAUNCH_SECONDS_CPU = 0.1;
constexpr double LAUNCH_SECONDS_GPU = 0.05;
constexpr std::uint32_t FIRST_LAUNCH_SAMPLES = 1u << 14;
constexpr double SHORTEST_LAUNCH_SAMPLES = 1024.0;

BvhPlace bvh_place(BuildPlace place)
{
    switch (place) {
    case BuildPlace::host:
        return BvhPlace::host;
    case BuildPlace::device:
        return BvhPlace::device;
    case BuildPlace::automatic:
        break;
    }
    return BvhPlace::automatic;
}

std::uint32_t checked_lanes(std::uint32_t lanes, Precision precision, const Device& device)
{
    if (precision == Precision::fp64) {
        device.require_double();
        if (lanes > 1) throw UsageError(fmt::format("In double precision a work-item carries 1 lane, not {}.", lanes));
        return 1;
    }
    if (lanes == 0) return device.preferred_lanes();
    if (lanes != 1 && lanes != 4 && lanes != 8 && lanes != 16)
        throw UsageError(fmt::format("A work-item can carry 1, 4, 8 or 16 lanes, not {}.", lanes));
    return lanes;
}

// Buffers no larger than a block of the whole film needs, and no smaller than a block of one pixel.
LaunchShape fitting_shape(LaunchShape shape, const FilmDescription& film)
{
    const std::uint64_t pixels = static_cast<std::uint64_t>(film.width) * static_cast<std::uint64_t>(film.height);
    const auto largest =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(shape.max_samples, pixels * SAMPLES_PER_BLOCK));
    shape.max_samples = std::max<std::uint32_t>(largest, SAMPLES_PER_BLOCK);
    return shape;
}

std::uint64_t samples_of(const WorkUnit& unit)
{
    return std::uint64_t{unit.tile_width} * unit.tile_height * unit.sample_count;
}

[[noreturn]] void refuse(const DeviceInfo& info, const CanaryReport& canary)
{
    throw DeviceError(fmt::format("{}, driver {}, does not compute strictly, so pictures would be wrong: {} Choose "
                                  "another device or driver, or render all the same with --fast-math.",
                                  info.name, info.driver_version, canary.complaint()));
}

PixelRect tile_of(const WorkUnit& unit)
{
    return {static_cast<int>(unit.tile_x), static_cast<int>(unit.tile_y), static_cast<int>(unit.tile_width),
            static_cast<int>(unit.tile_height)};
}
} // namespace

// A device with its scene and its kernels.
struct Renderer::Worker {
    Worker(const DeviceInfo& info, const Scene& scene, const Geometry& geometry, bool has_aov,
           const RenderOptions& options)
        : device(info, options.threads), lanes(checked_lanes(options.lanes, options.precision, device)),
          settings(make_render_settings(scene, geometry,
                                        choose_accelerator(scene.accelerator, geometry.primitives.size(), lanes))),
          device_scene(device, geometry, settings, bvh_place(scene.accelerator.build), options.cache, options.precision)
    {
        const std::uint32_t depth = device_scene.bvh_statistics().depth;
        const std::string path_options = options.fast_math ? FAST_MATH_OPTION : "";
        report.canary = run_canary(device, path_options, options.cache);
        if (!report.canary.passed && !options.fast_math) refuse(device.info(), report.canary);
        Specialization kernels = scene_features(scene, geometry, settings, has_aov, lanes, depth);
        if (!options.specialize) kernels = Specialization::everything(lanes, kernels.stack_size);
        kernels.precision = options.precision;
        Stopwatch watch;
        kernel = std::make_unique<Megakernel>(device, scene.integrator.type == IntegratorType::normals, kernels,
                                              options.cache, fitting_shape(options.shape, scene.film), path_options);
        report.compile_seconds = watch.seconds();
        launch_samples = std::min(FIRST_LAUNCH_SAMPLES, kernel->shape().max_samples);
    }

    // Aim the next launch at its length, from the last one's.
    void adapt(std::uint64_t samples, double seconds)
    {
        const double wanted = device.is_cpu() ? LAUNCH_SECONDS_CPU : LAUNCH_SECONDS_GPU;
        const double next = static_cast<double>(samples) * wanted / std::max(seconds, 1e-6);
        launch_samples = static_cast<std::uint32_t>(
            std::min(std::max(next, SHORTEST_LAUNCH_SAMPLES), double(kernel->shape().max_samples)));
    }

    Device device;
    std::uint32_t lanes;
    RenderSettings settings;
    DeviceScene device_scene;
    std::unique_ptr<Megakernel> kernel;
    DeviceReport report;
    std::uint32_t launch_samples = 0;
};

Renderer::Renderer(const Scene& scene, const Geometry& geometry, bool has_aov, const RenderOptions& options)
{
    Stopwatch watch;
    report_.error_estimate = error_estimate_of(scene);
    for (const DeviceInfo& info : options.devices)
        workers_.push_back(std::make_unique<Worker>(info, scene, geometry, has_aov, options));
    report_.precision = options.precision;
    report_.accelerator = static_cast<AcceleratorType>(workers_.front()->settings.accelerator);
    report_.fast_math = options.fast_math;
    for (const auto& worker : workers_) {
        DeviceReport& r = worker->report;
        r.info = worker->device.info();
        r.compute_units = worker->device.compute_units();
        r.specialization = worker->kernel->specialization();
        r.upload_seconds = worker->device_scene.upload_seconds();
        r.bvh_seconds = worker->device_scene.bvh_seconds();
        r.bvh = worker->device_scene.bvh_statistics();
        if (!worker->device_scene.bvh_warning().empty()) report_.warnings.push_back(worker->device_scene.bvh_warning());
    }
    report_.setup_seconds = watch.seconds();
}

Renderer::~Renderer() = default;

void Renderer::warm_up()
{
    Stopwatch watch;
    for (const auto& worker : workers_) {
        const RenderSettings& settings = worker->settings;
        const PixelRect whole{0, 0, static_cast<int>(settings.width), static_cast<int>(settings.height)};
        const WorkUnit unit = Schedule(whole, {0, 1}, workers_.size()).next(worker->launch_samples).value();
        std::vector<PixelBlock> blocks(std::size_t{unit.tile_width} * unit.tile_height);
        std::vector<PixelAov> aovs(worker->kernel->specialization().has(Feature::AOV) ? blocks.size() : 0);
        worker->kernel->trace(worker->device_scene, unit, blocks, aovs);
    }
    report_.warm_up_seconds = watch.seconds();
}

void Renderer::render(Film& film, const RenderLimits& limits)
{
    watch_.restart();
    paused_seconds_ = 0.0;
    film.set_error_estimate(report_.error_estimate);
    const PixelRect crop = film.crop();
    crop_pixels_ = static_cast<std::uint64_t>(crop.width) * static_cast<std::uint64_t>(crop.height);
    std::uint64_t done = 0;
    double seconds_per_sample = 0.0;
    while (done < limits.samples_per_pixel && !limits.stop()) {
        Pass pass = next_pass(done, limits.samples_per_pixel);
        if (limits.seconds && done > 0) {
            // Take as many samples as the last pass says will fit.
            const double fitting = (*limits.seconds - render_seconds()) / seconds_per_sample;
            if (fitting < 1.0) break;
            pass.sample_count = static_cast<std::uint32_t>(std::min<double>(pass.sample_count, fitting));
        }
        Stopwatch pass_watch;
        const double first_launch_before = report_.first_launch_seconds;
        run_pass(film, pass, limits);
        seconds_per_sample =
            (pass_watch.seconds() - (report_.first_launch_seconds - first_launch_before)) / pass.sample_count;
        done += pass.sample_count;
        if (limits.stop()) break;
        const PassEnd end{done, render_seconds(), kernel_seconds(), report_.rays()};
        Stopwatch pause;
        const bool go_on = limits.after_pass(end);
        paused_seconds_ += pause.seconds();
        if (!go_on) break;
    }
    report_.samples_per_pixel = film.min_samples();
    report_.interrupted = limits.stop();
    report_.render_seconds = render_seconds();
    for (const auto& worker : workers_) {
        DeviceReport& r = worker->report;
        r.memory = worker->device.memory();
        r.builds = {worker->kernel->path_report(), worker->kernel->film_report()};
        if (const LbvhBuilder* builder = worker->device_scene.bvh_builder())
            r.builds.insert(r.builds.end(), {builder->build_report(), builder->sort_report()});
        report_.devices.push_back(r);
    }
}

void Renderer::run_pass(Film& film, const Pass& pass, const RenderLimits& limits)
{
    Schedule schedule(film.crop(), pass, workers_.size());
    std::exception_ptr failure;
    const auto guarded = [&](Worker& worker) {
        try {
            work(worker, film, schedule, limits);
        } catch (...) {
            schedule.cancel();
            const std::lock_guard lock(mutex_);
            if (!failure) failure = std::current_exception();
        }
    };
    std::vector<std::thread> threads;
    for (std::size_t i = 1; i < workers_.size(); ++i) threads.emplace_back(guarded, std::ref(*workers_[i]));
    guarded(*workers_.front());
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
}

void Renderer::work(Worker& worker, Film& film, Schedule& schedule, const RenderLimits& limits)
{
    std::vector<PixelBlock> blocks;
    std::vector<PixelAov> aovs;
    while (!limits.stop()) {
        const std::optional<WorkUnit> unit = schedule.next(worker.launch_samples);
        if (!unit) return;
        Stopwatch watch;
        film.load_tile(tile_of(*unit), blocks, aovs);
        const LaunchCounters counters = worker.kernel->trace(worker.device_scene, *unit, blocks, aovs);
        film.store_tile(tile_of(*unit), blocks, aovs);
        const double seconds = watch.seconds();

        const std::lock_guard lock(mutex_);
        const bool first = worker.report.units++ == 0;
        worker.report.samples += samples_of(*unit);
        worker.report.kernel_seconds += worker.kernel->kernel_seconds();
        if (first) {
            worker.report.first_launch_seconds = seconds;
            worker.report.first_launch_samples = samples_of(*unit);
            report_.first_launch_seconds = std::max(report_.first_launch_seconds, seconds);
        } else {
            worker.report.render_seconds += seconds;
            worker.adapt(samples_of(*unit), seconds);
        }
        add_counters(worker, *unit, counters);
        samples_done_ += samples_of(*unit);
        tell(limits);
    }
}

void Renderer::add_counters(const Worker& worker, const WorkUnit& unit, const LaunchCounters& counters)
{
    for (std::size_t kind = 0; kind < COUNT_KINDS; ++kind)
        report_.counts[kind] += counters.counts[kind] + (std::uint64_t{counters.counts_high[kind]} << 32);
    for (std::size_t kind = 0; kind < HEALTH_KINDS; ++kind) {
        if (counters.health[kind] == 0) continue;
        HealthRecord& record = report_.health[kind];
        record.count += counters.health[kind];
        // The lowest flat index of the unit is its first by (sample, pixel).
        const std::uint32_t index = counters.health_first[kind];
        const std::uint32_t pixel = index % (unit.tile_width * unit.tile_height);
        AccidentPlace place;
        place.sample = (std::uint64_t{unit.first_sample_high} << 32 | unit.first_sample) +
                       index / (unit.tile_width * unit.tile_height);
        place.x = unit.tile_x + pixel % unit.tile_width;
        place.y = unit.tile_y + pixel / unit.tile_width;
        const auto order = [](const AccidentPlace& p) { return std::tuple(p.sample, p.y, p.x); };
        if (record.first && order(*record.first) <= order(place)) continue;
        place.vertex = worker.kernel->accident_code(index) / 16;
        record.first = place;
    }
}

double Renderer::kernel_seconds() const
{
    double seconds = 0.0;
    for (const auto& worker : workers_) seconds += worker->report.kernel_seconds;
    return seconds;
}

void Renderer::tell(const RenderLimits& limits)
{
    RenderProgress progress;
    progress.samples_per_pixel = samples_done_ / crop_pixels_;
    progress.fraction = static_cast<double>(samples_done_) / static_cast<double>(crop_pixels_) /
                        static_cast<double>(limits.samples_per_pixel);
    if (limits.seconds)
        progress.fraction = std::max(progress.fraction, std::min(render_seconds() / *limits.seconds, 1.0));
    progress.rays = report_.rays();
    limits.progress(progress);
}

void Renderer::store_in_cache()
{
    for (const auto& worker : workers_) {
        if (worker->device.caches_kernels()) continue;
        worker->kernel->store_in_cache();
        if (LbvhBuilder* builder = worker->device_scene.bvh_builder()) builder->store_in_cache();
    }
}
} // namespace etendue
