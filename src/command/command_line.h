// The command as it was given, for reports.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace etendue
{
// "etendue render room.json --spp 16": the options that were given, in the order they are declared, as a shell takes
// them.
std::string command_line(const CLI::App& command);
} // namespace etendue
