// The kernels that trace, what runs them, and rays that break traversals.
#include "check/traversal.h"

#include "bvh/lbvh_host.h"
#include "compute/kernel.h"
#include "compute/specialization.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace etendue
{
namespace
{
// Numbers of a ray, and of what became of it.
constexpr std::size_t RAY_WORDS = 9, RESULT_WORDS = 7;

const char* KERNELS = "#include \"bvh/traverse.h\"\n"
                      R"(

STATIC Uint load_word(global const uint* words, uint first, uint count, uint word)
{
    UintLanes value;
    for (uint lane = 0u; lane < LANES; lane++) value.lane[lane] = words[min(first + lane, count - 1u) * 9u + word];
    return value.lanes;
}

STATIC void store_word(global uint* words, uint first, uint count, uint word, Uint value)
{
    UintLanes values;
    values.lanes = value;
    for (uint lane = 0u; lane < LANES; lane++)
        if (first + lane < count) words[(first + lane) * 7u + word] = values.lane[lane];
}

STATIC Ray load_ray(global const uint* rays, uint first, uint count)
{
    Ray ray;
    ray.origin = vec3(from_bits(load_word(rays, first, count, 0u)), from_bits(load_word(rays, first, count, 1u)),
                      from_bits(load_word(rays, first, count, 2u)));
    ray.direction = vec3(from_bits(load_word(rays, first, count, 3u)), from_bits(load_word(rays, first, count, 4u)),
                         from_bits(load_word(rays, first, count, 5u)));
    ray.t_max = from_bits(load_word(rays, first, count, 6u));
    ray.from = load_word(rays, first, count, 7u);
    ray.to = load_word(rays, first, count, 8u);
    return ray;
}

STATIC Uint mask_word(Mask m)
{
    return m ? (Uint)(1u) : (Uint)(0u);
}

STATIC void store_result(global uint* results, uint first, uint count, Mask active, Hit hit, Mask occluded,
                         bool complete)
{
    store_word(results, first, count, 0u, mask_word(active));
    store_word(results, first, count, 1u, uint_bits(hit.t));
    store_word(results, first, count, 2u, hit.primitive);
    store_word(results, first, count, 3u, uint_bits(hit.b1));
    store_word(results, first, count, 4u, uint_bits(hit.b2));
    store_word(results, first, count, 5u, mask_word(occluded));
    store_word(results, first, count, 6u, (Uint)(complete ? 1u : 0u));
}

kernel void trace_scene(SCENE_ARGUMENTS, uint count, global const uint* rays, global uint* results)
{
    SceneView view = SCENE_VIEW();
    uint first = (uint)get_global_id(0) * LANES;
    Ray ray = load_ray(rays, first, count);
    Mask active = is_valid_ray(ray);
    bool complete = true;
    Hit hit = scene_closest_hit(view, active, ray, &complete);
    Mask occluded = scene_occluded(view, active, ray, &complete);
    store_result(results, first, count, active, hit, occluded, complete);
}

/* All leaf_primitives are one leaf. */
kernel void trace_leaf(SCENE_ARGUMENTS, uint count, global const uint* rays, global uint* results)
{
    SceneView view = SCENE_VIEW();
    uint first = (uint)get_global_id(0) * LANES;
    Ray ray = load_ray(rays, first, count);
    Mask active = is_valid_ray(ray);
    Hit hit = no_hit(ray.t_max);
    uint size = settings->primitive_count;
    leaf_closest_hit(view, 0u, size, active, prepare_ray(ray), &hit);
    Mask occluded = leaf_any_hit(view, 0u, size, active, prepare_ray(ray));
    store_result(results, first, count, active, hit, active & occluded, true);
}

/* Nodes that a pack visits when no hit shortens its rays; 0 when the stack was too small. */
kernel void count_visits(SCENE_ARGUMENTS, uint count, global const uint* rays, global uint* results)
{
    uint first = (uint)get_global_id(0) * LANES;
    Ray ray = load_ray(rays, first, count);
    Mask active = is_valid_ray(ray);
    BoxRay box_ray = make_box_ray(ray);
    TraversalStack stack;
    stack.size = 0;
    stack.overflow = false;
    uint node = 0u, visits = 0u;
    bool more = true;
    while (more) {
        visits++;
        uint4 child = nodes[node].child;
        ChildHits hits = enter_children(nodes + node, active, box_ray, ray.t_max);
        bool go0 = any_of(hits.hit0) && !(child.x & LEAF_BIT), go1 = any_of(hits.hit1) && !(child.y & LEAF_BIT);
        more = descend(&stack, child, hits, go0, go1, &node) || stack_pop(&stack, active, ray.t_max, &node);
    }
    store_word(results, first, count, 0u, (Uint)(stack.overflow ? 0u : visits));
}
)";

std::vector<uint> ray_words(const std::vector<TestRay>& rays)
{
    static_assert(sizeof(TestRay) == RAY_WORDS * sizeof(uint));
    std::vector<uint> words(rays.size() * RAY_WORDS);
    if (!rays.empty()) std::memcpy(words.data(), rays.data(), words.size() * sizeof(uint));
    return words;
}

TracedRays as_traced_rays(const std::vector<uint>& words)
{
    TracedRays traced;
    std::vector<uint>* columns[] = {&traced.valid, &traced.t,        &traced.primitive, &traced.b1,
                                    &traced.b2,    &traced.occluded, &traced.complete};
    for (std::size_t i = 0; i < words.size(); ++i) columns[i % RESULT_WORDS]->push_back(words[i]);
    return traced;
}

// Where a ray may start or go: a vertex, the middle of an edge or of a triangle; near the centre of another primitive.
struct Place {
    double p[3];
};

class RayMaker
{
public:
    RayMaker(const std::vector<Primitive>& primitives, unsigned seed) : primitives_(primitives), random_(seed) {}

    TestRay make(std::size_t kind)
    {
        const uint first = any_primitive(), second = any_primitive();
        switch (kind) {
        case 0:
            return ray(anywhere(3), anywhere(1));
        case 1:
            return along_axis(first);
        case 2:
            return towards(anywhere(3), corner(first, 1, 0));
        case 3:
            return towards(anywhere(3), corner(first, 0.5, 0.5));
        case 4:
            return ray(corner(first, 1, 0), anywhere(1));
        case 5:
            return from(ray(inside(first), anywhere(1)), first);
        default:
            return between(first, second);
        }
    }

    // Spoil one number of a ray.
    TestRay spoil(TestRay r)
    {
        const float infinity = std::numeric_limits<float>::infinity(), nan = std::nanf("");
        const float bad[] = {nan, infinity, -infinity};
        const std::size_t place = random_() % 8;
        if (place < 3)
            r.origin[place] = bad[random_() % 3];
        else if (place < 6)
            r.direction[place - 3] = bad[random_() % 3];
        else if (place == 6)
            r.t_max = random_() % 2 ? nan : -1.0f;
        else
            r.direction[0] = r.direction[1] = r.direction[2] = random_() % 2 ? 0.0f : -0.0f;
        return r;
    }

private:
    uint any_primitive() { return primitives_.empty() ? 0 : static_cast<uint>(random_() % primitives_.size()); }
    double uniform() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
    Place anywhere(double size) { return {{size * uniform(), size * uniform(), size * uniform()}}; }

    // Of two vertices in turn, with these weights.
    Place corner(uint id, double wa, double wb)
    {
        if (primitives_.empty()) return anywhere(1);
        const Primitive& p = primitives_[id];
        if (p.a.s[3] != PRIMITIVE_TRIANGLE) return inside(id);
        const real4* vertices[] = {&p.a, &p.b, &p.c};
        const std::size_t turn = random_() % 3;
        Place place{};
        for (int axis = 0; axis < 3; ++axis)
            place.p[axis] = wa * vertices[turn]->s[axis] + wb * vertices[(turn + 1) % 3]->s[axis];
        return place;
    }

    Place inside(uint id)
    {
        if (primitives_.empty()) return anywhere(1);
        const Primitive& p = primitives_[id];
        Place place{};
        for (int axis = 0; axis < 3; ++axis)
            place.p[axis] = p.a.s[3] == PRIMITIVE_TRIANGLE ? (double{p.a.s[axis]} + p.b.s[axis] + p.c.s[axis]) / 3
                                                           : p.a.s[axis] + std::max(p.b.s[0], p.c.s[0]) * uniform();
        return place;
    }

    static TestRay ray(const Place& origin, const Place& direction)
    {
        TestRay r{};
        r.t_max = std::numeric_limits<float>::infinity();
        r.from = r.to = NO_INDEX;
        for (int axis = 0; axis < 3; ++axis) {
            r.origin[axis] = static_cast<float>(origin.p[axis]);
            r.direction[axis] = static_cast<float>(direction.p[axis]);
        }
        return r;
    }

    // Through a place, as floats subtract.
    static TestRay towards(const Place& origin, const Place& target)
    {
        TestRay r = ray(origin, target);
        for (int axis = 0; axis < 3; ++axis) r.direction[axis] -= r.origin[axis];
        return r;
    }

    static TestRay from(TestRay r, uint id)
    {
        r.from = id;
        return r;
    }

    // Along an axis, through a vertex or along one of its planes.
    TestRay along_axis(uint id)
    {
        const std::size_t axis = random_() % 3;
        Place origin = corner(id, 1, 0);
        if (random_() % 4 == 0) origin.p[(axis + 1) % 3] = uniform();
        origin.p[axis] = 3 * uniform();
        TestRay r = ray(origin, {{0, 0, 0}});
        for (float& d : r.direction) d = random_() % 2 ? 0.0f : -0.0f;
        r.direction[axis] = random_() % 2 ? 1.0f : -1.0f;
        return r;
    }

    // As shadow rays go.
    TestRay between(uint first, uint second)
    {
        TestRay r = towards(inside(first), inside(second));
        r.t_max = 1.0f;
        r.from = first;
        r.to = second;
        return r;
    }

    const std::vector<Primitive>& primitives_;
    std::mt19937 random_;
};
} // namespace

