// `etendue compare A B`: how far a picture is from a reference, and whether noise explains it.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace etendue
{
// Adds the sub-command; when it is chosen, `action` runs it and returns the exit code: 5 where the pictures differ.
void register_compare(CLI::App& app, std::function<int()>& action);
} // namespace etendue
