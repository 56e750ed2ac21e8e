// `etendue check`: does this program, on this device, compute what it must?
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace etendue
{
// Adds the sub-command; when it is chosen, `action` runs it and returns the exit code.
void register_check(CLI::App& app, std::function<int()>& action);
} // namespace etendue
