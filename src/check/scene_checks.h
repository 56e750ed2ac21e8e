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

// Of all scenes that expect something; after a scene whose statistical facts are content with less power than
// DEFAULT_DELTA what they say of up to 16 times the samples: a check with --long, "NAME-finely". They must see a bias
// of the context's delta there, or of a quarter of their own where that is more.
std::vector<Check> scene_checks(const std::vector<SceneSource>& sources);
} // namespace etendue
