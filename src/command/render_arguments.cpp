// Options of `etendue render`.
#include "command/render_arguments.h"

#include "scene/scene_tables.h"
#include "util/error.h"
#include "util/suggestion.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace etendue
{
namespace
{

// Index of the variant of a table that an option names.
std::size_t variant_number(const Table& table, const std::string& option, const std::string& name)
{
    const std::vector<std::string> names = table.variant_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw UsageError(option + ": " + unknown_name(option.substr(2), name, names));
    return static_cast<std::size_t>(found - names.begin());
}

void set_accelerator(Scene& scene, std::size_t variant)
{
    scene.accelerator.type.reset();
    if (variant > 0) scene.accelerator.type = static_cast<AcceleratorType>(variant - 1);
}
} // namespace

CLI::Validator whole_number(std::uint64_t least, std::uint64_t largest)
{
    const auto check = [=](std::string& text) -> std::string {
        std::uint64_t value = 0;
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        if (error != std::errc() || stop != end || value < least || value > largest)
            return fmt::format("must be a whole number between {} and {}, is \"{}\".", least, largest, text);
        // Without leading zeros, which would make it octal.
        text = std::to_string(value);
        return {};
    };
    return CLI::Validator(check, "");
}

// Checks that an option is a positive number, of seconds for example.
CLI::Validator positive(const std::string& unit)
{
    const auto check = [=](std::string& text) -> std::string {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0.0) return {};
        return fmt::format("must be more than 0{}, is \"{}\".", unit, text);
    };
    return CLI::Validator(check, "");
}

// Checks that an option is a probability that one may be confident of.
CLI::Validator confidence()
{
    const auto check = [](std::string& text) -> std::string {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && value >= 0.5 && value <= 0.9999) return {};
        return fmt::format("must be between 0.5 and 0.9999, is \"{}\".", text);
    };
    return CLI::Validator(check, "");
}

std::vector<int> integers(const std::string& option, const std::string& text, char separator, std::size_t count,
                          const char* expected)
{
    std::vector<int> values;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (values.size() < count) {
        int value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc()) break;
        values.push_back(value);
        at = next;
        if (values.size() == count || at == end || *at != separator) break;
        ++at;
    }
    if (values.size() != count || at != end)
        throw UsageError(fmt::format("{} must be {}, is \"{}\".", option, expected, text));
    return values;
}

void add_lanes_option(CLI::App& command, std::uint32_t& lanes)
{
    command.add_option("--lanes", lanes, "Paths that one work-item carries: 1, 4, 8 or 16 (0: as suits the device)")
        ->check(CLI::IsMember({"0", "1", "4", "8", "16"}))
        ->type_name("N")
        ->capture_default_str();
}

void add_picture_options(CLI::App& command, RenderArguments& a)
{
    command.add_option("SCENE", a.scene, "Scene file: the native format or the course's, told apart by content")
        ->required();
    command
        .add_option("--device", a.device,
                    "Device: an index, platform:device, part of a name, cpu, gpu, all, a comma list,\n"
                    "or auto (a GPU if there is one, else the CPU with most compute units)")
        ->type_name("SPEC")
        ->capture_default_str();
    command.add_option("--spp", a.samples, "Samples per pixel, instead of the scene's")
        ->transform(whole_number(1, MAX_SAMPLES))
        ->type_name("N");
    command.add_option("--seed", a.seed, "Seed of the random numbers, below 2^63, instead of the scene's")
        ->transform(whole_number(0, MAX_SEED))
        ->type_name("N");
    command.add_option("--size", a.size, "Size of the film in pixels")->type_name("WxH");
    command
        .add_option("-D,--define", a.overrides,
                    "Set a value of the scene before it is read, by dots or JSON pointer, e.g.\n"
                    "-D film.size=[64,64] or -D /materials/0/albedo=0.5; checked like the scene")
        ->type_name("path=value")
        ->allow_extra_args(false);
    command
        .add_option("--integrator", a.integrator, "normals, hemisphere, bsdf, light or path, instead of the scene's")
        ->type_name("NAME");
    command.add_option("--accelerator", a.accelerator, "lbvh, none or auto, instead of the scene's")->type_name("NAME");
    command.add_flag("--lenient", a.lenient, "Drop zero-area and non-finite triangles, counted, instead of failing");
    command.add_flag("--fast-math", a.fast_math,
                     "An experiment: let the compiler relax floating point. The picture may be wrong, and says so");
    command.add_flag("--no-cache", a.no_cache, "Neither read nor write compiled kernels in the cache");
    command.add_flag("--quiet", a.quiet, "Show warnings and errors only");
    command.add_flag("-v,--verbose", a.verbose, "Show details");
}

