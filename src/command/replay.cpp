// `etendue replay`: load, replay twice, print side by side.
#include "command/replay.h"

#include "command/replay_text.h"
#include "scene/scene_loader.h"
#include "util/log.h"

#include <iostream>
#include <memory>

#include <fmt/format.h>

namespace etendue
{
namespace
{
const char* const REPLAY_EXAMPLES =
    "Examples:\n"
    "  etendue replay scenes/course-box/simple.json --pixel 320,240 --sample 0\n"
    "  etendue replay room.json --pixel 17,4 --sample 93 --seed 7 -D integrator.max_depth=4 --json\n"
    "\n"
    "A render that met something not finite or negative ends with the command that replays the first such\n"
    "path. Give every option that changes the picture again. Positions are those of the scene, in metres.";

// More vertices than anyone reads; the path itself may be longer.
constexpr std::uint32_t MAX_SHOWN_VERTICES = 1024;

struct ReplayArguments {
    RenderArguments render;
    std::string pixel;
    std::uint64_t sample = 0;
    bool as_json = false;
};

ReplaySample sample_of(const ReplayArguments& arguments, const FilmDescription& film)
{
    const auto pixel = integers("--pixel", arguments.pixel, ',', 2, "X,Y, for example 12,7");
    if (pixel[0] < 0 || pixel[1] < 0 || pixel[0] >= film.width || pixel[1] >= film.height)
        throw UsageError(fmt::format("--pixel {},{} is outside the film of {}x{} pixels.", pixel[0], pixel[1],
                                     film.width, film.height));
    return {static_cast<std::uint32_t>(pixel[0]), static_cast<std::uint32_t>(pixel[1]), arguments.sample};
}

int replay_one(const ReplayArguments& arguments)
{
    const RenderArguments& render = arguments.render;
    Log& log = standard_log();
    log.set_verbosity(render.verbosity());
    LoadedScene loaded = load_scene(render.scene, render.overrides);
    for (const std::string& warning : loaded.warnings) log.warning(warning);
    apply_arguments(loaded.scene, render);
    const ReplaySample sample = sample_of(arguments, loaded.scene.film);
    const Geometry geometry = make_geometry(loaded.scene, {render.lenient});
    for (const std::string& warning : geometry.warnings) log.warning(warning);

    const Device device(select_devices(list_devices(), render.device).front());
    const KernelCache cache = render.no_cache ? KernelCache::none() : KernelCache::standard();
    const auto path = [&](Precision precision) {
        Replayer replayer(device, loaded.scene, geometry, precision, {true, cache, render.fast_math});
        const PathRecord record = replayer.replay({&sample, 1}, MAX_SHOWN_VERTICES).front();
        if (!device.caches_kernels()) replayer.store_in_cache();
        return record;
    };
    ReplayedPath replayed{&loaded.scene, &geometry, sample, device.info().name, path(Precision::single), {}};
    if (device.info().has_double) replayed.twin = path(Precision::fp64);
    std::cout << (arguments.as_json ? replay_json(replayed) : replay_text(replayed)) << std::flush;
    return static_cast<int>(ExitCode::success);
}
} // namespace

std::string replay_line(const RenderArguments& a, const Scene& scene, const ReplaySample& sample)
{
    std::vector<std::string> options;
    const auto add = [&](const std::string& option, const std::string& value) {
        if (!value.empty()) options.insert(options.end(), {option, value});
    };
    if (a.samples) add("--spp", std::to_string(*a.samples));
    add("--size", a.size);
    add("--integrator", a.integrator);
    add("--accelerator", a.accelerator);
    for (const std::string& override : a.overrides) add("-D", override);
    if (a.lenient) options.emplace_back("--lenient");
    if (a.fast_math) options.emplace_back("--fast-math");
    if (a.device != "auto") add("--device", a.device);
    return replay_command(a.scene, sample, scene.sampler.seed, options);
}

void register_replay(CLI::App& app, std::function<int()>& action)
{
    CLI::App* command = app.add_subcommand("replay", "Show one path of a render, vertex by vertex");
    command->footer(REPLAY_EXAMPLES);
    const auto arguments = std::make_shared<ReplayArguments>();
    command->add_option("--pixel", arguments->pixel, "Pixel of the whole film, from the top left")
        ->type_name("X,Y")
        ->required();
    command->add_option("--sample", arguments->sample, "Number of the sample, from 0")
        ->transform(whole_number(0, MAX_SAMPLES - 1))
        ->type_name("S")
        ->required();
    command->add_flag("--json", arguments->as_json, "Print JSON");
    add_picture_options(*command, arguments->render);
    command->callback([arguments, &action] { action = [arguments] { return replay_one(*arguments); }; });
}
} // namespace etendue
