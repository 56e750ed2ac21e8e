// What `etendue render` can be told, and what it does to a scene.
#pragma once

#include "render/film.h"
#include "scene/scene.h"
#include "util/log.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace etendue
{
struct RenderArguments {
    std::string scene;
    std::vector<std::string> outputs;
    std::vector<std::string> overrides; // path=value
    std::string device = "auto";
    std::string report;
    std::optional<std::uint64_t> samples, seed;
    std::optional<double> seconds, error;
    double confidence = 0.95;
    std::string size, crop, integrator, accelerator;
    std::string specialize = "on", precision = "single";
    std::uint32_t threads = 0, lanes = 0;
    bool lenient = false, no_cache = false, fast_math = false, quiet = false, verbose = false;

    Verbosity verbosity() const { return quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::normal; }
};

inline constexpr std::uint64_t MAX_SAMPLES = 1'000'000'000'000'000; // per pixel, as in a scene
inline constexpr std::uint64_t MAX_SEED = ~std::uint64_t{0} >> 1;

// Declare --lanes.
void add_lanes_option(CLI::App& command, std::uint32_t& lanes);
// Declare the options that say which picture and on which device, which other commands have too.
void add_picture_options(CLI::App& command, RenderArguments& arguments);
// Declare these and all others.
void add_render_options(CLI::App& command, RenderArguments& arguments);

// Change the scene as the options say: both formats alike. Throws UsageError.
void apply_arguments(Scene& scene, const RenderArguments& arguments);

// The rectangle to render: --crop X,Y,W,H, or the whole film. Throws UsageError.
PixelRect crop_of(const RenderArguments& arguments, const FilmDescription& film);

// The files to write: those named, or the scene's name with .png and .exr in the current folder.
std::vector<std::string> outputs_of(const RenderArguments& arguments);

// Checks that an option is a decimal number within a range.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t largest);

// Numbers between separators, exactly `count` of them. Throws UsageError: `option` must be `expected`.
std::vector<int> integers(const std::string& option, const std::string& text, char separator, std::size_t count,
                          const char* expected);
} // namespace etendue
