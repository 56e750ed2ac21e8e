/* Adds a launch's samples to the running sums of its pixels, in sample order, one work-item a pixel. */
#include "integrator/film.h"

kernel void film_accumulate(WorkUnit unit, global const SampleResult* results, global const SampleAov* aovs,
                            global PixelBlock* blocks, global PixelAov* block_aovs, global LaunchCounters* counters)
{
    uint pixel = (uint)get_global_id(0);
    uint tile_pixels = unit.tile_width * unit.tile_height;
    if (pixel >= tile_pixels) return;
    PixelBlock block = blocks[pixel];
    for (uint s = 0u; s < unit.sample_count; s++) {
        uint index = s * tile_pixels + pixel;
        real4 radiance = results[index].radiance;
        if (radiance.w != 0.0) {
            count_accident(counters, (uint)radiance.w, index);
            block.m2.w += 1.0;
        }
        block = block_add(block, radiance);
    }
    blocks[pixel] = block;
    if (HAS_AOV) {
        PixelAov sum = block_aovs[pixel];
        for (uint s = 0u; s < unit.sample_count; s++) {
            SampleAov aov = aovs[s * tile_pixels + pixel];
            sum.albedo += aov.albedo;
            sum.normal += aov.normal;
        }
        block_aovs[pixel] = sum;
    }
}
