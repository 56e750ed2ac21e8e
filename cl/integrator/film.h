/* Running sums of one pixel within a block of samples. Scalar: a pixel is summed by one work-item. */
#pragma once
#include "math/lanes.h"
#include "shared/structs.h"

/* Add one sample (xyz): the sum compensated after Kahan (true sum = sum - compensation), the squared deviations after
 * Welford 1962. w of the three members is kept as PixelBlock says. */
STATIC PixelBlock block_add(PixelBlock block, real4 sample)
{
    real n = block.sum.w;
    /* Compare with the mean so far. */
    real4 before = n > 0.0 ? (block.sum - block.compensation) / n : (real4)(0.0);
    real4 delta = n > 0.0 ? sample - before : (real4)(0.0);
    /* Add, keeping what is rounded away. */
    real4 corrected = sample - block.compensation;
    real4 sum = block.sum + corrected;
    real4 compensation = (sum - block.sum) - corrected;
    real4 m2 = block.m2 + delta * delta * (n / (n + 1.0));
    PixelBlock next;
    next.sum = (real4)(sum.xyz, n + 1.0);
    next.compensation = (real4)(compensation.xyz, 0.0);
    next.m2 = (real4)(m2.xyz, block.m2.w);
    return next;
}

/* Count the accident of a sample by its code, and remember the lowest flat index that had the kind. */
STATIC void count_accident(global LaunchCounters* counters, uint code, uint index)
{
    uint kind = (code & 15u) - 1u;
    atomic_inc(&counters->health[kind]);
    atomic_min(&counters->health_first[kind], index);
}
