// Case D2: the fp64 twin of the kernels, fed the same scene and random numbers, finds the same light.
#pragma once

#include "check/check.h"
#include "render/replay.h"

#include <cstdint>
#include <vector>

namespace etendue
{
// Checks of group "device".
std::vector<Check> twin_checks();

// Where the paths of two precisions part: of the pairs that agree up to vertex i, so many have something else there.
struct PathDivergence {
    std::vector<std::uint64_t> pairs, parted; // by vertex
};

// Adds pairs of records of the same samples.
void add_divergence(PathDivergence& total, const std::vector<PathRecord>& a, const std::vector<PathRecord>& b);
} // namespace etendue
