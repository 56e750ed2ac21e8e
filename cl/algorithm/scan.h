/* Exclusive prefix sums, chunk by chunk: sum the chunks, scan the sums, scan each chunk from its sum. */
#pragma once
#include "math/lanes.h"

/* The sum of values[first, end), modulo 2^32. */
STATIC uint scan_sum(global const uint* values, uint first, uint end)
{
    uint sum = 0;
    for (uint i = first; i < end; ++i) sum += values[i];
    return sum;
}

/* Replace each of values[first, end) by `before` plus the sum of those in front of it. */
STATIC void scan_exclusive(global uint* values, uint first, uint end, uint before)
{
    for (uint i = first; i < end; ++i) {
        const uint value = values[i];
        values[i] = before;
        before += value;
    }
}
