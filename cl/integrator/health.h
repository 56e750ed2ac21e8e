/* Accidents of a path: the first one is kept, the sample then counts as zero. Nothing non-finite is dropped in silence.
 */
#pragma once
#include "math/vector.h"
#include "shared/work.h"

/* 0: none; else kind + 1 + 16 * vertex, exactly representable in a float. */
STATIC Uint accident_code(uint kind, Uint vertices)
{
    Uint capped = vertices < 65535u ? vertices : (Uint)(65535u);
    return (Uint)(kind + 1u) + capped * 16u;
}

/* Record an accident of the lanes of a mask that have had none. */
STATIC void note_accident(Uint* accident, Mask mask, uint kind, Uint vertices)
{
    *accident = (mask & (*accident == 0u)) ? accident_code(kind, vertices) : *accident;
}
