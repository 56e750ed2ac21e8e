/* A pack of rays through the binary tree: a node is visited when any lane needs it. With one lane this is the ordinary
 * single-ray traversal. Nearest hits and their ties do not depend on the order of the visit, so neither do the bits. */
#pragma once
#include "bvh/leaf.h"
#include "geometry/box.h"

/* The inner nodes still to visit, with the distance at which each lane enters them. */
typedef struct TraversalStack {
    uint node[STACK_SIZE];
    Float enter[STACK_SIZE];
    int size;
    bool overflow;
} TraversalStack;

STATIC void stack_push(TraversalStack* stack, uint node, Float enter)
{
    if (stack->size < STACK_SIZE) {
        stack->node[stack->size] = node;
        stack->enter[stack->size] = enter;
        stack->size++;
    } else {
        stack->overflow = true;
    }
}

/* Find the next node that some active lane enters before its nearest hit; false when none is left. */
STATIC bool stack_pop(TraversalStack* stack, Mask active, Float t_max, uint* node)
{
    while (stack->size > 0) {
        stack->size--;
        if (any_of(active & (stack->enter[stack->size] <= t_max))) {
            *node = stack->node[stack->size];
            return true;
        }
    }
    return false;
}

/* One step at an inner node: which children the lanes enter, and where. */
typedef struct ChildHits {
    Mask hit0, hit1;
    Float enter0, enter1;
} ChildHits;

STATIC ChildHits enter_children(global const BvhNode* node, Mask active, BoxRay ray, Float t_max)
{
    real4 x = node->x, y = node->y, z = node->z;
    ChildHits hits;
    hits.hit0 = active & box_hit(x.s0, x.s1, y.s0, y.s1, z.s0, z.s1, ray, t_max, &hits.enter0);
    hits.hit1 = active & box_hit(x.s2, x.s3, y.s2, y.s3, z.s2, z.s3, ray, t_max, &hits.enter1);
    hits.enter0 = hits.hit0 ? hits.enter0 : (Float)(INFINITE);
    hits.enter1 = hits.hit1 ? hits.enter1 : (Float)(INFINITE);
    return hits;
}

/* Go on to the entered inner children, the one that most lanes meet first before the other. False: none is entered. */
STATIC bool descend(TraversalStack* stack, uint4 child, ChildHits hits, bool go0, bool go1, uint* node)
{
    if (go0 && go1) {
        bool second_first = count_of(hits.enter1 < hits.enter0) > count_of(hits.enter0 < hits.enter1);
        stack_push(stack, second_first ? child.x : child.y, second_first ? hits.enter0 : hits.enter1);
        *node = second_first ? child.y : child.x;
        return true;
    }
    if (go0 || go1) {
        *node = go0 ? child.x : child.y;
        return true;
    }
    return false;
}

/* Closest hits of the active lanes before hit->t; false when the stack was too small. */
STATIC bool bvh_closest_hit(SceneView view, Mask active, Ray ray, Hit* hit)
{
    PreparedRay prepared = prepare_ray(ray);
    BoxRay box_ray = make_box_ray(ray);
    TraversalStack stack;
    stack.size = 0;
    stack.overflow = false;
    uint node = 0u;
    bool more = true;
    while (more) {
        uint4 child = view.nodes[node].child;
        ChildHits hits = enter_children(view.nodes + node, active, box_ray, hit->t);
        bool go0 = any_of(hits.hit0), go1 = any_of(hits.hit1);
        if (go0 && (child.x & LEAF_BIT)) {
            leaf_closest_hit(view, child.x & ~LEAF_BIT, child.z, hits.hit0, prepared, hit);
            go0 = false;
        }
        if (go1 && (child.y & LEAF_BIT)) {
            leaf_closest_hit(view, child.y & ~LEAF_BIT, child.w, hits.hit1, prepared, hit);
            go1 = false;
        }
        more = descend(&stack, child, hits, go0, go1, &node) || stack_pop(&stack, active, hit->t, &node);
    }
    return !stack.overflow;
}

/* Which active lanes are blocked before ray.t_max; false in *complete when the stack was too small. */
STATIC Mask bvh_any_hit(SceneView view, Mask active, Ray ray, bool* complete)
{
    PreparedRay prepared = prepare_ray(ray);
    BoxRay box_ray = make_box_ray(ray);
    TraversalStack stack;
    stack.size = 0;
    stack.overflow = false;
    Mask open = active;
    uint node = 0u;
    bool more = true;
    while (more) {
        uint4 child = view.nodes[node].child;
        ChildHits hits = enter_children(view.nodes + node, open, box_ray, ray.t_max);
        bool go0 = any_of(hits.hit0), go1 = any_of(hits.hit1);
        if (go0 && (child.x & LEAF_BIT)) {
            open &= not(leaf_any_hit(view, child.x & ~LEAF_BIT, child.z, hits.hit0, prepared));
            go0 = false;
        }
        if (go1 && (child.y & LEAF_BIT)) {
            open &= not(leaf_any_hit(view, child.y & ~LEAF_BIT, child.w, hits.hit1 & open, prepared));
            go1 = false;
        }
        if (none_of(open)) break;
        more = descend(&stack, child, hits, go0, go1, &node) || stack_pop(&stack, open, ray.t_max, &node);
    }
    *complete = !stack.overflow;
    return active & not(open);
}
