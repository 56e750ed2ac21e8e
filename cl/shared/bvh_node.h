/* A node of the binary tree: the boxes of its two children, padded. */
#ifndef SHARED_BVH_NODE_H
#define SHARED_BVH_NODE_H
#include "shared/real.h"

/* x = (child 0 lower, child 0 upper, child 1 lower, child 1 upper) along x; y and z alike.
 * child.xy: index of an inner node, or LEAF_BIT | first position in the list of leaf primitives;
 * child.zw: number of primitives of a leaf, 0 for an inner node. The root is node 0. A scene of one primitive has one
 * node whose second child is an empty leaf (count 0, LEAF_BIT set) with an inverted box that no ray meets. */
typedef struct BvhNode {
    real4 x;
    real4 y;
    real4 z;
    uint4 child;
} BvhNode;
#endif
