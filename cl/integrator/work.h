/* Which samples a work-item traces, and where their results go. */
#pragma once
#include "integrator/path.h"

/* A work-item traces the flat sample indices [next, end) of its unit, as lanes become free. */
typedef struct SamplePool {
    uint next, end;
} SamplePool;

STATIC SamplePool make_sample_pool(WorkUnit unit, size_t item)
{
    uint total = unit.tile_width * unit.tile_height * unit.sample_count;
    ulong first = (ulong)item * unit.pool_size;
    SamplePool pool;
    pool.next = first < total ? (uint)first : total;
    pool.end = total - pool.next > unit.pool_size ? pool.next + unit.pool_size : total;
    return pool;
}

/* Give the lanes of `idle` the next indices of the pool, in lane order; returns the lanes that got one. */
STATIC Mask take_samples(SamplePool* pool, Mask idle, Uint* index)
{
    UintLanes taken;
    taken.lanes = *index;
    for (uint bits = lane_bits(idle); bits != 0u; bits &= bits - 1u)
        taken.lane[lowest_bit(bits)] = pool->next < pool->end ? pool->next++ : NO_INDEX;
    *index = taken.lanes;
    return idle & (*index != NO_INDEX);
}

/* Pixel of the whole film and random stream of a flat index. */
STATIC void place_sample(SceneView view, WorkUnit unit, Uint index, Uint* x, Uint* y, RandomStream* stream)
{
    uint tile_pixels = unit.tile_width * unit.tile_height;
    Uint sample = index / tile_pixels;
    Uint pixel = index - sample * tile_pixels;
    Uint row = pixel / unit.tile_width;
    *x = pixel - row * unit.tile_width + unit.tile_x;
    *y = row + unit.tile_y;
    stream->key_low = view.settings->seed_low;
    stream->key_high = view.settings->seed_high;
    stream->sample_high = unit.first_sample_high;
    stream->pixel = *y * view.settings->width + *x;
    stream->sample = sample + unit.first_sample;
    stream->sampler = view.settings->sampler;
    stream->replicates = view.settings->replicates;
}

/* Albedo, shading normal and distance of the first surface; zero where nothing was met. */
STATIC void store_aov(SceneView view, global SampleAov* aovs, Uint index, Mask first, Surface surface, Hit hit)
{
    Mask met = first & (hit.primitive != NO_INDEX);
    Color albedo = black();
    Vec3 normal = black();
    if (any_of(met)) {
        MaterialLanes material = load_material(view, surface.material, met);
        albedo = choose3(met, bsdf_albedo(view, material, met), albedo);
        Vec3 facing = choose3(dot3(surface.ns, surface.wo) < 0.0, negate3(surface.ns), surface.ns);
        normal = choose3(met, facing, normal);
    }
    Float depth = met ? hit.t : (Float)(0.0);
    scatter_real4(aovs[i].albedo, index, first, albedo.x, albedo.y, albedo.z, depth);
    Float hits = met ? (Float)(1.0) : (Float)(0.0);
    scatter_real4(aovs[i].normal, index, first, normal.x, normal.y, normal.z, hits);
}

/* Add a work-item's counts to the launch's, carrying into the high words. */
STATIC void add_counts(global LaunchCounters* counters, RayCounts rays)
{
    for (int kind = 0; kind < COUNT_KINDS; kind++) {
        uint low = (uint)rays.counts[kind];
        uint high = (uint)(rays.counts[kind] >> 32);
        uint before = atomic_add(&counters->counts[kind], low);
        if (before + low < before) high++;
        if (high != 0u) atomic_add(&counters->counts_high[kind], high);
    }
}
