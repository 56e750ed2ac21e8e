// A replayed path for people and for programs: what float and double say of every vertex.
#pragma once

#include "geometry/geometry.h"
#include "render/replay.h"
#include "scene/scene.h"

#include <optional>
#include <string>

namespace etendue
{
struct ReplayedPath {
    const Scene* scene = nullptr;
    const Geometry* geometry = nullptr;
    ReplaySample sample;
    std::string device;
    PathRecord single;
    std::optional<PathRecord> twin; // in double; nothing where the device has none
};

std::string replay_text(const ReplayedPath& path);
std::string replay_json(const ReplayedPath& path);
} // namespace etendue
