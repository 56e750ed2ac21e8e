// The tree against testing every primitive, bit for bit: the nearest primitive (the lowest of equals), the distance,
// the barycentrics, and occlusion; on geometry and rays that break trees.
#include "check/primitive_sets.h"
#include "check/traversal.h"
#include "check/traversal_cases.h"
#include "support/device_evaluate.h"

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
} // namespace

TEST_CASE("the tree finds what testing every primitive finds, bit for bit, at every number of lanes")
{
    const std::vector<TraversalCase> cases = traversal_cases();
    for (const Device& device : test_devices()) {
        TraversalKernels kernels(device);
        std::map<std::string, std::size_t> hits;
        std::size_t total = 0;
        for (const TraversalCase& c : cases) {
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
