/* The stages of a path, from the camera to its end; every integrator is these stages under different settings.
 *
 * L = sum over vertices of throughput times (emission met + light sampled), where emission met by a BSDF-sampled ray
 * and light samples share each path between them by multiple importance sampling (Veach 1997, chapter 9), or one of
 * them takes it all. Delta lobes are reached by BSDF sampling alone, and emission met after one always counts in full.
 */
#pragma once
#include "bsdf/bsdf.h"
#include "bvh/traverse.h"
#include "camera/pinhole.h"
#include "geometry/ray_offset.h"
#include "integrator/health.h"
#include "light/light.h"
#include "sampling/filter.h"
#include "sampling/mis.h"
#include "sampling/sampler.h"

typedef struct PathState {
    Mask active;
    Ray ray; /* next segment; unit direction */
    Color throughput;
    Color radiance;
    Float pdf;            /* of the ray's direction under BSDF sampling, per solid angle */
    Mask delta;           /* the ray comes from the camera or a delta lobe */
    Float radiance_scale; /* product of the scales of the refractions so far; roulette looks through it */
    Uint vertices;        /* scatterings so far: the number of the next vertex */
    Uint accident;
    RandomStream stream;
} PathState;

/* Rays by kind, of one work-item. */
typedef struct RayCounts {
    ulong counts[COUNT_KINDS];
} RayCounts;

/* No path in any lane. */
STATIC PathState idle_path(void)
{
    PathState path;
    path.active = path.delta = to_mask(false);
    path.ray.origin = path.ray.direction = path.throughput = path.radiance = black();
    path.pdf = path.radiance_scale = (Float)(1.0);
    path.vertices = path.accident = (Uint)(0u);
    path.ray.from = (Uint)(NO_INDEX);
    return path;
}

/* Draw of a role at the current vertex. */
STATIC RandomBlock path_random(PathState* path, uint role)
{
    return sampler_block(path->stream, path->vertices * RANDOM_PER_VERTEX + role);
}

/* Begin paths at the camera in the lanes of `fresh`: pixel (x, y) of the whole film and sample in path->stream. */
STATIC void path_begin(SceneView view, PathState* path, Mask fresh, Uint x, Uint y)
{
    global const RenderSettings* s = view.settings;
    RandomBlock random = sampler_block(path->stream, (Uint)(RANDOM_CAMERA));
    Vec2 offset = filter_sample(s, uniform_float(random.x), uniform_float(random.y));
    Ray ray = pinhole_ray(&s->camera, to_float(x) + 0.5 + offset.x, to_float(y) + 0.5 + offset.y, s->width, s->height);
    path->ray.origin = choose3(fresh, ray.origin, path->ray.origin);
    path->ray.direction = choose3(fresh, ray.direction, path->ray.direction);
    path->ray.t_max = (Float)(INFINITE);
    path->ray.from = fresh ? (Uint)(NO_INDEX) : path->ray.from;
    path->ray.to = (Uint)(NO_INDEX);
    path->throughput = choose3(fresh, white(), path->throughput);
    path->radiance = choose3(fresh, black(), path->radiance);
    path->pdf = fresh ? (Float)(1.0) : path->pdf;
    path->delta |= fresh;
    path->radiance_scale = fresh ? (Float)(1.0) : path->radiance_scale;
    path->vertices = fresh ? (Uint)(0u) : path->vertices;
    path->accident = fresh ? (Uint)(0u) : path->accident;
    path->active |= fresh;
}

/* End the paths of a mask, noting the accident. */
STATIC void path_drop(PathState* path, Mask broken, uint kind)
{
    if (any_of(broken)) {
        note_accident(&path->accident, broken, kind, path->vertices);
        path->active &= not(broken);
    }
}

/* Trace the active paths to their next surface. */
STATIC Hit path_extend(SceneView view, PathState* path)
{
    path_drop(path, path->active & not(is_valid_ray(path->ray)), HEALTH_INVALID_RAY);
    bool complete = true;
    Hit hit = scene_closest_hit(view, path->active, path->ray, &complete);
    if (!complete) path_drop(path, path->active, HEALTH_STACK_OVERFLOW);
    return hit;
}

/* Weight of light found with density a that could have been found with density b too. */
STATIC Float mis_weight(SceneView view, Float a, Float b)
{
    if (HAS_BALANCE_HEURISTIC && view.settings->balance_heuristic) return balance_heuristic(a, b);
    return power_heuristic(a, b);
}

/* Weight of emission that a ray has met, when light_sample would have found it with density light_pdf. */
STATIC Float emission_weight(SceneView view, PathState* path, Float light_pdf)
{
    Float weight = (Float)(0.0);
    if (HAS_EMISSION_SAMPLING && view.settings->count_emission) {
        weight = (Float)(1.0);
        if (HAS_LIGHT_SAMPLING && view.settings->sample_lights) weight = mis_weight(view, path->pdf, light_pdf);
    }
    return path->delta ? (Float)(1.0) : weight;
}