float TracedRays::distance(std::size_t i) const
{
    float result;
    std::memcpy(&result, &t[i], sizeof result);
    return result;
}

std::vector<std::string> differences(const TracedRays& a, const TracedRays& b, const std::vector<TestRay>& rays)
{
    constexpr std::size_t MAX_SENTENCES = 5;
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < rays.size() && sentences.size() < MAX_SENTENCES; ++i) {
        if (a.valid[i] == b.valid[i] && a.t[i] == b.t[i] && a.primitive[i] == b.primitive[i] && a.b1[i] == b.b1[i] &&
            a.b2[i] == b.b2[i] && a.occluded[i] == b.occluded[i])
            continue;
        const TestRay& r = rays[i];
        sentences.push_back(fmt::format(
            "Ray {} from ({:a}, {:a}, {:a}) along ({:a}, {:a}, {:a}) to {}: {} at {:.9g} occluded {}, but {} at {:.9g} "
            "occluded {}.",
            i, r.origin[0], r.origin[1], r.origin[2], r.direction[0], r.direction[1], r.direction[2], r.t_max,
            static_cast<int>(a.primitive[i]), a.distance(i), a.occluded[i], static_cast<int>(b.primitive[i]),
            b.distance(i), b.occluded[i]));
    }
    return sentences;
}

