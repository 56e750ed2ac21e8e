// `etendue converge SCENE`: error against run time, as a report.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace etendue
{
// Adds the sub-command; when it is chosen, `action` runs it and returns the exit code.
void register_converge(CLI::App& app, std::function<int()>& action);
} // namespace etendue
