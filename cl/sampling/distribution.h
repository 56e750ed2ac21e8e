/* Discrete choice by an integer alias table (Vose 1991): exact, whatever the weights. */
#pragma once
#include "math/lanes.h"
#include "shared/light.h"

/* Entry chosen by 32 random bits for the bucket and 32 for the entry. alias_shift = 32 - log2(number of buckets), so a
 * table of one bucket has shift 32, which a shift instruction cannot do: it is done in two steps. */
STATIC Uint alias_sample(global const AliasBucket* table, uint alias_shift, Uint bucket_bits, Uint entry_bits,
                         Mask active)
{
    Uint bucket = (bucket_bits >> (alias_shift - 1u)) >> 1;
    Uint threshold = gather_uint((global const uint*)table, bucket * 2u, active);
    Uint alias = gather_uint((global const uint*)table, bucket * 2u + 1u, active);
    return entry_bits < threshold ? bucket : alias;
}

/* What is left of the bits that have chosen a bucket: uniform again, and independent of the bucket. Bits of `more` come
 * in from below for those that were used. */
STATIC Uint alias_remainder(uint alias_shift, Uint bucket_bits, Uint more)
{
    return (bucket_bits << (32u - alias_shift)) | ((more >> (alias_shift - 1u)) >> 1);
}
