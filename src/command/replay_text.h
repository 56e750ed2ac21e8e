// A replayed path for people and for programs: what float and double say of every vertex, and where they part.
#pragma once

#include "geometry/geometry.h"
#include "render/replay.h"
#include "scene/scene.h"

#include <cstdint>
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

// How far two records of one path agree.
struct PathDifference {
    std::optional<std::uint32_t> parts_at; // first vertex that lies on another primitive, or that only one path has
    // The largest relative difference at the vertices before: of lengths relative to the scene's half-extent, of unit
    // vectors absolute; 0 where everything is equal.
    double largest = 0.0;
    std::uint32_t vertex = 0; // where it is
    std::string quantity;     // what it is of
};
PathDifference compare_paths(const PathRecord& a, const PathRecord& b);

std::string replay_text(const ReplayedPath& path);
std::string replay_json(const ReplayedPath& path);
} // namespace etendue
