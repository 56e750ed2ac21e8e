// The linear BVH in plain C++: the same tree, bit for bit, that the kernels build.
#pragma once

#include "bvh/bvh.h"

#include <vector>

namespace etendue
{
// Sort the primitives along a Morton curve, split ranges at the highest bit that differs, refit boxes bottom-up, turn
// subtrees into leaves where the surface area heuristic says so (C. Lauterbach et al. 2009; node numbers as in T.
// Karras 2012). Non-finite primitives are in leaves that no ray meets. Throws SceneError above 2^31 - 1 primitives.
Bvh build_bvh_host(const std::vector<Primitive>& primitives);

// Surface area heuristic of a tree as a multiple of the root's half area; 0 when that is not a number.
double relative_cost(float cost, float half_area);

// Throws SceneError when so many primitives cannot be numbered.
void check_primitive_count(std::size_t count);
} // namespace etendue
