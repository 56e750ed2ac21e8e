// The command as it was given, for reports.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace etendue
{
// The word within single quotes where a shell would take it for something else.
std::string shell_word(const std::string& word);

// "etendue render room.json --spp 16": the options that were given, in the order they are declared, as a shell takes
// them.
std::string command_line(const CLI::App& command);
} // namespace etendue
