/* The course's second picture: the shading normal of the first hit as a colour, one ray through the pixel's centre. */
#include "integrator/work.h"

kernel void normals(SCENE_ARGUMENTS, WorkUnit unit, global SampleResult* results, global SampleAov* aovs,
                    global LaunchCounters* counters)
{
    SceneView view = SCENE_VIEW();
    SamplePool pool = make_sample_pool(unit, get_global_id(0));
    RayCounts rays;
    for (int kind = 0; kind < COUNT_KINDS; kind++) rays.counts[kind] = 0ul;
    PathState path;
    path.accident = path.vertices = (Uint)(0u);
    while (pool.next < pool.end) {
        Uint index, x, y;
        path.active = take_samples(&pool, to_mask(true), &index);
        place_sample(view, unit, path.active ? index : (Uint)(0u), &x, &y, &path.stream);
        path.ray =
            pinhole_ray(&settings->camera, to_float(x) + 0.5, to_float(y) + 0.5, settings->width, settings->height);
        uint busy = count_of(path.active);
        rays.counts[COUNT_CAMERA_RAYS] += busy;
        rays.counts[COUNT_BUSY_LANES] += busy;
        rays.counts[COUNT_LANE_SLOTS] += LANES;
        /* Map the normal's axes from [-1, 1] to [0, 1]; black where nothing is met. */
        Mask wanted = path.active;
        path.accident = (Uint)(0u);
        Hit hit = path_extend(view, &path);
        Mask met = path.active & (hit.primitive != NO_INDEX);
        Surface surface = make_surface(view.primitives, view.surfaces, view.normals, met, path.ray, hit);
        if (HAS_AOV) store_aov(view, aovs, index, wanted, surface, hit);
        Vec3 half_unit = scale3(white(), (Float)(0.5));
        Color colour = choose3(met, fma3(surface.ns, (Float)(0.5), half_unit), black());
        scatter_real4(results[i].radiance, index, wanted, colour.x, colour.y, colour.z, to_float(path.accident));
    }
    add_counts(counters, rays);
}
