/* Pixel filters by importance sampling: a sample is drawn from the filter and belongs to its own pixel alone, so that
 * tiles stay independent and every weight is 1 (Ernst, Stamminger, Greiner 2006). */
#pragma once
#include "sampling/warp.h"
#include "shared/settings.h"

/* Offset from the pixel's centre, in pixels. */
STATIC Vec2 filter_sample(global const RenderSettings* settings, Float u, Float v)
{
    Float radius = (Float)(settings->filter_parameters.x);
    Vec2 offset = vec2((2.0 * u - 1.0) * radius, (2.0 * v - 1.0) * radius);
    if (HAS_FILTER && settings->filter == FILTER_TENT) offset = vec2(tent_sample(u) * radius, tent_sample(v) * radius);
    if (HAS_FILTER && settings->filter == FILTER_GAUSSIAN) {
        Float sigma = (Float)(settings->filter_parameters.y);
        Vec2 unit = truncated_gaussian_sample(u, v, radius / sigma, (Float)(settings->filter_parameters.z));
        offset = vec2(unit.x * sigma, unit.y * sigma);
    }
    return offset;
}
