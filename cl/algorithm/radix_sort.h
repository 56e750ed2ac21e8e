/* One pass of a stable radix sort of 64-bit keys with 32-bit values: least significant digit first, RADIX_BITS a pass.
 * Each work-item owns a chunk of consecutive keys. Counts lie digit by digit, within a digit chunk by chunk, so that
 * their exclusive prefix sum is where each chunk's keys of each digit go. */
#pragma once
#include "math/lanes.h"
#include "shared/limits.h"

STATIC uint radix_digit(ulong key, uint shift)
{
    return (uint)(key >> shift) & (RADIX_SIZE - 1u);
}

/* Count the digits of keys[first, end). */
STATIC void radix_count_chunk(global const ulong* keys, uint first, uint end, uint shift, global uint* counts,
                              uint chunk, uint chunk_count)
{
    uint count[RADIX_SIZE];
    for (uint d = 0; d < RADIX_SIZE; ++d) count[d] = 0;
    for (uint i = first; i < end; ++i) ++count[radix_digit(keys[i], shift)];
    for (uint d = 0; d < RADIX_SIZE; ++d) counts[d * chunk_count + chunk] = count[d];
}

/* Move keys[first, end) and their values to their places, in order. */
STATIC void radix_scatter_chunk(global const ulong* keys, global const uint* values, uint first, uint end, uint shift,
                                global const uint* offsets, uint chunk, uint chunk_count, global ulong* sorted_keys,
                                global uint* sorted_values)
{
    uint next[RADIX_SIZE];
    for (uint d = 0; d < RADIX_SIZE; ++d) next[d] = offsets[d * chunk_count + chunk];
    for (uint i = first; i < end; ++i) {
        const ulong key = keys[i];
        const uint place = next[radix_digit(key, shift)]++;
        sorted_keys[place] = key;
        sorted_values[place] = values[i];
    }
}
