// Options of `etendue converge`.
#include "command/converge_arguments.h"

#include "command/render_arguments.h"
#include "converge/curve.h"
#include "scene/scene_tables.h"
#include "util/suggestion.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace etendue
{
namespace
{
constexpr std::uint64_t MOST_SEEDS = 10'000;

std::string metric_name(const std::string& option, const std::string& name)
{
    const std::vector<std::string>& known = error_names();
    if (std::find(known.begin(), known.end(), name) == known.end())
        throw UsageError(option + ": " + unknown_name("metric", name, known));
    return name;
}

std::vector<std::string> parse_metrics(const std::string& text)
{
    std::vector<std::string> metrics{""};
    for (const char c : text)
        if (c == ',')
            metrics.emplace_back();
        else
            metrics.back() += c;
    for (const std::string& name : metrics) metric_name("--metrics", name);
    return metrics;
}

std::vector<Configuration> configurations_of(const ConvergeArguments& arguments)
{
    std::vector<Configuration> configurations;
    for (const std::string& text : arguments.configurations) configurations.push_back(parse_configuration(text));
    if (!arguments.axes.empty()) {
        const Scene scene = load_configured(arguments.scene, arguments.overrides).scene;
        const std::vector<DeviceInfo> devices = list_devices().devices;
        for (const std::string& axis : arguments.axes)
            for (Configuration& configuration : configurations_along(axis, scene, devices))
                configurations.push_back(std::move(configuration));
    }
    if (configurations.empty()) configurations.push_back(parse_configuration("default"));
    return configurations;
}

void check_numbers(const ConvergeArguments& a)
{
    if (a.seeds < 1 || a.seeds > MOST_SEEDS)
        throw UsageError(fmt::format("--seeds must be between 1 and {}, is {}.", MOST_SEEDS, a.seeds));
    if (a.first_seed > MAX_SEED - MOST_SEEDS)
        throw UsageError(fmt::format("--seed must be at most {}, is {}.", MAX_SEED - MOST_SEEDS, a.first_seed));
    if (!(a.reference_seconds > 0.0 && std::isfinite(a.reference_seconds)))
        throw UsageError(fmt::format("--reference-seconds must be more than 0, is {}.", a.reference_seconds));
    if (!(a.delta > 0.0 && a.delta < 1.0))
        throw UsageError(fmt::format("--delta must be between 0 and 1, is {}.", a.delta));
}
} // namespace

void add_converge_options(CLI::App& command, ConvergeArguments& a)
{
    command.add_option("SCENE", a.scene, "Scene file: the native format or the course's");
    command.add_option("--out", a.folder, "Folder for the report, made where it is not there")->type_name("DIR");
    command
        .add_option("--reference", a.reference,
                    "auto: what the scene expects of itself, else a picture rendered by another\n"
                    "estimator with random numbers of its own, kept for later studies. analytic: only what\n"
                    "the scene expects. A picture file. none: the spread between seeds, blind to bias")
        ->type_name("KIND|FILE")
        ->capture_default_str();
    command.add_option("--reference-seconds", a.reference_seconds, "Time that rendering a reference may take at most")
        ->type_name("SECONDS")
        ->capture_default_str();
    command.add_option("--seeds", a.seeds, "Independent runs of each configuration")
        ->type_name("N")
        ->capture_default_str();
    command.add_option("--seed", a.first_seed, "The first of the seeds")->type_name("N")->capture_default_str();
    command
        .add_option("--checkpoints", a.checkpoints,
                    "When to measure: spp:FIRST:LAST:xFACTOR or time:FIRST:LAST:xFACTOR. The film is\n"
                    "looked at when a pass ends: 1, 2, 4, ... 64 samples, then every 64")
        ->type_name("SPEC")
        ->capture_default_str();
    command
        .add_option("--config", a.configurations,
                    "Something to compare; may be given several times. NAME:path=value,... changes the\n"
                    "scene like -D; also render.specialize=on|off, render.lanes=N, render.device=SPEC,\n"
                    "render.precision=single|fp64 and render.fast_math=on|off")
        ->type_name("NAME:path=value,...")
        ->allow_extra_args(false);
    command
        .add_option("--compare", a.axes,
                    "Configurations along an axis; may be given several times: integrators, heuristics,\n"
                    "sphere_lights, samplers, roulette, accelerators, specialization, precision, fast_math\n"
                    "or devices")
        ->type_name("AXIS")
        ->allow_extra_args(false);
    command.add_option("--device", a.device, "Device of every configuration that names none, as for render")
        ->type_name("SPEC")
        ->capture_default_str();
    command
        .add_option("--size", a.size, "Size of the film in pixels; default: the scene's, its longer edge at most 64")
        ->type_name("WxH");
    command.add_option("-D,--define", a.overrides, "Set a value of the scene in every configuration, as for render")
        ->type_name("path=value")
        ->allow_extra_args(false);
    command
        .add_option("--metrics", a.metrics,
                    "What the plots show: mse, relmse, mape, max_relative, trimmed_relmse; the first is\n"
                    "in converge.svg")
        ->type_name("LIST")
        ->capture_default_str();
    command
        .add_option("--target", a.targets,
                    "Error whose time is asked for; may be given several times.\n"
                    "Default: relmse=1e-1, relmse=1e-2 and relmse=1e-3")
        ->type_name("METRIC=VALUE")
        ->allow_extra_args(false);
    command.add_option("--delta", a.delta, "Relative bias of the mean that must not be able to hide")
        ->type_name("SHARE")
        ->capture_default_str();
    command.add_flag("--self-check", a.self_check, "Only measure the furnace whose error is known, and say the result");
    command.add_flag("--quiet", a.quiet, "Show warnings and errors only");
    command.add_flag("-v,--verbose", a.verbose, "Show details");
}

Target parse_target(const std::string& text)
{
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
        throw UsageError(fmt::format("--target must be METRIC=VALUE, for example relmse=1e-2, is \"{}\".", text));
    Target target{metric_name("--target", text.substr(0, equals)), 0.0};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + equals + 1, end, target.value);
    if (error != std::errc() || stop != end || !(target.value > 0.0 && std::isfinite(target.value)))
        throw UsageError(
            fmt::format("--target: the value must be a number above 0, is \"{}\".", text.substr(equals + 1)));
    return target;
}

