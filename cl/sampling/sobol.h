/* Owen-scrambled Sobol points: a (0,2)-sequence in base 2 for each half of a random block, shuffled and scrambled anew
 * for each pixel and dimension (padding).
 *
 * Any 2^m points that begin at a multiple of 2^m of the sequence have one point in each elementary interval of area
 * 2^-m. Scrambling is nested (Owen 1995) by hashing (Laine and Karras 2011; Burley 2020, "Practical hash-based Owen
 * scrambling"): in an integer whose bits are reversed, sums, products and x ^ x * even carry from low to high bits
 * only, so that each digit is changed by the digits before it. Shuffling the index in the same way keeps the blocks of
 * 2^m.
 *
 * With two replicates, blocks of SAMPLES_PER_BLOCK samples belong in turn to two sequences scrambled independently, so
 * that even and odd blocks are two estimates of the picture and their difference is an honest error. */
#pragma once
#include "sampling/random.h"
#include "shared/limits.h"

/* Where a sample stands in its sequence. */
typedef struct SobolPlace {
    Uint replicate, index;
    uint index_high;
} SobolPlace;

STATIC SobolPlace sobol_place(RandomStream stream)
{
    SobolPlace place = {(Uint)(0u), stream.sample, stream.sample_high};
    if (stream.replicates > 1u) {
        Uint block = stream.sample / SAMPLES_PER_BLOCK;
        place.replicate = block & 1u;
        place.index = (block >> 1) * SAMPLES_PER_BLOCK + stream.sample % SAMPLES_PER_BLOCK;
        place.index |= (Uint)(stream.sample_high << 31);
        place.index_high = stream.sample_high >> 1;
    }
    return place;
}

STATIC Uint reverse_bits(Uint x)
{
    x = (x >> 16) | (x << 16);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

/* Nested scrambling of digits in reversed order, the first one lowest; `add` and `multiply` are random words, and the
 * constants are those of Vegdahl ("Building a better LK hash", 2021). For a random `add` the result is uniform. */
STATIC Uint scramble_reversed(Uint x, Uint add, Uint multiply)
{
    x ^= x * 0x3d20adeau;
    x += add;
    x *= multiply | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

/* The second component of the Sobol sequence with its digits reversed. Digit k is the sum modulo 2 of the index's bits
 * j for which the binomial coefficient (j over k) is odd, which is where j has all bits of k (Lucas 1878): one step of
 * a sum over supersets for each of the five bits of k (the matrix and its use in place: Ahmed 2024). */
STATIC Uint sobol_second_reversed(Uint index)
{
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 8) & 0x00ff00ffu;
    return index ^ (index >> 16);
}

/* The first (0) or second (1) point of a block: words as fractions of 2^32. */
STATIC void sobol_point(RandomStream stream, SobolPlace place, Uint reversed_index, Uint dimension, uint pair, Uint* u,
                        Uint* v)
{
    RandomBlock key = philox(stream.pixel, place.replicate * 2u + pair, dimension | RANDOM_FOR_SOBOL,
                             (Uint)(place.index_high), stream.key_low, stream.key_high);
    Uint index = reverse_bits(scramble_reversed(reversed_index, key.x, key.w));
    *u = reverse_bits(scramble_reversed(index, key.y, key.w));
    *v = reverse_bits(scramble_reversed(sobol_second_reversed(index), key.z, key.w));
}

STATIC RandomBlock sobol_block(RandomStream stream, Uint dimension)
{
    SobolPlace place = sobol_place(stream);
    Uint reversed_index = reverse_bits(place.index);
    RandomBlock block;
    sobol_point(stream, place, reversed_index, dimension, 0u, &block.x, &block.y);
    sobol_point(stream, place, reversed_index, dimension, 1u, &block.z, &block.w);
    return block;
}
