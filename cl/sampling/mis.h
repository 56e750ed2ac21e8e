/* Multiple importance sampling. */
#pragma once
#include "math/numerics.h"

/* Weight of a sample drawn with density a where density b could have drawn it too, one sample of each: the power
 * heuristic with exponent 2 (Veach 1997, eq. 9.13), as a ratio so that squares of large densities cannot overflow. */
STATIC Float power_heuristic(Float a, Float b)
{
    return 1.0 / (1.0 + square(b / a));
}

/* The same with exponent 1, which is the balance heuristic (eq. 9.8). */
STATIC Float balance_heuristic(Float a, Float b)
{
    return 1.0 / (1.0 + b / a);
}
