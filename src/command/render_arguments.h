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
    std::string specialize = "on";
    std::uint32_t threads = 0, lanes = 0;
    bool lenient = false, no_cache = false, quiet = false, verbose = false;

    Verbosity verbosity() const { return quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::normal; }
};

// Declare the options.
void add_render_options(CLI::App& command, RenderArguments& arguments);

// Change the scene as the options say: both formats alike. Throws UsageError.
void apply_arguments(Scene& scene, const RenderArguments& arguments);

// The rectangle to render: --crop X,Y,W,H, or the whole film. Throws UsageError.
PixelRect crop_of(const RenderArguments& arguments, const FilmDescription& film);

// The files to write: those named, or the scene's name with .png and .exr in the current folder.
std::vector<std::string> outputs_of(const RenderArguments& arguments);
} // namespace etendue