std::vector<TestRay> nasty_rays(const std::vector<Primitive>& primitives, std::size_t count, unsigned seed)
{
    RayMaker maker(primitives, seed);
    std::vector<TestRay> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const TestRay ray = maker.make(i % 7);
        rays.push_back(i % 16 == 15 ? maker.spoil(ray) : ray);
    }
    return rays;
}

bool is_valid(const TestRay& ray)
{
    bool any = false;
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(ray.origin[axis]) || !std::isfinite(ray.direction[axis])) return false;
        any |= ray.direction[axis] != 0.0f;
    }
    return any && ray.t_max >= 0.0f;
}

TraversalScene::TraversalScene(std::vector<Primitive> primitives)
    : primitives_(std::move(primitives)), bvh_(build_bvh_host(primitives_))
{
}

std::vector<uint> TraversalKernels::run(const std::string& kernel, const TraversalScene& scene,
                                        const std::vector<uint>& leaves, AcceleratorType accelerator,
                                        const std::vector<TestRay>& rays, std::uint32_t lanes)
{
    // Build the program at its first use.
    if (lanes == 0) lanes = device_.preferred_lanes();
    if (!programs_.contains(lanes))
        programs_.emplace(lanes, Program::from_text(device_, "traversal under test", KERNELS,
                                                    Specialization::everything(lanes, stack_size_).build_options()));

    // Upload, run, read.
    RenderSettings settings{};
    settings.accelerator = accelerator;
    settings.primitive_count = static_cast<uint>(kernel == "trace_leaf" ? leaves.size() : scene.primitives().size());
    const Buffer<RenderSettings> settings_buffer(device_, "settings", {settings});
    const Buffer<BvhNode> nodes(device_, "nodes", scene.bvh().nodes);
    const Buffer<uint> leaf_primitives(device_, "leaf primitives", leaves);
    const Buffer<Primitive> primitives(device_, "primitives", scene.primitives());
    const Buffer<uint> words(device_, "rays", ray_words(rays));
    const Buffer<uint> results(device_, "results", rays.size() * RESULT_WORDS);
    const Buffer<uint> none;
    // A work-group of one: a driver may keep the stacks of all its items at once.
    Kernel(programs_.at(lanes), kernel)
        .run((rays.size() + lanes - 1) / lanes, 1, settings_buffer, nodes, leaf_primitives, primitives, none, none,
             none, none, none, none, static_cast<uint>(rays.size()), words, results);

    return results.read();
}

TracedRays TraversalKernels::trace(const TraversalScene& scene, const std::vector<TestRay>& rays,
                                   AcceleratorType accelerator, std::uint32_t lanes)
{
    return as_traced_rays(run("trace_scene", scene, scene.bvh().leaf_primitives, accelerator, rays, lanes));
}

TracedRays TraversalKernels::trace_leaf(const TraversalScene& scene, const std::vector<TestRay>& rays,
                                        const std::vector<uint>& leaf, std::uint32_t lanes)
{
    return as_traced_rays(run("trace_leaf", scene, leaf, ACCELERATOR_BRUTE_FORCE, rays, lanes));
}

std::vector<uint> TraversalKernels::visits(const TraversalScene& scene, const std::vector<TestRay>& rays)
{
    const std::vector<uint> words = run("count_visits", scene, scene.bvh().leaf_primitives, ACCELERATOR_LBVH, rays, 1);
    std::vector<uint> counts;
    for (std::size_t i = 0; i < rays.size(); ++i) counts.push_back(words[i * RESULT_WORDS]);
    return counts;
}
} // namespace etendue
