// Closest hits and occlusion by the tree against testing every primitive: the same bits, for every ray.
#include "bvh/lbvh_host.h"
#include "check/primitive_sets.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

#include <fmt/format.h>

using namespace etendue;

namespace
{
const std::string SIGNATURE =
    "BvhNode* uint* Primitive* RenderSettings* float float float float float float float uint -> ";
const std::string PREPARE = R"(
    SceneView view;
    view.nodes = in0; view.leaf_primitives = in1; view.primitives = in2; view.settings = in3;
    Ray ray = {vec3(in4, in5, in6), vec3(in7, in8, in9), in10, in11, (Uint)(NO_INDEX)};
    Mask active = is_valid_ray(ray);
    bool complete = true;
)";

std::vector<DeviceFunction> functions()
{
    return {{"closest", SIGNATURE + "uint float float float mask",
             PREPARE + "Hit hit = scene_closest_hit(view, active, ray, &complete); out0 = active ? hit.primitive : "
                       "(Uint)(NO_INDEX); out1 = hit.t; out2 = hit.b1; out3 = hit.b2; out4 = to_mask(complete);"},
            {"occluded", SIGNATURE + "mask", PREPARE + "out0 = scene_occluded(view, active, ray, &complete);"}};
}

const DeviceFunctions TRAVERSAL({"bvh/traverse.h"}, functions(), "", Specialization::everything(1, 128));

struct Rays {
    std::vector<float> ox, oy, oz, dx, dy, dz, t_max;
    std::vector<std::uint32_t> from;

    void add(const float (&o)[3], const float (&d)[3], float limit = INFINITY, std::uint32_t start = NO_INDEX)
    {
        ox.push_back(o[0]), oy.push_back(o[1]), oz.push_back(o[2]);
        dx.push_back(d[0]), dy.push_back(d[1]), dz.push_back(d[2]);
        t_max.push_back(limit), from.push_back(start);
    }
    std::size_t size() const { return ox.size(); }
};

// Random rays, rays along axes with both zeros, rays at vertices and edges, rays from surfaces, and rays that are none.
Rays nasty_rays(const std::vector<Primitive>& primitives, std::size_t count)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> u(-1.0f, 1.0f);
    Rays rays;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t id = random() % primitives.size();
        const Primitive& p = primitives[id];
        const float o[3] = {2 * u(random), 2 * u(random), 2 * u(random)};
        const float zero = i % 2 ? 0.0f : -0.0f;
        float target[3];
        for (int axis = 0; axis < 3; ++axis) target[axis] = i % 3 ? p.a.s[axis] : 0.5f * (p.a.s[axis] + p.b.s[axis]);
        switch (i % 6) {
        case 0:
            rays.add(o, {u(random), u(random), u(random)});
            break;
        case 1:
            rays.add({p.a.s[0], p.a.s[1], 3}, {zero, zero, -1});
            break;
        case 2:
            rays.add({-3, p.b.s[1], p.a.s[2]}, {1, zero, -zero});
            break;
        case 3:
            rays.add(o, {target[0] - o[0], target[1] - o[1], target[2] - o[2]});
            break;
        // The end of the ray is the target, so that ties with t_max occur.
        case 4:
            rays.add(o, {target[0] - o[0], target[1] - o[1], target[2] - o[2]}, 1.0f);
            break;
        case 5:
            rays.add({p.a.s[0], p.a.s[1], p.a.s[2]}, {u(random), u(random), u(random)}, INFINITY,
                     static_cast<uint>(id));
            break;
        }
    }
    const float nan = NAN, inf = INFINITY;
    rays.add({nan, 0, 0}, {1, 0, 0});
    rays.add({0, 0, 0}, {0, 0, 0});
    rays.add({0, 0, 0}, {inf, 0, 0});
    rays.add({0, inf, 0}, {1, 0, 0});
    rays.add({0, 0, 0}, {1, nan, 0}, nan);
    return rays;
}

DeviceResults run(const Device& device, const std::string& name, const Bvh& bvh,
                  const std::vector<Primitive>& primitives, AcceleratorType accelerator, const Rays& rays,
                  std::uint32_t lanes)
{
    RenderSettings settings{};
    settings.primitive_count = static_cast<uint>(primitives.size());
    settings.accelerator = accelerator;
    return TRAVERSAL.evaluate(device, name,
                              {bvh.nodes, bvh.leaf_primitives, primitives, std::vector<RenderSettings>{settings},
                               rays.ox, rays.oy, rays.oz, rays.dx, rays.dy, rays.dz, rays.t_max, rays.from},
                              lanes);
}

// The first ray whose answers differ in any bit, and how many there are; "" when there is none.
std::string difference(const DeviceResults& found, const DeviceResults& expected, const Rays& rays)
{
    std::size_t count = 0, first = 0;
    for (std::size_t i = rays.size(); i-- > 0;)
        for (std::size_t output = 0; output < found.outputs.size(); ++output)
            if (found.outputs[output][i] != expected.outputs[output][i]) {
                count += first != i || count == 0;
                first = i;
                break;
            }
    if (count == 0) return "";
    const auto told = [&](const DeviceResults& r) {
        return fmt::format("primitive {} t {} b {} {} complete {}", r.get<std::uint32_t>(0)[first],
                           r.get<float>(1)[first], r.get<float>(2)[first], r.get<float>(3)[first], r.outputs[4][first]);
    };
    return fmt::format("{} of {} rays differ, first {}: o {} {} {} d {} {} {}: {} instead of {}", count, rays.size(),
                       first, rays.ox[first], rays.oy[first], rays.oz[first], rays.dx[first], rays.dy[first],
                       rays.dz[first], told(found), told(expected));
}