STATIC void path_add(PathState* path, Mask mask, Color radiance)
{
    path->radiance = choose3(mask, add3(path->radiance, radiance), path->radiance);
}

/* Add the emission of what was met, or of the environment where nothing was; paths that met nothing end. */
STATIC void path_emission(SceneView view, PathState* path, Surface surface, Hit hit)
{
    Mask met = path->active & (hit.primitive != NO_INDEX);
    if (HAS_AREA) {
        Mask emits = met & (surface.light != NO_INDEX);
        if (any_of(emits)) {
            LightHit light = light_hit(view, surface, emits, path->ray, hit);
            Mask lit = emits & (max_component(light.radiance) > 0.0);
            Float weight = emission_weight(view, path, light.pdf);
            path_add(path, lit, mul3(path->throughput, scale3(light.radiance, weight)));
        }
    }
    if (HAS_ENVIRONMENT) {
        Mask escaped = path->active & not(met);
        if (any_of(escaped)) {
            LightHit light = light_escape(view);
            Float weight = emission_weight(view, path, light.pdf);
            path_add(path, escaped & (max_component(light.radiance) > 0.0),
                     mul3(path->throughput, scale3(light.radiance, weight)));
        }
    }
    path->active = met;
}

/* A direction must leave on the same side of the shading normal as of the geometric one: no light leaks through. */
STATIC Mask sides_agree(Surface surface, Vec3 w, Vec3 w_local)
{
    return (dot3(w, surface.ng) > 0.0) == (w_local.z > 0.0);
}

/* The words of a light sample. Bucket and point share one point of the sampler, the bucket in the upper bits of its
 * first coordinate, so that points that fill the square evenly fill every bucket's light evenly too. */
STATIC RandomBlock light_words(SceneView view, RandomBlock random)
{
    RandomBlock words = {random.x, random.w, alias_remainder(view.settings->alias_shift, random.x, random.z), random.y};
    return words;
}

/* Where light samples and shadow rays of the current vertex start. */
STATIC Vec3 light_origin(Surface surface)
{
    return offset_origin(surface, dot3(surface.wo, surface.ng) > 0.0);
}

/* The light sample of the current vertex. */
STATIC LightSample path_light_sample(SceneView view, PathState* path, Mask active, Vec3 from)
{
    return light_sample(view, active, from, light_words(view, path_random(path, RANDOM_LIGHT)));
}

/* Sample a light from the current vertex and add it where nothing stands between: the path_connect stage. */
STATIC void path_connect(SceneView view, PathState* path, Surface surface, Frame frame, MaterialLanes material,
                         RayCounts* rays)
{
    Mask active = path->active & ((material.flags & MATERIAL_DELTA) == 0u);
    if (none_of(active)) return;
    Vec3 wo = to_local(frame, surface.wo);
    Vec3 from = light_origin(surface);
    LightSample light = path_light_sample(view, path, active, from);
    /* Evaluate the BSDF towards the light. */
    Vec3 wi = to_local(frame, light.wi);
    Mask lit = active & (light.pdf > 0.0) & sides_agree(surface, light.wi, wi);
    Color f = bsdf_evaluate(view, material, lit, wo, wi);
    lit &= max_component(f) > 0.0;
    if (none_of(lit)) return;
    /* Weigh it against BSDF sampling. */
    Float weight = abs_of(wi.z) / light.pdf;
    if (HAS_EMISSION_SAMPLING && view.settings->count_emission)
        weight *= mis_weight(view, light.pdf, bsdf_pdf(view, material, lit, wo, wi));
    /* Add the light of the sample where nothing stands between. */
    Ray shadow = {from, light.to_light, light.t_max, surface.primitive, light.primitive};
    bool complete = true;
    Mask blocked = scene_occluded(view, lit, shadow, &complete);
    rays->counts[COUNT_SHADOW_RAYS] += count_of(lit);
    if (!complete) path_drop(path, lit, HEALTH_STACK_OVERFLOW);
    path_add(path, lit & not(blocked), mul3(path->throughput, scale3(mul3(f, light.radiance), weight)));
}

