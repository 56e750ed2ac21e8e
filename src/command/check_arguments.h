// What `etendue check` can be told, and which checks that means.
#pragma once

#include "check/check.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace etendue
{
struct CheckArguments {
    std::vector<std::string> what; // groups, scene files and folders
    std::vector<std::string> only; // globs on names
    std::string device = "auto", seed = "fixed", specialize = "off", json;
    double alpha = 1e-3, delta = DEFAULT_DELTA;
    std::optional<double> budget; // seconds
    std::uint32_t lanes = 0;      // 0: as suits the device
    bool is_long = false, list = false, quiet = false, no_cache = false;
};

// Declare the options.
void add_check_options(CLI::App& command, CheckArguments& arguments);

// "analytic", "stiff", ... and "all".
std::vector<std::string> check_group_names();

// The checks that the arguments choose, scenes first; `left_out` counts the long ones without --long. Throws UsageError
// for a name that is neither a group nor a file, and when nothing is left; SceneError, FileError.
std::vector<Check> chosen_checks(const CheckArguments& arguments, std::size_t& left_out);
} // namespace etendue
