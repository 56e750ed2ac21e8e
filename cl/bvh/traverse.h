/* What the integrator asks of a scene: closest hits and occlusion of a pack of rays, by the accelerator in use. */
#pragma once
#include "bvh/leaf.h"
#include "bvh/traverse_binary.h"

/* Fixed where only one accelerator is compiled in. */
STATIC bool uses_brute_force(SceneView view)
{
    if (!HAS_LBVH) return true;
    if (!HAS_BRUTE_FORCE) return false;
    return view.settings->accelerator == ACCELERATOR_BRUTE_FORCE;
}

/* Closest hit of the active lanes' valid rays. *complete turns false when the traversal stack was too small. */
STATIC Hit scene_closest_hit(SceneView view, Mask active, Ray ray, bool* complete)
{
    Hit hit = no_hit(ray.t_max);
    if (uses_brute_force(view))
        all_closest_hit(view, active, ray, &hit);
    else if (HAS_LBVH)
        *complete = bvh_closest_hit(view, active, ray, &hit) && *complete;
    return hit;
}

/* Which active lanes have something between 0 and t_max, other than the primitives they come from and go to. */
STATIC Mask scene_occluded(SceneView view, Mask active, Ray ray, bool* complete)
{
    if (uses_brute_force(view)) return all_any_hit(view, active, ray);
    bool enough = true;
    Mask occluded = to_mask(false);
    if (HAS_LBVH) occluded = bvh_any_hit(view, active, ray, &enough);
    *complete = *complete && enough;
    return occluded;
}
