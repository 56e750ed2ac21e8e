/* Which subtrees become leaves, and the nodes that stay. Surface area heuristic (J. Goldsmith and J. Salmon 1987) with
 * cost 1 for a step of the traversal and 1 for a primitive. */
#pragma once
#include "algorithm/reduce.h"
#include "shared/bvh_node.h"
#include "shared/limits.h"
#include "shared/primitive.h"

/* What a subtree is to its parent. Costs are times half areas, so that nothing is divided. */
typedef struct Subtree {
    Aabb box;
    float cost;
    uint kinds; /* bit k: has primitives of kind k */
    uint depth; /* inner nodes on the longest way down, itself included; 0 for a leaf */
    uint is_leaf;
} Subtree;

STATIC Subtree subtree_of_primitive(Aabb box, uint kind)
{
    Subtree s;
    s.box = box;
    s.cost = aabb_half_area(box);
    s.kinds = 1u << kind;
    s.depth = 0u;
    s.is_leaf = 1u;
    return s;
}

/* The parent of two: a leaf when that is not dearer, its primitives are few and of one kind, and it is not the root. */
STATIC Subtree subtree_of_children(Subtree a, Subtree b, uint primitive_count, bool is_root)
{
    Subtree s;
    s.box = aabb_union(a.box, b.box);
    s.kinds = a.kinds | b.kinds;
    const float area = aabb_half_area(s.box);
    const float inner_cost = area + (a.cost + b.cost);
    const float leaf_cost = (float)primitive_count * area;
    const bool one_kind =
        s.kinds == 1u << PRIMITIVE_TRIANGLE || s.kinds == 1u << PRIMITIVE_SPHERE || s.kinds == 1u << PRIMITIVE_DISK;
    s.is_leaf = !is_root && one_kind && primitive_count <= MAX_LEAF_PRIMITIVES && leaf_cost <= inner_cost;
    s.cost = s.is_leaf ? leaf_cost : inner_cost;
    s.depth = s.is_leaf ? 0u : 1u + max(a.depth, b.depth);
    return s;
}

/* A subtree's kinds, depth and is_leaf in one word. */
STATIC uint subtree_pack(Subtree s)
{
    return s.kinds | s.is_leaf << 3 | s.depth << 4;
}
STATIC uint packed_kinds(uint word)
{
    return word & 7u;
}
STATIC uint packed_is_leaf(uint word)
{
    return word >> 3 & 1u;
}
STATIC uint packed_depth(uint word)
{
    return word >> 4;
}

/* Whether inner node i stays: neither it nor anything above it is a leaf. Only ancestors of few primitives can be. */
STATIC bool node_stays(global const uint* packed, global const uint2* ranges, global const uint* parents, uint i)
{
    while (ranges[i].y - ranges[i].x < MAX_LEAF_PRIMITIVES) {
        if (packed_is_leaf(packed[i])) return false;
        if (i == 0u) return true;
        i = parents[i];
    }
    return true;
}

/* The reference and primitive count of a child as BvhNode stores them. */
STATIC uint2 final_reference(uint reference, uint is_leaf, global const uint2* ranges, global const uint* new_indices)
{
    if (reference & LEAF_BIT) return (uint2)(reference, 1u);
    if (!is_leaf) return (uint2)(new_indices[reference], 0u);
    const uint2 range = ranges[reference];
    return (uint2)(LEAF_BIT | range.x, range.y - range.x + 1u);
}
