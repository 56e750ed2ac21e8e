/* The random numbers of paths, by whichever sampler the stream names.
 *
 * A block depends on (seed, pixel, sample, dimension) alone. Its words are uniform, (x, y) and (z, w) are points of the
 * unit square, and the two points are independent; how the points of one pixel's samples lie to each other is the
 * sampler's choice. Pixels, dimensions and seeds are independent of each other. */
#pragma once
#include "sampling/random.h"
#include "sampling/sobol.h"
#include "sampling/stratified.h"
#include "shared/features.h"

STATIC RandomBlock sampler_block(RandomStream stream, Uint dimension)
{
    RandomBlock block = {(Uint)(0u), (Uint)(0u), (Uint)(0u), (Uint)(0u)};
    if (HAS_INDEPENDENT && stream.sampler == SAMPLER_INDEPENDENT) block = random_block(stream, dimension);
    if (HAS_STRATIFIED && stream.sampler == SAMPLER_STRATIFIED) block = stratified_block(stream, dimension);
    if (HAS_SOBOL && stream.sampler == SAMPLER_SOBOL) block = sobol_block(stream, dimension);
    return block;
}
