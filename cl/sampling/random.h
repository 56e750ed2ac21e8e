/* Random numbers by position: Philox4x32-10 (Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3").
 *
 * A number depends on (seed, pixel, sample, dimension) alone, so any split of the work draws the same ones. A block
 * is four 32-bit integers; the dimension numbers blocks by (vertex, role), never by order of calls. */
#pragma once
#include "math/lanes.h"

typedef struct RandomBlock {
    Uint x, y, z, w;
} RandomBlock;

/* Which stream a path draws from. */
typedef struct RandomStream {
    uint key_low, key_high; /* the seed; the highest bit of key_high is kept for reference renders */
    uint sample_high;
    Uint pixel;      /* row by row over the whole film */
    Uint sample;     /* low word */
    uint sampler;    /* SAMPLER_* of features.h */
    uint replicates; /* of the Sobol sequence: 1 or 2 */
} RandomStream;

/* Dimensions: one block for the camera, then two for each vertex. They stay far below these bits, which set apart what
 * other samplers draw for themselves. */
#define RANDOM_FOR_SOBOL 0x80000000u
#define RANDOM_FOR_JITTER 0x40000000u
#define RANDOM_FOR_ORDER 0x20000000u
#define RANDOM_CAMERA 0u
#define RANDOM_LIGHT 1u
#define RANDOM_BSDF 2u
#define RANDOM_PER_VERTEX 2u

STATIC RandomBlock philox(Uint c0, Uint c1, Uint c2, Uint c3, uint k0, uint k1)
{
#pragma unroll
    for (int round = 0; round < 10; round++) {
        Uint high0, low0, high1, low1;
        multiply_wide(0xD2511F53u, c0, &high0, &low0);
        multiply_wide(0xCD9E8D57u, c2, &high1, &low1);
        c0 = high1 ^ c1 ^ (Uint)(k0);
        c1 = low1;
        c2 = high0 ^ c3 ^ (Uint)(k1);
        c3 = low0;
        k0 += 0x9E3779B9u;
        k1 += 0xBB67AE85u;
    }
    RandomBlock block = {c0, c1, c2, c3};
    return block;
}

STATIC RandomBlock random_block(RandomStream stream, Uint dimension)
{
    return philox(stream.pixel, stream.sample, dimension, (Uint)(stream.sample_high), stream.key_low, stream.key_high);
}

/* [0, 1): the upper 24 bits, so that 1 is never reached */
STATIC Float uniform_float(Uint bits)
{
    return to_float(bits >> 8) * 0x1p-24;
}

/* true with probability threshold / 2^32, exactly */
STATIC Mask below_threshold(Uint bits, Uint threshold)
{
    return bits < threshold;
}
