/* What each inner node holds, from its two children. */
#pragma once
#include "bvh/collapse.h"

/* The tree under construction. A child reference is an inner node, or LEAF_BIT | position in sorted order. Two float4 a
 * box; a primitive's kind is in its lower.w, an inner node's cost in its lower.w. `inner_boxes` and `packed` are
 * volatile since another work-item may have written them a moment ago. */
typedef struct TreeView {
    global const float4* sorted_boxes;
    global const uint2* children;
    global const uint2* ranges;
    global volatile float4* inner_boxes;
    global volatile uint* packed;
} TreeView;

STATIC Subtree load_subtree(TreeView tree, uint reference)
{
    Subtree s;
    if (reference & LEAF_BIT) {
        const uint position = reference & ~LEAF_BIT;
        const Aabb box = {tree.sorted_boxes[2u * position], tree.sorted_boxes[2u * position + 1u]};
        return subtree_of_primitive(box, (uint)box.lower.w);
    }
    s.box.lower = tree.inner_boxes[2u * reference];
    s.box.upper = tree.inner_boxes[2u * reference + 1u];
    s.cost = s.box.lower.w;
    const uint word = tree.packed[reference];
    s.kinds = packed_kinds(word);
    s.depth = packed_depth(word);
    s.is_leaf = packed_is_leaf(word);
    return s;
}

/* Compute inner node i from its children, which are complete, and store it. */
STATIC void refit_node(TreeView tree, uint i)
{
    const uint2 child = tree.children[i];
    const uint2 range = tree.ranges[i];
    Subtree s =
        subtree_of_children(load_subtree(tree, child.x), load_subtree(tree, child.y), range.y - range.x + 1u, i == 0u);
    s.box.lower.w = s.cost;
    s.box.upper.w = 0.0;
    tree.inner_boxes[2u * i] = s.box.lower;
    tree.inner_boxes[2u * i + 1u] = s.box.upper;
    tree.packed[i] = subtree_pack(s);
}
