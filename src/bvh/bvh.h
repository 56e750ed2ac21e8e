// The binary tree, its statistics, and where it lives.
#pragma once

#include "math/shared.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace etendue
{
struct BvhStatistics {
    std::uint32_t primitive_count = 0;
    std::uint32_t node_count = 0;
    std::uint32_t leaf_count = 0;
    std::uint32_t depth = 0; // inner nodes on the longest way from the root to a leaf: entries a stack needs
    double sah_cost = 0.0;   // surface area heuristic of the collapsed tree, traversal step 1, primitive test 1
    bool built_on_device = false;
    std::vector<std::pair<std::string, double>> phases; // name and seconds, in order
};

// On the host. Nodes refer to positions in leaf_primitives, which lists primitive ids in Morton order.
struct Bvh {
    std::vector<BvhNode> nodes; // at least one
    std::vector<uint> leaf_primitives;
    BvhStatistics statistics;
};
} // namespace etendue