/* Sample where the path goes on: by the BSDF, or uniformly over the hemisphere where that is asked for. */
STATIC BsdfSample path_direction(SceneView view, PathState* path, MaterialLanes material, Vec3 wo, RandomBlock random)
{
    BsdfSample sample = bsdf_sample(view, material, path->active, wo, random);
    if (HAS_UNIFORM_HEMISPHERE && view.settings->uniform_hemisphere) {
        Vec3 up = uniform_hemisphere_sample(uniform_float(random.x), uniform_float(random.y));
        BsdfSample uniform = no_bsdf_sample();
        uniform.wi = vec3(up.x, up.y, copy_sign(up.z, wo.z));
        uniform.pdf = (Float)(INV_TWO_PI);
        Color f = bsdf_evaluate(view, material, path->active, wo, uniform.wi);
        uniform.weight = scale3(f, up.z * (2.0 * PI));
        sample = choose_bsdf_sample(sample.delta, sample, uniform);
    }
    return sample;
}

/* Russian roulette: survive with probability q, known exactly as an integer, and weigh by 1 / q. */
STATIC void path_roulette(SceneView view, PathState* path, Uint bits)
{
    global const RenderSettings* s = view.settings;
    if (!HAS_ROULETTE || s->roulette == ROULETTE_OFF) return;
    Float survival = (Float)(s->roulette_parameters.x);
    if (s->roulette == ROULETTE_THROUGHPUT)
        survival = max_of(max_component(path->throughput) / path->radiance_scale, (Float)(MIN_SURVIVAL));
    Mask plays = path->active & (path->vertices >= s->roulette_start) & (survival < 1.0);
    if (none_of(plays)) return;
    Uint threshold = to_uint((survival < 1.0 ? survival : (Float)(0.0)) * 0x1p32);
    path->active &= not(plays) | below_threshold(bits, threshold);
    path->throughput =
        choose3(plays, scale3(path->throughput, 1.0 / (to_float(threshold) * 0x1p-32)), path->throughput);
}

/* Scatter at the current vertex: the next ray of each path, or its end. */
STATIC void path_scatter(SceneView view, PathState* path, Surface surface, Frame frame, MaterialLanes material)
{
    RandomBlock random = path_random(path, RANDOM_BSDF);
    Vec3 wo = to_local(frame, surface.wo);
    BsdfSample sample = path_direction(view, path, material, wo, random);
    /* Refuse what is not a number; end where nothing was sampled. */
    Mask finite = is_finite(sample.pdf) & is_finite3(sample.weight) & is_finite3(sample.wi);
    path_drop(path, path->active & not(finite), HEALTH_NON_FINITE_PDF);
    Float smallest = min_of(sample.pdf, min_of(sample.weight.x, min_of(sample.weight.y, sample.weight.z)));
    path_drop(path, path->active & (smallest < 0.0), HEALTH_NEGATIVE_PDF);
    Vec3 wi = to_world(frame, sample.wi);
    path->active &= (sample.pdf > 0.0) & (max_component(sample.weight) > 0.0) & sides_agree(surface, wi, sample.wi);
    /* Move on. */
    path->throughput = choose3(path->active, mul3(path->throughput, sample.weight), path->throughput);
    path->radiance_scale = path->active ? path->radiance_scale * sample.radiance_scale : path->radiance_scale;
    path->ray.origin = choose3(path->active, offset_origin(surface, dot3(wi, surface.ng) > 0.0), path->ray.origin);
    path->ray.direction = choose3(path->active, wi, path->ray.direction);
    path->ray.from = path->active ? surface.primitive : path->ray.from;
    path->pdf = sample.pdf;
    path->delta = sample.delta;
    path->vertices += path->active ? (Uint)(1u) : (Uint)(0u);
    path_roulette(view, path, random.w);
    path_drop(path, path->active & (path->vertices >= MAX_PATH_VERTICES), HEALTH_PATH_TOO_LONG);
}

/* Gather light at the surfaces that were met and scatter: one step of every active path. Paths that have gathered at
 * max_depth vertices end. */
STATIC void path_shade(SceneView view, PathState* path, Surface surface, RayCounts* rays)
{
    path->active &= path->vertices < (Uint)(view.settings->max_depth);
    if (none_of(path->active)) return;
    MaterialLanes material = load_material(view, surface.material, path->active);
    Frame frame = make_frame(surface.ns);
    if (HAS_LIGHT_SAMPLING && view.settings->sample_lights) path_connect(view, path, surface, frame, material, rays);
    path_scatter(view, path, surface, frame, material);
}

/* The finished paths' radiance, checked: an accident makes it zero and is told in *accident. */
STATIC Color path_end(PathState* path, Uint* accident)
{
    Uint code = path->accident;
    note_accident(&code, not(is_finite3(path->radiance)), HEALTH_NON_FINITE_RADIANCE, path->vertices);
    Color r = path->radiance;
    note_accident(&code, (r.x < 0.0) | (r.y < 0.0) | (r.z < 0.0), HEALTH_NEGATIVE_RADIANCE, path->vertices);
    *accident = code;
    return choose3(code == 0u, r, black());
}
