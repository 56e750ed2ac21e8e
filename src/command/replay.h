// `etendue replay SCENE --pixel X,Y --sample S`: one path of a render, vertex by vertex, in float and in double.
#pragma once

#include "command/render_arguments.h"
#include "render/replay.h"
#include "scene/scene.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace etendue
{
// Adds the sub-command; when it is chosen, `action` runs it and returns the exit code.
void register_replay(CLI::App& app, std::function<int()>& action);

// The command line that replays a sample of the render that `arguments` began, for a shell. `scene` is what they made
// of the file.
std::string replay_line(const RenderArguments& arguments, const Scene& scene, const ReplaySample& sample);
} // namespace etendue
