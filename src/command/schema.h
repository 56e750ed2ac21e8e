// `etendue schema`: the JSON Schema of the native scene format, for editors and validators.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace etendue
{
// Adds the sub-command; when it is chosen, `action` runs it and returns the exit code.
void register_schema(CLI::App& app, std::function<int()>& action);
} // namespace etendue
