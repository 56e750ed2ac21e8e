/* Follows single samples through the stages of the megakernel, one a work-item, and writes every vertex down. Built
 * with one lane. */
#include "integrator/work.h"

/* PathVertex's light_pdfs, from the state in which the path arrives. */
STATIC real4 light_pdfs(SceneView view, PathState path, Surface surface, Hit hit)
{
    Float of_sample = 0.0, of_bsdf = 0.0, of_emission = 0.0;
    Mask met = path.active & (hit.primitive != NO_INDEX);
    /* Emission, as light samples find it. */
    if (HAS_AREA) of_emission = light_hit(view, surface, met, path.ray, hit).pdf;
    if (HAS_ENVIRONMENT && path.active && !met) of_emission = light_escape(view).pdf;
    /* The light sample once more, and its direction as the BSDF finds it. */
    if (HAS_LIGHT_SAMPLING && view.settings->sample_lights && met && path.vertices < view.settings->max_depth) {
        MaterialLanes material = load_material(view, surface.material, met);
        if ((material.flags & MATERIAL_DELTA) == 0u) {
            LightSample light = path_light_sample(view, &path, met, light_origin(surface));
            Frame frame = make_frame(surface.ns);
            of_sample = light.pdf;
            if (light.pdf > 0.0)
                of_bsdf = bsdf_pdf(view, material, met, to_local(frame, surface.wo), to_local(frame, light.wi));
        }
    }
    return (real4)(of_sample, of_bsdf, of_emission, 0.0);
}

/* Record what a path has met, with the state before and after it scattered there. */
STATIC PathVertex make_vertex(SceneView view, PathState path, Surface surface, Hit hit, Color emission, real4 pdfs,
                              Uint number)
{
    PathVertex vertex;
    bool met = hit.primitive != NO_INDEX;
    bool scattered = path.vertices != number;
    Vec3 p = met ? surface.p : black(), ng = met ? surface.ng : black(), ns = met ? surface.ns : black();
    Vec3 next = scattered ? path.ray.direction : black();
    vertex.position = (real4)(p.x, p.y, p.z, met ? surface.p_error : 0.0);
    vertex.geometric_normal = (real4)(ng.x, ng.y, ng.z, hit.t);
    vertex.shading_normal = (real4)(ns.x, ns.y, ns.z, scattered ? path.pdf : 0.0);
    vertex.direction = (real4)(next.x, next.y, next.z, 0.0);
    vertex.throughput = (real4)(path.throughput.x, path.throughput.y, path.throughput.z, path.radiance_scale);
    vertex.emission = (real4)(emission.x, emission.y, emission.z, 0.0);
    vertex.radiance = (real4)(path.radiance.x, path.radiance.y, path.radiance.z, 0.0);
    vertex.light_pdfs = pdfs;
    vertex.primitive = hit.primitive;
    vertex.material = met ? surface.material : NO_INDEX;
    vertex.bsdf = met ? view.materials[surface.material].type : NO_INDEX;
    vertex.light = met ? surface.light : NO_INDEX;
    vertex.delta = scattered && path.delta ? 1u : 0u;
    vertex.inside = met && dot3(surface.ng, surface.wo) < 0.0 ? 1u : 0u;
    vertex.goes_on = path.active ? 1u : 0u;
    vertex.accident = path.accident;
    return vertex;
}

/* The samples are units of one pixel and one sample. The first max_vertices vertices of each path are stored, and
 * how many there were. */
kernel void replay(SCENE_ARGUMENTS, global const WorkUnit* samples, uint sample_count, uint max_vertices,
                   global PathVertex* vertices, global uint* vertex_counts, global SampleResult* results)
{
    uint item = (uint)get_global_id(0);
    if (item >= sample_count) return;
    SceneView view = SCENE_VIEW();
    RayCounts rays;
    for (int kind = 0; kind < COUNT_KINDS; kind++) rays.counts[kind] = 0ul;
    PathState path = idle_path();
    Uint x, y;
    place_sample(view, samples[item], 0u, &x, &y, &path.stream);
    path_begin(view, &path, to_mask(true), x, y);
    uint count = 0u;
    while (any_of(path.active)) {
        /* One step, as in the megakernel. */
        Uint number = path.vertices;
        Hit hit = path_extend(view, &path);
        Mask met = path.active & (hit.primitive != NO_INDEX);
        Surface surface = make_surface(view.primitives, view.surfaces, view.normals, met, path.ray, hit);
        real4 pdfs = light_pdfs(view, path, surface, hit);
        path_emission(view, &path, surface, hit);
        Color emission = path.radiance;
        path_shade(view, &path, surface, &rays);
        /* Write it down. */
        if (count < max_vertices)
            vertices[(size_t)item * max_vertices + count] =
                make_vertex(view, path, surface, hit, emission, pdfs, number);
        count++;
    }
    Uint accident;
    Color radiance = path_end(&path, &accident);
    results[item].radiance = (real4)(radiance.x, radiance.y, radiance.z, to_float(accident));
    vertex_counts[item] = count;
}