std::vector<PrimitiveSet> sets()
{
    std::vector<PrimitiveSet> all = {{"random", random_triangles(600)}};
    all.push_back({"identical", std::vector<Primitive>(500, triangle_at(0.1, 0.2, 0.3, 0.4))});
    // Two coplanar triangles that overlap, many times.
    PrimitiveSet coplanar{"coplanar pairs", {}};
    for (int i = 0; i < 100; ++i) {
        const double z = i * 0.01 - 0.5;
        coplanar.primitives.push_back(make_triangle(make_real4(-1, -1, z), make_real4(1, -1, z), make_real4(0, 1, z)));
        coplanar.primitives.push_back(make_triangle(make_real4(-1, 1, z), make_real4(1, 1, z), make_real4(0, -1, z)));
    }
    all.push_back(coplanar);
    PrimitiveSet mixed{"triangles, spheres and disks", random_triangles(200, 5)};
    std::mt19937 random(9);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int i = 0; i < 60; ++i)
        mixed.primitives.push_back(make_sphere(u(random), u(random), u(random), 0.02 + 0.1 * std::abs(u(random))));
    for (int i = 0; i < 60; ++i) mixed.primitives.push_back(make_disk(u(random), u(random), u(random), 0.1));
    all.push_back(mixed);
    PrimitiveSet broken{"some primitives that are not finite", random_triangles(100, 6)};
    broken.primitives[17].b.s[0] = NAN;
    broken.primitives[40].a.s[1] = INFINITY;
    all.push_back(broken);
    // Any bits at all.
    PrimitiveSet garbage{"random bits", random_triangles(100, 8)};
    for (Primitive& p : garbage.primitives)
        for (real4* v : {&p.a, &p.b, &p.c})
            for (int axis = 0; axis < 3; ++axis)
                if (random() % 4 == 0) {
                    const std::uint32_t bits = static_cast<std::uint32_t>(random());
                    std::memcpy(&v->s[axis], &bits, 4);
                }
    all.push_back(garbage);
    all.push_back({"one", {triangle_at(0, 0, 0, 0.5)}});
    all.push_back({"deep", {}});
    for (int i = 0; i < 60; ++i)
        all.back().primitives.push_back(triangle_at(std::ldexp(1.0, -i), 0, 0, std::ldexp(0.4, -i)));
    return all;
}
} // namespace

TEST_CASE("the tree finds what testing every primitive finds, bit for bit, with any number of lanes", "[kernel]")
{
    for (const Device& device : test_devices())
        for (const PrimitiveSet& set : sets()) {
            INFO(set.name);
            const Bvh bvh = build_bvh_host(set.primitives);
            const Rays rays = nasty_rays(set.primitives, 6000);
            const DeviceResults every = run(device, "closest", bvh, set.primitives, ACCELERATOR_BRUTE_FORCE, rays, 1);
            std::size_t hits = 0;
            for (const std::uint32_t id : every.get<std::uint32_t>(0)) hits += id != NO_INDEX;
            // A set of garbage may hide, the others are met.
            CHECK((hits > 500 || set.name == "random bits" || set.name == "some primitives that are not finite"));
            for (const std::uint32_t lanes : LANE_COUNTS) {
                INFO(lanes << " lanes");
                const DeviceResults tree = run(device, "closest", bvh, set.primitives, ACCELERATOR_LBVH, rays, lanes);
                CHECK(difference(tree, every, rays) == "");
                const DeviceResults each =
                    run(device, "closest", bvh, set.primitives, ACCELERATOR_BRUTE_FORCE, rays, lanes);
                CHECK(difference(each, every, rays) == "");
            }
        }
}

TEST_CASE("occlusion agrees with the closest hit before the end of the ray", "[kernel]")
{
    for (const Device& device : test_devices())
        for (const PrimitiveSet& set : sets()) {
            INFO(set.name);
            const Bvh bvh = build_bvh_host(set.primitives);
            const Rays rays = nasty_rays(set.primitives, 3000);
            const DeviceResults closest =
                run(device, "closest", bvh, set.primitives, ACCELERATOR_BRUTE_FORCE, rays, 16);
            const auto ids = closest.get<std::uint32_t>(0);
            const auto t = closest.get<float>(1);
            for (const auto accelerator : {ACCELERATOR_BRUTE_FORCE, ACCELERATOR_LBVH})
                for (const std::uint32_t lanes : {1u, 16u}) {
                    const auto occluded =
                        run(device, "occluded", bvh, set.primitives, accelerator, rays, lanes).get<std::uint32_t>(0);
                    std::size_t differing = 0;
                    for (std::size_t i = 0; i < rays.size(); ++i)
                        differing +=
                            occluded[i] != static_cast<std::uint32_t>(ids[i] != NO_INDEX && t[i] < rays.t_max[i]);
                    CHECK(differing == 0);
                }
        }
}

TEST_CASE("a stack that is too small is told, not forgotten", "[kernel]")
{
    static const DeviceFunctions small({"bvh/traverse.h"}, functions(), "", Specialization::everything(1, 1));
    const std::vector<Primitive> primitives = random_triangles(600);
    const Bvh bvh = build_bvh_host(primitives);
    const Rays rays = nasty_rays(primitives, 64);
    RenderSettings settings{};
    settings.primitive_count = 600;
    settings.accelerator = ACCELERATOR_LBVH;
    for (const Device& device : test_devices()) {
        const auto complete =
            small
                .evaluate(device, "closest",
                          {bvh.nodes, bvh.leaf_primitives, primitives, std::vector<RenderSettings>{settings}, rays.ox,
                           rays.oy, rays.oz, rays.dx, rays.dy, rays.dz, rays.t_max, rays.from},
                          1)
                .get<std::uint32_t>(4);
        CHECK(std::count(complete.begin(), complete.end(), 0u) > 0);
    }
}
