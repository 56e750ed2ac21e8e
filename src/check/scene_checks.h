// Checks made of scenes with an "expect" block.
#pragma once

#include "check/check.h"
#include "check/scene_source.h"
#include "scene/scene.h"

#include <optional>
#include <vector>

namespace etendue
{
// One result for each fact of the scene. Works out every formula, so that a wrong one is found before anything runs.
// Throws SceneError; nothing where the scene expects nothing.
std::optional<Check> scene_check(const SceneSource& source);

// What a scene's statistical facts that are content with less power than DEFAULT_DELTA say of up to 16 times the
// samples: a check with --long, "NAME-finely". Its facts must see a bias of the context's delta, or of a quarter of
// their own where that is more. Throws SceneError; nothing where there is no such fact.
std::optional<Check> fine_scene_check(const SceneSource& source);

// Both of all scenes that expect something.
std::vector<Check> scene_checks(const std::vector<SceneSource>& sources);
} // namespace etendue
