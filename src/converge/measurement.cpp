// Renders with a clock that stands still while somebody looks.
#include "converge/measurement.h"

#include "util/stopwatch.h"

#include <algorithm>

namespace etendue
{
namespace
{
// More samples than a life is long, for checkpoints in time.
constexpr std::uint64_t UNLIMITED_SAMPLES = std::uint64_t{1} << 40;

double slowest(const RenderReport& report, double DeviceReport::*member)
{
    double seconds = 0.0;
    for (const DeviceReport& device : report.devices) seconds = std::max(seconds, device.*member);
    return seconds;
}

Film film_of(const Scene& scene)
{
    return {scene.film.width, scene.film.height, {0, 0, scene.film.width, scene.film.height}, false};
}

// Complete after the render: only then the report has its devices.
StartSeconds start_seconds(const PreparedConfiguration& prepared, const RenderReport& report)
{
    StartSeconds start;
    start.load = prepared.load_seconds;
    start.geometry = prepared.geometry_seconds;
    start.upload = slowest(report, &DeviceReport::upload_seconds);
    start.bvh = slowest(report, &DeviceReport::bvh_seconds);
    start.compile = slowest(report, &DeviceReport::compile_seconds);
    start.open = std::max(0.0, report.setup_seconds - start.upload - start.bvh - start.compile);
    start.first_launch = report.warm_up_seconds;
    return start;
}
} // namespace

Measurement measure(const PreparedConfiguration& prepared, const MeasurementOptions& options)
{
    Scene scene = prepared.scene;
    scene.sampler.seed = options.seed;
    Renderer renderer(scene, prepared.geometry, false, prepared.options);
    renderer.warm_up();

    Measurement measurement;
    Film film = film_of(scene);
    CheckpointClock clock(options.checkpoints);
    const bool is_samples = options.checkpoints.axis == Checkpoints::Axis::samples;
    const double last = options.checkpoints.values().back();
    RenderLimits limits;
    limits.samples_per_pixel = is_samples ? static_cast<std::uint64_t>(last) : UNLIMITED_SAMPLES;
    limits.stop = options.stop;
    double seconds = 0.0;
    limits.progress = [&](const RenderProgress& now) { options.progress(is_samples ? now.fraction : seconds / last); };
    limits.after_pass = [&](const PassEnd& end) {
        seconds = end.render_seconds;
        if (!clock.due(end.samples_per_pixel, end.render_seconds)) return true;
        const Stopwatch watch;
        options.look({clock.passed(), end.samples_per_pixel, end.render_seconds, end.kernel_seconds, end.rays,
                      renderer.report().accidents(), film.relative_error(), pixels_of(film)});
        measurement.look_seconds += watch.seconds();
        measurement.render_seconds = end.render_seconds;
        return !clock.finished();
    };
    renderer.render(film, limits);
    renderer.store_in_cache();
    measurement.complete = clock.finished();
    measurement.report = renderer.report();
    measurement.start = start_seconds(prepared, measurement.report);
    return measurement;
}

StartSeconds measure_cold_start(const PreparedConfiguration& prepared)
{
    RenderOptions options = prepared.options;
    options.cache = KernelCache::cold();
    Renderer renderer(prepared.scene, prepared.geometry, false, options);
    renderer.warm_up();
    Film film = film_of(prepared.scene);
    renderer.render(film, {});
    return start_seconds(prepared, renderer.report());
}
} // namespace etendue
