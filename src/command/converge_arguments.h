// What `etendue converge` can be told.
#pragma once

#include "converge/study.h"
#include "util/log.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace etendue
{
struct ConvergeArguments {
    std::string scene, folder;
    std::string reference = "auto";
    std::string checkpoints = "spp:1:1024:x2";
    std::string device = "auto", size, metrics = "mse,relmse";
    std::vector<std::string> configurations, axes, overrides, targets;
    std::uint64_t seeds = 8, first_seed = 1;
    double reference_seconds = 120.0, delta = 0.005;
    bool self_check = false, quiet = false, verbose = false;

    Verbosity verbosity() const { return quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::normal; }
};

// Declare the options.
void add_converge_options(CLI::App& command, ConvergeArguments& arguments);

// The study that the arguments ask for. Reads the scene where an axis depends on it. Throws UsageError and what
// load_scene throws.
StudyOptions study_options(const ConvergeArguments& arguments);

// From METRIC=VALUE. Throws UsageError.
Target parse_target(const std::string& text);
// From WxH. Throws UsageError.
FilmSize parse_size(const std::string& text);
} // namespace etendue