void add_render_options(CLI::App& command, RenderArguments& a)
{
    add_picture_options(command, a);
    command
        .add_option("-o,--output", a.outputs,
                    "File to write; may be given several times. The extension chooses the format:\n"
                    ".exr float with every channel, .hdr, .png or .jpg tone-mapped to sRGB.\n"
                    "Default: the scene's name with .png and .exr in the current folder")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command
        .add_option("--time", a.seconds,
                    "Stop rendering after so many seconds: the next pass is predicted and left out when it\n"
                    "would not fit. Without --spp the number of samples is not limited")
        ->check(positive(" seconds"))
        ->type_name("SECONDS");
    command
        .add_option("--error", a.error,
                    "Stop when the relative error of the picture (0.01: one per cent) is below this: its\n"
                    "upper confidence limit, in two looks in a row. Without --spp the number of samples\n"
                    "is not limited")
        ->check(positive(""))
        ->type_name("E");
    command.add_option("--confidence", a.confidence, "Confidence of the limit that --error stops by")
        ->check(confidence())
        ->type_name("P")
        ->capture_default_str();
    command.add_option("--crop", a.crop, "Render and write this rectangle of the film only")->type_name("X,Y,W,H");
    command
        .add_option("--specialize", a.specialize,
                    "on: kernels without what the scene does not need; off: the general kernel.\n"
                    "The picture is the same, bit for bit")
        ->check(CLI::IsMember({"on", "off"}))
        ->capture_default_str();
    command
        .add_option("--precision", a.precision,
                    "single: float; fp64: the same kernels, scene and random numbers in double, on devices\n"
                    "that have it")
        ->check(CLI::IsMember({"single", "fp64"}))
        ->capture_default_str();
    command.add_option("--report", a.report, "Write everything the render knows about itself as JSON")
        ->type_name("FILE");
    command.add_option("--threads", a.threads, "Use so many compute units of each device (0: all)")
        ->transform(whole_number(0, NO_INDEX))
        ->type_name("N")
        ->capture_default_str();
    add_lanes_option(command, a.lanes);
}

void apply_arguments(Scene& scene, const RenderArguments& a)
{
    if (a.samples) scene.sampler.samples_per_pixel = *a.samples;
    if (a.seed) scene.sampler.seed = *a.seed;
    if (!a.size.empty()) {
        const auto size = integers("--size", a.size, 'x', 2, "WxH, for example 640x480");
        if (size[0] < 1 || size[1] < 1 || size[0] > MAX_FILM_SIZE || size[1] > MAX_FILM_SIZE)
            throw UsageError(fmt::format("--size must be between 1x1 and {0}x{0}, is \"{1}\".", MAX_FILM_SIZE, a.size));
        scene.film.width = size[0];
        scene.film.height = size[1];
    }
    if (!a.integrator.empty())
        scene.integrator.type =
            static_cast<IntegratorType>(variant_number(integrator_table(), "--integrator", a.integrator));
    if (!a.accelerator.empty())
        set_accelerator(scene, variant_number(accelerator_table(), "--accelerator", a.accelerator));
}

PixelRect crop_of(const RenderArguments& a, const FilmDescription& film)
{
    if (a.crop.empty()) return {0, 0, film.width, film.height};
    const auto crop = integers("--crop", a.crop, ',', 4, "X,Y,W,H, for example 100,50,64,64");
    return {crop[0], crop[1], crop[2], crop[3]};
}

std::vector<std::string> outputs_of(const RenderArguments& a)
{
    if (!a.outputs.empty()) return a.outputs;
    const std::string stem = std::filesystem::path(a.scene).stem().string();
    return {stem + ".png", stem + ".exr"};
}
} // namespace etendue
