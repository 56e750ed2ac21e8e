/* Whole paths in one kernel. A work-item carries LANES of them and refills finished lanes from its pool of samples.
 * Each sample's result is stored by its index, so that neither refill nor LANES nor the size of a launch changes a bit.
 */
#include "integrator/work.h"

/* Lanes that must be idle before they are refilled together: a quarter, as refilling costs about as much as a step. */
#define REFILL_LANES ((LANES + 3) / 4)

kernel void path_megakernel(SCENE_ARGUMENTS, WorkUnit unit, global SampleResult* results, global SampleAov* aovs,
                            global LaunchCounters* counters)
{
    SceneView view = SCENE_VIEW();
    SamplePool pool = make_sample_pool(unit, get_global_id(0));
    RayCounts rays;
    for (int kind = 0; kind < COUNT_KINDS; kind++) rays.counts[kind] = 0ul;

    PathState path = idle_path();
    Uint index = (Uint)(NO_INDEX);
    Mask idle = to_mask(true);

    for (;;) {
        /* Store what has ended, and refill. */
        uint idle_count = count_of(idle);
        if (idle_count >= REFILL_LANES) {
            Mask done = idle & (index != NO_INDEX);
            if (any_of(done)) {
                Uint accident;
                Color radiance = path_end(&path, &accident);
                scatter_real4(results[i].radiance, index, done, radiance.x, radiance.y, radiance.z, to_float(accident));
            }
            Mask fresh = take_samples(&pool, idle, &index);
            if (none_of(fresh) && idle_count == LANES) break;
            if (any_of(fresh)) {
                Uint x, y;
                place_sample(view, unit, index, &x, &y, &path.stream);
                path_begin(view, &path, fresh, x, y);
                rays.counts[COUNT_CAMERA_RAYS] += count_of(fresh);
                rays.counts[COUNT_INDIRECT_RAYS] -= count_of(fresh);
            }
        }
        uint busy = count_of(path.active);
        rays.counts[COUNT_INDIRECT_RAYS] += busy;
        rays.counts[COUNT_BUSY_LANES] += busy;
        rays.counts[COUNT_LANE_SLOTS] += LANES;

        /* One step of every path. */
        Mask first = path.active & (path.vertices == 0u);
        Hit hit = path_extend(view, &path);
        Mask met = path.active & (hit.primitive != NO_INDEX);
        Surface surface = make_surface(view.primitives, view.surfaces, view.normals, met, path.ray, hit);
        if (HAS_AOV && any_of(first)) store_aov(view, aovs, index, first, surface, hit);
        path_emission(view, &path, surface, hit);
        path_shade(view, &path, surface, &rays);
        idle = not(path.active);
    }
    add_counts(counters, rays);
}
