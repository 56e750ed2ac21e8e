// Geometry and rays that break trees.
#pragma once

#include "check/primitive_sets.h"
#include "check/traversal.h"

#include <string>
#include <vector>

namespace etendue
{
struct TraversalCase {
    std::string name;
    std::vector<Primitive> primitives;
    std::size_t rays; // that testing every primitive has time for
};

// A soup, a closed mesh, overlapping coplanar pairs, all kinds, random bits, identical, nested, clustered, deep, of no
// size, not finite, huge and tiny ones, and few.
std::vector<TraversalCase> traversal_cases();

// Large triangles in random places.
std::vector<Primitive> soup(std::size_t count);

// The same rays, cut off at what they meet, and one step before and behind it.
std::vector<TestRay> tied_rays(const std::vector<TestRay>& rays, const TracedRays& traced);
} // namespace etendue
