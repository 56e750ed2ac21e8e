/* The build of the binary tree, in this order; the sort between morton_codes and build_hierarchy, and the prefix sum
 * between mark_nodes and emit_nodes, are in sort.cl. The same program for every scene. Global sizes may be rounded up.
 */
#include "bvh/collapse.h"
#include "bvh/hierarchy.h"
#include "bvh/morton.h"
#include "bvh/primitive_box.h"
#include "bvh/refit.h"
#include "shared/structs.h"

/* The box of every primitive (lower.w: its kind), and the box around the box centres of each chunk. */
kernel void primitive_boxes(global const Primitive* primitives, uint count, uint chunk_size, global float4* boxes,
                            global float4* chunk_bounds)
{
    const uint chunk = (uint)get_global_id(0);
    const uint end = min((chunk + 1u) * chunk_size, count);
    Aabb bounds = aabb_empty();
    for (uint i = chunk * chunk_size; i < end; ++i) {
        const Primitive primitive = primitives[i];
        Aabb box = primitive_box(primitive);
        if (box.lower.x <= box.upper.x) {
            const float4 centre = aabb_centre(box);
            const Aabb point = {centre, centre};
            bounds = aabb_union(bounds, point);
        }
        box.lower.w = (float)primitive_kind(primitive);
        boxes[2u * i] = box.lower;
        boxes[2u * i + 1u] = box.upper;
    }
    chunk_bounds[2u * chunk] = bounds.lower;
    chunk_bounds[2u * chunk + 1u] = bounds.upper;
}

/* The box around the boxes of each chunk. */
kernel void reduce_bounds(global const float4* boxes, uint count, uint chunk_size, global float4* chunk_bounds)
{
    const uint chunk = (uint)get_global_id(0);
    const Aabb bounds = reduce_boxes(boxes, chunk * chunk_size, min((chunk + 1u) * chunk_size, count));
    chunk_bounds[2u * chunk] = bounds.lower;
    chunk_bounds[2u * chunk + 1u] = bounds.upper;
}

/* Key and value of the sort for every primitive; `bounds` is the box around all centres. */
kernel void morton_codes(global const float4* boxes, uint count, global const float4* bounds, global ulong* codes,
                         global uint* indices)
{
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Aabb centres = {bounds[0], bounds[1]};
    const Aabb box = {boxes[2u * i], boxes[2u * i + 1u]};
    codes[i] = morton_code(box, centres.lower, morton_scale(centres));
    indices[i] = i;
}

/* Primitive boxes in sorted order: a sweep of its own, so that the scattered reads overlap. */
kernel void sort_boxes(global const float4* boxes, global const uint* sorted_primitives, uint count,
                       global float4* sorted_boxes)
{
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const uint primitive = sorted_primitives[i];
    sorted_boxes[2u * i] = boxes[2u * primitive];
    sorted_boxes[2u * i + 1u] = boxes[2u * primitive + 1u];
}

/* Children, ranges and parents of the count - 1 inner nodes; parents[count - 1 + p] is that of sorted position p. */
kernel void build_hierarchy(global const ulong* codes, uint count, global uint2* children, global uint2* ranges,
                            global uint* parents, global uint* arrivals)
{
    const uint i = (uint)get_global_id(0);
    if (i >= count - 1u) return;
    const RadixNode node = radix_node(codes, (int)count, (int)i);
    const uint left = node.split;
    const uint right = node.split + 1u;
    const bool left_is_leaf = left == node.first;
    const bool right_is_leaf = right == node.last;
    children[i] = (uint2)(left_is_leaf ? LEAF_BIT | left : left, right_is_leaf ? LEAF_BIT | right : right);
    ranges[i] = (uint2)(node.first, node.last);
    parents[left_is_leaf ? count - 1u + left : left] = i;
    parents[right_is_leaf ? count - 1u + right : right] = i;
    arrivals[i] = 0u;
    if (i == 0u) parents[0] = NO_INDEX;
}

/* Boxes, costs and leaves bottom-up: one work-item per primitive climbs; of the two that meet at a node the first stops
 * and the second, who finds both children complete, goes on. Nobody waits. */
kernel void climb_boxes(uint count, global const float4* sorted_boxes, global const uint2* children,
                        global const uint2* ranges, global const uint* parents, global volatile uint* arrivals,
                        global volatile float4* inner_boxes, global volatile uint* packed)
{
    const uint position = (uint)get_global_id(0);
    if (position >= count) return;
    const TreeView tree = {sorted_boxes, children, ranges, inner_boxes, packed};
    uint node = parents[count - 1u + position];
    while (node != NO_INDEX && atomic_xchg(&arrivals[node], 1u) != 0u) {
        /* The first arriver's stores came before its exchange; ours must come before the next one. */
        mem_fence(CLK_GLOBAL_MEM_FENCE);
        refit_node(tree, node);
        mem_fence(CLK_GLOBAL_MEM_FENCE);
        node = parents[node];
    }
}

/* How far below the root each inner node is, and the largest of these: for the refit level by level. */
kernel void node_levels(uint count, global const uint* parents, global uint* levels, global uint* deepest)
{
    const uint i = (uint)get_global_id(0);
    if (i >= count - 1u) return;
    uint level = 0u;
    for (uint node = parents[i]; node != NO_INDEX; node = parents[node]) ++level;
    levels[i] = level;
    atomic_max(deepest, level);
}

/* What climb_boxes does, for the nodes of one level; launched from the deepest level up. */
kernel void refit_level(uint count, uint level, global const float4* sorted_boxes, global const uint2* children,
                        global const uint2* ranges, global const uint* levels, global volatile float4* inner_boxes,
                        global volatile uint* packed)
{
    const uint i = (uint)get_global_id(0);
    if (i >= count - 1u || levels[i] != level) return;
    const TreeView tree = {sorted_boxes, children, ranges, inner_boxes, packed};
    refit_node(tree, i);
}

/* 1 for each inner node that stays, else 0; one 0 more at the end, where the prefix sum leaves the total. */
kernel void mark_nodes(uint count, global const uint* packed, global const uint2* ranges, global const uint* parents,
                       global uint* marks)
{
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    marks[i] = i < count - 1u && node_stays(packed, ranges, parents, i) ? 1u : 0u;
}

/* Write the nodes that stay to their new places; new_indices are the scanned marks. */
kernel void emit_nodes(uint count, global const float4* sorted_boxes, global const uint2* children,
                       global const uint2* ranges, global float4* inner_boxes, global uint* packed,
                       global const uint* new_indices, global BvhNode* nodes)
{
    const uint i = (uint)get_global_id(0);
    if (i >= count - 1u || new_indices[i + 1u] == new_indices[i]) return;
    const TreeView tree = {sorted_boxes, children, ranges, inner_boxes, packed};
    const uint2 child = children[i];
    const Subtree a = load_subtree(tree, child.x);
    const Subtree b = load_subtree(tree, child.y);

    BvhNode node;
    node.x = (float4)(a.box.lower.x, a.box.upper.x, b.box.lower.x, b.box.upper.x);
    node.y = (float4)(a.box.lower.y, a.box.upper.y, b.box.lower.y, b.box.upper.y);
    node.z = (float4)(a.box.lower.z, a.box.upper.z, b.box.lower.z, b.box.upper.z);
    const uint2 reference_a = final_reference(child.x, a.is_leaf, ranges, new_indices);
    const uint2 reference_b = final_reference(child.y, b.is_leaf, ranges, new_indices);
    node.child = (uint4)(reference_a.x, reference_b.x, reference_a.y, reference_b.y);
    nodes[new_indices[i]] = node;
}
