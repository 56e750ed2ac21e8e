/* The binary radix tree over sorted codes, every inner node on its own: T. Karras, "Maximizing Parallelism in the
 * Construction of BVHs, Octrees, and k-d Trees", HPG 2012. Inner node i covers a range of the order of which i is one
 * end; equal codes are told apart by their position. */
#pragma once
#include "math/lanes.h"

typedef struct RadixNode {
    uint first; /* covered positions, both ends included */
    uint last;
    uint split; /* last position of the first child */
} RadixNode;

/* Length of the common prefix of the keys at i and j; -1 when j is no position. */
STATIC int common_prefix(global const ulong* codes, int count, int i, int j)
{
    if (j < 0 || j >= count) return -1;
    const ulong difference = codes[i] ^ codes[j];
    return difference != 0ul ? (int)clz(difference) : 64 + (int)clz((uint)(i ^ j));
}

/* The range and split of inner node i of count - 1. */
STATIC RadixNode radix_node(global const ulong* codes, int count, int i)
{
    /* The range runs from i towards the neighbour that shares the longer prefix. */
    const int step = common_prefix(codes, count, i, i + 1) > common_prefix(codes, count, i, i - 1) ? 1 : -1;
    const int outside = common_prefix(codes, count, i, i - step);

    /* Find the other end: double, then halve. */
    int reach = 2;
    while (common_prefix(codes, count, i, i + reach * step) > outside) reach *= 2;
    int length = 0;
    for (int t = reach / 2; t > 0; t /= 2)
        if (common_prefix(codes, count, i, i + (length + t) * step) > outside) length += t;
    const int end = i + length * step;

    /* Find the last position that shares more with i than the whole range does. */
    const int shared = common_prefix(codes, count, i, end);
    int offset = 0;
    int t = length;
    do {
        t = (t + 1) / 2;
        if (common_prefix(codes, count, i, i + (offset + t) * step) > shared) offset += t;
    } while (t > 1);

    RadixNode node;
    node.first = (uint)min(i, end);
    node.last = (uint)max(i, end);
    node.split = (uint)(i + offset * step + min(step, 0));
    return node;
}