FilmSize parse_size(const std::string& text)
{
    FilmSize size;
    const char* const end = text.data() + text.size();
    const auto [x, error] = std::from_chars(text.data(), end, size.width);
    bool valid = error == std::errc() && x != end && *x == 'x';
    if (valid) {
        const auto [stop, other] = std::from_chars(x + 1, end, size.height);
        valid = other == std::errc() && stop == end;
    }
    if (!valid || size.width < 1 || size.height < 1 || size.width > MAX_FILM_SIZE || size.height > MAX_FILM_SIZE)
        throw UsageError(fmt::format("--size must be WxH between 1x1 and {0}x{0}, for example 128x96, is \"{1}\".",
                                     MAX_FILM_SIZE, text));
    return size;
}

StudyOptions study_options(const ConvergeArguments& a)
{
    if (a.scene.empty()) throw UsageError("A scene file is needed, for example scenes/course-box/simple.json.");
    if (a.folder.empty()) throw UsageError("--out DIR is needed: where the report goes.");
    check_numbers(a);
    StudyOptions options;
    options.preparation.scene = a.scene;
    options.preparation.overrides = a.overrides;
    if (!a.size.empty()) options.preparation.size = parse_size(a.size);
    options.preparation.device = a.device;
    options.preparation.cache = KernelCache::standard();
    options.checkpoints = parse_checkpoints(a.checkpoints);
    options.seeds = a.seeds;
    options.first_seed = a.first_seed;
    options.reference = a.reference;
    options.reference_seconds = a.reference_seconds;
    options.delta = a.delta;
    options.metrics = parse_metrics(a.metrics);
    if (!a.targets.empty()) options.targets.clear();
    for (const std::string& text : a.targets) options.targets.push_back(parse_target(text));
    options.configurations = configurations_of(a);
    check_names(options.configurations);
    return options;
}
} // namespace etendue
