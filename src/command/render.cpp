// `etendue render`: load, render, write.
#include "command/render.h"

#include "command/command_line.h"
#include "command/render_arguments.h"
#include "command/replay.h"
#include "image/image_io.h"
#include "render/error_target.h"
#include "render/render_settings.h"
#include "render/renderer.h"
#include "render/report.h"
#include "scene/scene_loader.h"
#include "util/file.h"
#include "util/interrupt.h"
#include "util/progress.h"
#include "util/stopwatch.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

namespace etendue
{
namespace
{
const char* const RENDER_EXAMPLES =
    "Examples:\n"
    "  etendue render scenes/course-box/simple.json\n"
    "  etendue render room.json -o room.exr -o room.png --spp 256 --report report.json\n"
    "  etendue render room.json --time 30 --device gpu\n"
    "  etendue render room.json --error 0.02 --time 600\n"
    "  etendue render room.json --integrator normals -o normals.png\n"
    "  etendue render room.json -D integrator.max_depth=1 --crop 100,100,64,64\n"
    "\n"
    "Ctrl-C finishes the launch in flight and writes the samples there are (exit code 130); a\n"
    "second one ends at once. The same seed on the same device gives the same bits.";

// More samples than a life is long, for renders that only time or their error ends.
constexpr std::uint64_t UNLIMITED_SAMPLES = std::uint64_t{1} << 40;

// Only EXR files hold albedo, normal and depth.
bool is_exr(const std::string& path)
{
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension == ".exr";
}

RenderOptions render_options(const RenderArguments& arguments, Log& log)
{
    RenderOptions options;
    const DeviceList list = list_devices();
    options.devices = select_devices(list, arguments.device);
    for (const std::string& warning : list.warnings) log.warning(warning);
    options.threads = arguments.threads;
    options.lanes = arguments.lanes;
    options.specialize = arguments.specialize == "on";
    options.precision = arguments.precision == "fp64" ? Precision::fp64 : Precision::single;
    options.fast_math = arguments.fast_math;
    if (options.fast_math)
        log.warning("--fast-math relaxes floating point: the picture may be wrong, and its metadata say so.");
    options.cache = arguments.no_cache ? KernelCache::none() : KernelCache::standard();
    if (!options.cache.warning().empty()) log.warning(options.cache.warning());
    return options;
}

void describe(const Scene& scene, const Geometry& geometry, Log& log)
{
    log.info(fmt::format("{}: {} triangles, {} spheres, {} disks, {} lights; {}x{} pixels", scene.file,
                         geometry.triangle_count, geometry.sphere_count, geometry.disk_count, geometry.lights.size(),
                         scene.film.width, scene.film.height));
}

// A film's relative error for a progress line: of a large film it takes long, so it is worked out anew only when that
// costs no more than a fiftieth of the time.
class ShownError
{
public:
    explicit ShownError(const Film& film) : film_(film) {}

