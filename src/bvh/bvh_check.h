// Whether a tree is one: after a build in debug, and in tests.
#pragma once

#include "bvh/bvh.h"

#include <string>
#include <vector>

namespace etendue
{
// Every violation as a sentence (the first hundred), in the order found; none for a valid tree. Checked: every node is
// reached exactly once and every reference is in range; every primitive is in exactly one leaf; a leaf has 1 to
// MAX_LEAF_PRIMITIVES primitives of one kind (an empty one only where there are fewer than two primitives); boxes
// contain the boxes below them and the finite primitives, in double precision; the depth is at most 63 + ceil(log2 N),
// and the statistics say what is there.
std::vector<std::string> check_bvh(const Bvh& bvh, const std::vector<Primitive>& primitives);
} // namespace etendue
