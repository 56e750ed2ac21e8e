/* Jittered samples: the SAMPLES_PER_BLOCK samples of a block fall one into each of 8x8 cells, in an order drawn anew
 * for each pixel, dimension and block, so that blocks are independent of each other. */
#pragma once
#include "sampling/random.h"
#include "shared/limits.h"

/* Bits of a cell's number along one axis; 8x8 cells are the samples of a block. */
#define STRATUM_BITS 3u
#define STRATUM_MASK (SAMPLES_PER_BLOCK - 1u)

/* Place of 0 <= i < 64 in a permutation drawn by two random words: rounds of i -> odd * i + number modulo 64, with the
 * high bits folded into the low ones in between. The last sum alone makes each place equally likely. */
STATIC Uint stratum_permute(Uint i, Uint bits_a, Uint bits_b)
{
#pragma unroll
    for (int round = 0; round < 5; round++) {
        i = (i * (bits_a | 1u) + bits_b) & STRATUM_MASK;
        if (round < 4) i ^= i >> STRATUM_BITS;
        bits_a >>= 6;
        bits_b >>= 6;
    }
    return i;
}

/* The number of a stratum with jitter within it, as a fraction of 2^32. */
STATIC Uint stratum_point(Uint stratum, Uint jitter)
{
    return (stratum << (32u - STRATUM_BITS)) | (jitter >> STRATUM_BITS);
}

STATIC RandomBlock stratified_block(RandomStream stream, Uint dimension)
{
    Uint block = (stream.sample / SAMPLES_PER_BLOCK) | (Uint)(stream.sample_high << 26);
    Uint index = stream.sample % SAMPLES_PER_BLOCK;
    RandomBlock order = philox(stream.pixel, block, dimension | RANDOM_FOR_ORDER, (Uint)(stream.sample_high >> 6),
                               stream.key_low, stream.key_high);
    RandomBlock jitter = random_block(stream, dimension | RANDOM_FOR_JITTER);
    Uint first = stratum_permute(index, order.x, order.y);
    Uint second = stratum_permute(index, order.z, order.w);
    RandomBlock result = {stratum_point(first & 7u, jitter.x), stratum_point(first >> STRATUM_BITS, jitter.y),
                          stratum_point(second & 7u, jitter.z), stratum_point(second >> STRATUM_BITS, jitter.w)};
    return result;
}
