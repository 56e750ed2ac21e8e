/* The primitives of a leaf, or of a whole small scene, against a pack of rays. */
#pragma once
#include "geometry/primitive.h"
#include "shared/scene_view.h"

STATIC void primitive_closest_hit(SceneView view, uint id, Mask active, PreparedRay prepared, Hit* hit)
{
    Float t, b1, b2;
    Mask met = primitive_hit(view.primitives[id], id, active, prepared, &t, &b1, &b2);
    met &= hit_accept(*hit, t, (Uint)(id));
    hit_update(hit, met, t, (Uint)(id), b1, b2);
}

STATIC Mask primitive_any_hit(SceneView view, uint id, Mask active, PreparedRay prepared)
{
    Float t, b1, b2;
    Mask met = primitive_hit(view.primitives[id], id, active, prepared, &t, &b1, &b2);
    return met & (t > 0.0) & (t < prepared.ray.t_max);
}

STATIC void leaf_closest_hit(SceneView view, uint first, uint count, Mask active, PreparedRay prepared, Hit* hit)
{
    for (uint i = 0u; i < count; i++)
        primitive_closest_hit(view, view.leaf_primitives[first + i], active, prepared, hit);
}

STATIC Mask leaf_any_hit(SceneView view, uint first, uint count, Mask active, PreparedRay prepared)
{
    Mask blocked = to_mask(false);
    for (uint i = 0u; i < count; i++)
        blocked |= primitive_any_hit(view, view.leaf_primitives[first + i], active, prepared);
    return blocked;
}

/* Every primitive of the scene. */
STATIC void all_closest_hit(SceneView view, Mask active, Ray ray, Hit* hit)
{
    PreparedRay prepared = prepare_ray(ray);
    uint count = view.settings->primitive_count;
    for (uint id = 0u; id < count; id++) primitive_closest_hit(view, id, active, prepared, hit);
}

STATIC Mask all_any_hit(SceneView view, Mask active, Ray ray)
{
    PreparedRay prepared = prepare_ray(ray);
    Mask open = active;
    uint count = view.settings->primitive_count;
    for (uint id = 0u; id < count && any_of(open); id++) open &= not(primitive_any_hit(view, id, open, prepared));
    return active & not(open);
}