    double operator()()
    {
        if (since_.seconds() < 50.0 * cost_) return error_;
        since_.restart();
        error_ = film_.relative_error();
        cost_ = since_.seconds();
        return error_;
    }

private:
    const Film& film_;
    double error_ = 0.0, cost_ = 0.0;
    Stopwatch since_;
};

RenderLimits render_limits(const Scene& scene, const RenderArguments& arguments)
{
    RenderLimits limits;
    limits.samples_per_pixel = wanted_samples(scene);
    const bool is_noisy = scene.integrator.type != IntegratorType::normals;
    if ((arguments.seconds || arguments.error) && !arguments.samples && is_noisy)
        limits.samples_per_pixel = UNLIMITED_SAMPLES;
    limits.seconds = arguments.seconds;
    limits.stop = interrupted;
    return limits;
}

// A target for the film's error where one is wanted. Throws UsageError when the error cannot be told.
std::optional<ErrorTarget> error_target(const Scene& scene, const Film& film, const RenderArguments& arguments)
{
    if (!arguments.error) return {};
    check_error_target(scene, film.crop());
    return std::optional<ErrorTarget>(std::in_place, film, *arguments.error, arguments.confidence);
}

// Render onto the film and show how far it is, also on the way to an error that falls with the root of the samples;
// returns the film's relative error.
double render_film(Renderer& renderer, Film& film, RenderLimits limits, std::optional<double> wanted_error, Log& log)
{
    Progress progress(log);
    ShownError error(film);
    RenderProgress last;
    const std::uint64_t shown_total = limits.samples_per_pixel < UNLIMITED_SAMPLES ? limits.samples_per_pixel : 0;
    const auto state = [&](double relative_error) {
        if (wanted_error && std::isfinite(relative_error) && relative_error > *wanted_error)
            last.fraction = std::max(last.fraction, std::pow(*wanted_error / relative_error, 2.0));
        return ProgressState{last.fraction, last.samples_per_pixel, shown_total, static_cast<double>(last.rays),
                             relative_error};
    };
    limits.progress = [&](const RenderProgress& now) {
        last = now;
        if (progress.due()) progress.show(state(error()));
    };
    renderer.render(film, limits);
    if (!renderer.report().interrupted) last.fraction = 1.0;
    const double relative_error = film.relative_error();
    progress.finish(state(relative_error));
    return relative_error;
}

void write_pictures(const RenderArguments& arguments, const Scene& scene, const Image& image, Log& log)
{
    for (const std::string& path : outputs_of(arguments)) {
        const WriteReport written = write_image(image, path, {scene.film.tone_map, scene.film.exposure});
        if (written.non_finite_values > 0)
            log.warning(fmt::format("{}: {} values are not finite.", path, written.non_finite_values));
        log.info(fmt::format("wrote {}", path));
    }
}

// The report, with a command for the first accident of each kind that shows its path.
RenderReport with_replays(RenderReport report, const RenderArguments& arguments, const Scene& scene)
{
    for (HealthRecord& record : report.health)
        if (record.first)
            record.replay = replay_line(arguments, scene, {record.first->x, record.first->y, record.first->sample});
    return report;
}

void report_accidents(const RenderReport& report, Log& log)
{
    for (std::size_t kind = 0; kind < HEALTH_KINDS; ++kind) {
        const HealthRecord& record = report.health[kind];
        if (record.count == 0) continue;
        log.warning(
            fmt::format("{} samples counted as zero because of {}; the first is pixel {},{} sample {} vertex {}: {}",
                        record.count, health_name(kind), record.first->x, record.first->y, record.first->sample,
                        record.first->vertex, record.replay));
    }
}

void describe_target(const ErrorTarget::Report& target, const RenderReport& report, Log& log)
{
    const std::string found =
        std::isfinite(target.error.relative_error)
            ? fmt::format("relative error {:.4g} by {}; the true one is above {:.4g} and below {:.4g}, each with a "
                          "confidence of {:g} %",
                          target.error.relative_error, name_of(report.error_estimate), target.error.low,
                          target.error.high, 100.0 * target.confidence)
            : "relative error unknown";
    log.info(fmt::format("error {:g} {} after {} samples per pixel and {} looks: {}", target.wanted,
                         target.reached ? "reached" : "not reached", report.samples_per_pixel, target.looks, found));
    if (target.error.heavy_tail())
        log.warning(
            fmt::format("{:.0f} % of the squared error is in the worst 0.1 % of the pixels: rare bright samples "
                        "make the error, and others may be still to come.",
                        100.0 * target.error.top_share));
}

void summarise(const RenderReport& report, double relative_error, Log& log)
{
    for (const DeviceReport& device : report.devices)
        log.detail(fmt::format("{}: {} samples in {} launches, {} lanes, {} of {} features compiled in",
                               device.info.name, device.samples, device.units, device.specialization.lanes,
                               std::popcount(device.specialization.features), static_cast<int>(Feature::COUNT)));
    log.info(fmt::format("{} samples per pixel in {:.2f} s: {:.2f} Mrays/s, relative error {}, set-up {:.2f} s",
                         report.samples_per_pixel, report.render_seconds, report.rays_per_second() / 1e6,
                         std::isfinite(relative_error) ? fmt::format("{:.4f}", relative_error) : "unknown",
                         report.setup_seconds));
    if (report.interrupted) log.warning("interrupted: the pictures hold the samples there were.");
}

// Seconds of every phase of the program, whichever of several devices took longest.
Phases phases_of(const RenderReport& report, double parse, const Geometry& geometry, double geometry_seconds)
{
    const auto slowest = [&](double DeviceReport::*member) {
        double seconds = 0.0;
        for (const DeviceReport& device : report.devices) seconds = std::max(seconds, device.*member);
        return seconds;
    };
    double canary = 0.0;
    for (const DeviceReport& device : report.devices) canary = std::max(canary, device.canary.seconds);
    return {{"parse", parse},
            {"mesh_load", geometry.statistics.mesh_seconds},
            {"geometry", geometry_seconds - geometry.statistics.mesh_seconds},
            {"upload", slowest(&DeviceReport::upload_seconds)},
            {"bvh", slowest(&DeviceReport::bvh_seconds)},
            {"canary", canary},
            {"compile", slowest(&DeviceReport::compile_seconds)},
            {"first_launch", report.first_launch_seconds},
            {"render", report.render_seconds - report.first_launch_seconds}};
}

int render(const RenderArguments& arguments, const std::string& command_line)
{
    Log& log = standard_log();
    log.set_verbosity(arguments.verbosity());
    const std::vector<std::string> outputs = outputs_of(arguments);
    for (const std::string& path : outputs) check_image_path(path);
    if (!arguments.report.empty()) check_writable(arguments.report);
    const bool has_aov = std::any_of(outputs.begin(), outputs.end(), is_exr);
    const InterruptGuard guard;

    Stopwatch watch;
    LoadedScene loaded = load_scene(arguments.scene, arguments.overrides);
    Scene& scene = loaded.scene;
    for (const std::string& warning : loaded.warnings) log.warning(warning);
    apply_arguments(scene, arguments);
    Film film(scene.film.width, scene.film.height, crop_of(arguments, scene.film), has_aov);
    std::optional<ErrorTarget> target = error_target(scene, film, arguments);
    const double parse_seconds = watch.restart();
    const Geometry geometry = make_geometry(scene, {arguments.lenient});
    for (const std::string& warning : geometry.warnings) log.warning(warning);
    describe(scene, geometry, log);
    const double geometry_seconds = watch.restart();

    Renderer renderer(scene, geometry, has_aov, render_options(arguments, log));
    RenderLimits limits = render_limits(scene, arguments);
    if (target) limits.after_pass = [&](const PassEnd& end) { return target->go_on(end); };
    const double relative_error = render_film(renderer, film, limits, arguments.error, log);
    const RenderReport report = with_replays(renderer.report(), arguments, scene);
    if (film.total_samples() == 0) {
        log.warning("interrupted before the first sample: nothing is written.");
        return static_cast<int>(ExitCode::interrupted);
    }

    Phases phases = phases_of(report, parse_seconds, geometry, geometry_seconds);
    for (const std::string& warning : report.warnings) log.warning(warning);
    Stopwatch write_watch;
    Image image = film.resolve(1.0 / geometry.normalisation.scale);
    image.metadata = image_metadata(scene, report, phases);
    write_pictures(arguments, scene, image, log);
    phases.emplace_back("write", write_watch.seconds());
    report_accidents(report, log);
    summarise(report, relative_error, log);
    std::optional<ErrorTarget::Report> target_report;
    if (target) describe_target(target_report.emplace(target->report()), report, log);
    renderer.store_in_cache();
    if (!arguments.report.empty())
        write_file(arguments.report,
                   report_json(scene, geometry, report, phases, relative_error, command_line, target_report));
    return static_cast<int>(report.interrupted ? ExitCode::interrupted : ExitCode::success);
}
} // namespace

void register_render(CLI::App& app, std::function<int()>& action)
{
    CLI::App* command = app.add_subcommand("render", "Render a scene into pictures");
    command->footer(RENDER_EXAMPLES);
    const auto arguments = std::make_shared<RenderArguments>();
    add_render_options(*command, *arguments);
    command->callback([arguments, command, &action] {
        action = [arguments, line = command_line(*command)] { return render(*arguments, line); };
    });
}
} // namespace etendue
