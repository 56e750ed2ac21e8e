// The tree against testing every primitive, bit for bit: the nearest primitive (the lowest of equals), the distance,
// the barycentrics, and occlusion; on geometry and rays that break trees.
#include "check/primitive_sets.h"
#include "support/device_evaluate.h"
#include "check/traversal.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <random>

namespace etendue
{
namespace
{
// An icosphere of 20 * 4^levels triangles: closed, every edge shared by two of them.
std::vector<Primitive> icosphere(int levels)
{
    using Vertex = std::array<double, 3>;
    const auto unit = [](Vertex v) {
        const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        return Vertex{v[0] / length, v[1] / length, v[2] / length};
    };
    const double g = (1 + std::sqrt(5.0)) / 2;
    const std::vector<Vertex> v{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    const int faces[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                              {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                              {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    std::vector<std::array<Vertex, 3>> mesh;
    for (const auto& f : faces) mesh.push_back({unit(v[f[0]]), unit(v[f[1]]), unit(v[f[2]])});
    for (int level = 0; level < levels; ++level) {
        std::vector<std::array<Vertex, 3>> finer;
        for (const auto& [a, b, c] : mesh) {
            const auto middle = [&](const Vertex& p, const Vertex& q) {
                return unit({p[0] + q[0], p[1] + q[1], p[2] + q[2]});
            };
            const Vertex ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh = std::move(finer);
    }
    std::vector<Primitive> set;
    const auto real = [](const Vertex& p) { return make_real4(p[0], p[1], p[2]); };
    for (const auto& [a, b, c] : mesh) set.push_back(make_triangle(real(a), real(b), real(c)));
    return set;
}

// Large triangles in random places.
std::vector<Primitive> soup(std::size_t count)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<Primitive> set;
    const auto point = [&](double scale) {
        return std::array<double, 3>{scale * u(random), scale * u(random), scale * u(random)};
    };
    for (std::size_t i = 0; i < count; ++i) {
        const auto p = point(1), e = point(0.3), f = point(0.3);
        set.push_back(make_triangle(make_real4(p[0], p[1], p[2]), make_real4(p[0] + e[0], p[1] + e[1], p[2] + e[2]),
                                    make_real4(p[0] + f[0], p[1] + f[1], p[2] + f[2])));
    }
    return set;
}

// Pairs that share a plane y = const and overlap, half of them listed the other way round, some sharing all vertices.
std::vector<Primitive> coplanar_pairs(std::size_t pairs)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<Primitive> first, second;
    for (std::size_t i = 0; i < pairs; ++i) {
        const double x = u(random), y = std::round(4 * u(random)) / 4, z = u(random), shift = i % 3 ? 0.05 : 0.0;
        const real4 a = make_real4(x, y, z), b = make_real4(x + 0.3, y, z), c = make_real4(x, y, z + 0.3);
        const real4 d = make_real4(x + shift, y, z + shift), e = make_real4(x + shift, y, z + 0.3 + shift),
                    f = make_real4(x + 0.3 + shift, y, z + shift);
        first.push_back(make_triangle(a, b, c));
        second.push_back(i % 2 ? make_triangle(d, f, e) : make_triangle(d, e, f));
    }
    std::shuffle(second.begin(), second.end(), random);
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

std::vector<Primitive> mixed(std::size_t count)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<Primitive> set = soup(count / 3);
    for (std::size_t i = 0; i < count / 3; ++i) set.push_back(make_sphere(u(random), u(random), u(random), 0.1));
    for (std::size_t i = 0; i < count / 3; ++i) set.push_back(make_disk(u(random), u(random), u(random), 0.1));
    return set;
}

// Coordinates of any bits at all: huge, tiny, subnormal, infinite, not a number.
std::vector<Primitive> random_bits(std::size_t count)
{
    std::mt19937 random(13);
    std::vector<Primitive> set = random_triangles(count / 2, 17);
    const auto any_float = [&] {
        const std::uint32_t bits = static_cast<std::uint32_t>(random());
        float value;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    };
    for (std::size_t i = 0; i < count / 2; ++i) {
        Primitive p = make_triangle({}, {}, {});
        for (int axis = 0; axis < 3; ++axis) {
            p.a.s[axis] = any_float();
            p.b.s[axis] = any_float();
            p.c.s[axis] = any_float();
        }
        set.push_back(p);
    }
    return set;
}

// Sizes from 2^-30 to 2^30: the products of three coordinates in the triangle test stay normal numbers.
std::vector<Primitive> huge_and_tiny(std::size_t count)
{
    std::mt19937 random(19);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<Primitive> set;
    for (std::size_t i = 0; i < count; ++i) {
        const double size = std::ldexp(1.0, static_cast<int>(30 * u(random)));
        const double x = size * u(random), y = size * u(random), z = size * u(random);
        set.push_back(triangle_at(x, y, z, 0.5 * size));
    }
    return set;
}

// Centres at 2^-i on each axis: the tree splits off one triangle at each bit of the Morton code.
std::vector<Primitive> one_split_per_bit()
{
    std::vector<Primitive> set{triangle_at(0, 0, 0, 0x1p-30)};
    for (int bit = 0; bit < 21; ++bit)
        for (int axis = 0; axis < 3; ++axis) {
            double centre[3] = {0, 0, 0};
            centre[axis] = std::ldexp(1.0, -bit);
            set.push_back(triangle_at(centre[0], centre[1], centre[2], std::ldexp(1.0, -bit - 3)));
        }
    return set;
}

const std::vector<Primitive>& primitive_set(const std::string& name)
{
    static const std::vector<PrimitiveSet> sets = primitive_sets();
    for (const PrimitiveSet& set : sets)
        if (set.name == name) return set.primitives;
    throw std::logic_error("There is no set of primitives " + name + ".");
}

// The same rays, cut off at what they meet, and one step before and behind it.
std::vector<TestRay> tied_rays(const std::vector<TestRay>& rays, const TracedRays& traced)
{
    std::vector<TestRay> tied;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (traced.primitive[i] == NO_INDEX) continue;
        const float t = traced.distance(i);
        for (const float t_max : {std::nextafter(t, 0.0f), t, std::nextafter(t, 2 * t)}) {
            tied.push_back(rays[i]);
            tied.back().t_max = t_max;
        }
    }
    return tied;
}

// Trace by the tree at every number of lanes, and require what testing every primitive gives. Returns that.
TracedRays check_tree(TraversalKernels& kernels, const TraversalScene& scene, const std::vector<TestRay>& rays)
{
    const TracedRays expected = kernels.trace(scene, rays, ACCELERATOR_BRUTE_FORCE);
    std::size_t wrong_validity = 0, wrong_occlusion = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool met = expected.primitive[i] != NO_INDEX;
        wrong_validity += expected.valid[i] != static_cast<uint>(is_valid(rays[i])) || (met && !expected.valid[i]);
        wrong_occlusion += expected.occluded[i] != static_cast<uint>(met && expected.distance(i) < rays[i].t_max);
    }
    CHECK(wrong_validity == 0);
    CHECK(wrong_occlusion == 0);
    for (const std::uint32_t lanes : LANE_COUNTS) {
        CAPTURE(lanes);
        const TracedRays found = kernels.trace(scene, rays, ACCELERATOR_LBVH, lanes);
        CHECK(differences(expected, found, rays) == std::vector<std::string>{});
        CHECK(std::count(found.complete.begin(), found.complete.end(), 0u) == 0);
    }
    return expected;
}

struct Case {
    std::string name;
    std::vector<Primitive> primitives;
    std::size_t rays;
};
} // namespace

TEST_CASE("the tree finds what testing every primitive finds, bit for bit, at every number of lanes")
{
    const std::vector<Case> cases{
        {"soup", soup(2000), 28000},
        {"closed mesh", icosphere(3), 28000},
        {"coplanar pairs", coplanar_pairs(500), 21000},
        {"mixed kinds", mixed(1500), 21000},
        {"random bits", random_bits(600), 14000},
        {"identical", primitive_set("identical"), 224},
        {"nested", primitive_set("nested around one centre"), 1400},
        {"clustered", primitive_set("clustered"), 2800},
        {"deep", one_split_per_bit(), 7000},
        {"of no size", primitive_set("split at every bit of the code"), 700},
        {"some not finite", primitive_set("some not finite"), 7000},
        {"none finite", primitive_set("none finite"), 700},
        {"huge and tiny", huge_and_tiny(500), 7000},
        {"kinds on one spot", primitive_set("kinds on one spot"), 1400},
        {"no primitive", {}, 70},
        {"one", primitive_set("1 random triangles"), 700},
        {"two", primitive_set("2 random triangles"), 700},
        {"three", primitive_set("3 random triangles"), 700},
    };
    for (const Device& device : test_devices()) {
        TraversalKernels kernels(device);
        std::map<std::string, std::size_t> hits;
        std::size_t total = 0;
        for (const Case& c : cases) {
            CAPTURE(c.name);
            const TraversalScene scene(c.primitives);
            const std::vector<TestRay> rays = nasty_rays(c.primitives, c.rays, 1);
            const TracedRays expected = check_tree(kernels, scene, rays);
            std::vector<TestRay> tied = tied_rays(rays, expected);
            tied.resize(std::min(tied.size(), c.rays / 4));
            if (!tied.empty()) check_tree(kernels, scene, tied);
            hits[c.name] = static_cast<std::size_t>(std::count_if(expected.primitive.begin(), expected.primitive.end(),
                                                                  [](uint id) { return id != NO_INDEX; }));
            total += rays.size() + tied.size();
        }
        CHECK(total >= 100000);
        // Most rays at a scene meet it; else the comparison would say little.
        for (const char* name : {"soup", "closed mesh", "coplanar pairs", "mixed kinds"}) CHECK(hits[name] > 7000);
        for (const char* name : {"identical", "nested", "random bits", "deep"}) CHECK(hits[name] > 20);
        CHECK(hits["no primitive"] + hits["none finite"] == 0);
    }
}

TEST_CASE("a stack that is too small is reported by the rays that it fails, and the others are right")
{
    const TraversalScene scene(soup(500));
    const std::vector<TestRay> rays = nasty_rays(scene.primitives(), 700, 2);
    for (const Device& device : test_devices()) {
        const TracedRays expected = TraversalKernels(device).trace(scene, rays, ACCELERATOR_BRUTE_FORCE);
        for (const std::uint32_t lanes : {1u, 8u}) {
            TracedRays found = TraversalKernels(device, 2).trace(scene, rays, ACCELERATOR_LBVH, lanes);
            const auto incomplete = std::count(found.complete.begin(), found.complete.end(), 0u);
            CHECK(incomplete > 50);
            if (lanes == 1) CHECK(incomplete < 650);
            // Compare the complete ones.
            for (std::size_t i = 0; i < rays.size(); ++i) {
                if (found.complete[i]) continue;
                found.t[i] = expected.t[i];
                found.primitive[i] = expected.primitive[i];
                found.b1[i] = expected.b1[i];
                found.b2[i] = expected.b2[i];
                found.occluded[i] = expected.occluded[i];
            }
            CHECK(differences(expected, found, rays) == std::vector<std::string>{});
        }
    }
}

TEST_CASE("rays along an axis through the vertices of a grid visit hardly more than tilted ones")
{
    // A grid in the plane y = 0, 64 x 64 squares of two triangles.
    std::vector<Primitive> grid;
    const auto vertex = [](int i, int k) { return make_real4(i / 32.0 - 1, 0, k / 32.0 - 1); };
    for (int i = 0; i < 64; ++i)
        for (int k = 0; k < 64; ++k) {
            grid.push_back(make_triangle(vertex(i, k), vertex(i + 1, k), vertex(i, k + 1)));
            grid.push_back(make_triangle(vertex(i + 1, k), vertex(i + 1, k + 1), vertex(i, k + 1)));
        }
    std::vector<TestRay> straight, tilted;
    for (int i = 0; i <= 64; ++i)
        for (int k = 0; k <= 64; ++k)
            for (const float zero : {0.0f, -0.0f}) {
                const real4 v = vertex(i, k);
                TestRay ray{{v.s[0], 1, v.s[2]}, {zero, -1, zero}, std::numeric_limits<float>::infinity()};
                straight.push_back(ray);
                ray.direction[0] = ray.direction[2] = 1e-3f;
                tilted.push_back(ray);
            }
    const TraversalScene scene(grid);
    for (const Device& device : test_devices()) {
        TraversalKernels kernels(device);
        const auto mean = [&](const std::vector<TestRay>& rays) {
            const std::vector<uint> visits = kernels.visits(scene, rays);
            CHECK(std::count(visits.begin(), visits.end(), 0u) == 0);
            return std::accumulate(visits.begin(), visits.end(), 0.0) / static_cast<double>(visits.size());
        };
        CHECK(mean(straight) <= 2 * mean(tilted));
        const TracedRays traced = kernels.trace(scene, straight, ACCELERATOR_LBVH);
        CHECK(std::count(traced.primitive.begin(), traced.primitive.end(), NO_INDEX) == 0);
    }
}
} // namespace etendue
