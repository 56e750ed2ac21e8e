// The primitives of a leaf, and of a whole scene one after the other, against double precision and against each other.
#include "check/primitive_sets.h"
#include "check/traversal.h"
#include "math/vector.h"
#include "support/device_evaluate.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

namespace etendue
{
namespace
{
constexpr float INFINITE = std::numeric_limits<float>::infinity();

struct Vertex {
    double x, y, z;
};

Vertex subtract(const Vertex& a, const Vertex& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

double determinant(const Vertex& a, const Vertex& b, const Vertex& c)
{
    return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

// Where a ray meets a triangle by Cramer's rule in double precision, with the least barycentric coordinate; its sign
// tells inside from outside.
struct ReferenceHit {
    double t, b1, b2, least;
};

ReferenceHit reference_hit(const Primitive& p, const TestRay& ray)
{
    const auto vertex = [](const float* v) { return Vertex{v[0], v[1], v[2]}; };
    const Vertex a = vertex(p.a.s), o = vertex(ray.origin), d = vertex(ray.direction);
    const Vertex e1 = subtract(vertex(p.b.s), a), e2 = subtract(vertex(p.c.s), a), s = subtract(o, a);
    const Vertex back{-d.x, -d.y, -d.z};
    const double whole = determinant(e1, e2, back);
    const double b1 = determinant(s, e2, back) / whole, b2 = determinant(e1, s, back) / whole;
    return {determinant(e1, e2, s) / whole, b1, b2, std::min({b1, b2, 1 - b1 - b2})};
}

std::vector<uint> every_id(const TraversalScene& scene)
{
    std::vector<uint> ids(scene.primitives().size());
    std::iota(ids.begin(), ids.end(), 0u);
    return ids;
}

TestRay down(float x, float z, float t_max = INFINITE)
{
    return {{x, 2, z}, {0, -1, 0}, t_max};
}

// Right triangle with legs of length 1 in the plane y = height.
Primitive floor_at(double height)
{
    return make_triangle(make_real4(0, height, 0), make_real4(1, height, 0), make_real4(0, height, 1));
}

// Within 3 degrees of the ray: distance and barycentrics magnify the rounding of floats.
bool seen_edge_on(const Primitive& p, const TestRay& ray)
{
    Vec3 a, b, d;
    for (int axis = 0; axis < 3; ++axis) {
        a[axis] = static_cast<double>(p.b.s[axis]) - p.a.s[axis];
        b[axis] = static_cast<double>(p.c.s[axis]) - p.a.s[axis];
        d[axis] = ray.direction[axis];
    }
    return std::abs(glm::dot(glm::normalize(glm::cross(a, b)), glm::normalize(d))) < 0.05;
}
} // namespace

TEST_CASE("testing every primitive finds the nearest triangle that double precision finds")
{
    const TraversalScene scene(random_triangles(300, 21));
    std::vector<TestRay> rays;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> u(-1, 1);
    for (int i = 0; i < 4000; ++i) {
        // Towards the inside of a triangle, so that most rays meet something.
        const Primitive& p = scene.primitives()[random() % scene.primitives().size()];
        TestRay ray{{2 * u(random), 2 * u(random), 2 * u(random)}, {}, INFINITE};
        for (int axis = 0; axis < 3; ++axis)
            ray.direction[axis] = (p.a.s[axis] + p.b.s[axis] + p.c.s[axis]) / 3 - ray.origin[axis];
        rays.push_back(ray);
    }
    for (const Device& device : test_devices()) {
        const TracedRays found = TraversalKernels(device).trace(scene, rays, ACCELERATOR_BRUTE_FORCE);
        std::size_t wrong = 0, decided = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            // Where a ray passes an edge within the rounding of floats, either answer is right.
            ReferenceHit nearest{INFINITE, 0, 0, 0};
            uint id = NO_INDEX;
            bool close_call = false;
            for (uint k = 0; k < scene.primitives().size(); ++k) {
                const ReferenceHit hit = reference_hit(scene.primitives()[k], rays[i]);
                close_call |=
                    std::abs(hit.least) < 1e-4 || (hit.least > 0 && seen_edge_on(scene.primitives()[k], rays[i]));
                if (hit.least < 0 || hit.t <= 0 || hit.t >= nearest.t) continue;
                nearest = hit;
                id = k;
            }
            if (close_call) continue;
            ++decided;
            float b1, b2;
            std::memcpy(&b1, &found.b1[i], sizeof b1);
            std::memcpy(&b2, &found.b2[i], sizeof b2);
            wrong += found.primitive[i] != id || std::abs(found.distance(i) - nearest.t) > 1e-5 * nearest.t ||
                     std::abs(b1 - nearest.b1) > 1e-3 || std::abs(b2 - nearest.b2) > 1e-3;
        }
        CHECK(decided > 2000);
        CHECK(wrong == 0);
    }
}

TEST_CASE("a leaf gives the same bits in any order and at every number of lanes: those of every primitive")
{
    // Triangles, spheres and disks of which many are met at the same distance.
    std::vector<Primitive> set{floor_at(0), floor_at(0), floor_at(0.5), floor_at(0), triangle_at(0.3, 0.2, 0.3, 0.3)};
    set.push_back(make_sphere(0.25, 0.25, 0.25, 0.25));
    set.push_back(make_sphere(0.25, 0.25, 0.25, 0.25));
    set.push_back(make_disk(0.3, 0.1, 0.3, 0.4));
    set.push_back(make_disk(0.3, 0.1, 0.3, 0.4));
    const TraversalScene scene(set);
    const std::vector<TestRay> rays = nasty_rays(set, 1400, 3);
    std::vector<uint> order = every_id(scene);
    std::mt19937 random(1);
    for (const Device& device : test_devices()) {
        TraversalKernels kernels(device);
        const TracedRays expected = kernels.trace(scene, rays, ACCELERATOR_BRUTE_FORCE);
        CHECK(std::count(expected.primitive.begin(), expected.primitive.end(), NO_INDEX) < 1200);
        for (const std::uint32_t lanes : LANE_COUNTS) {
            CAPTURE(lanes);
            const TracedRays every = kernels.trace(scene, rays, ACCELERATOR_BRUTE_FORCE, lanes);
            CHECK(differences(expected, every, rays) == std::vector<std::string>{});
            for (int permutation = 0; permutation < 5; ++permutation) {
                std::shuffle(order.begin(), order.end(), random);
                const TracedRays leaf = kernels.trace_leaf(scene, rays, order, lanes);
                CHECK(differences(expected, leaf, rays) == std::vector<std::string>{});
            }
        }
    }
}

TEST_CASE("of primitives at one distance the lowest is met, whichever stands first")
{
    const TraversalScene scene({floor_at(0), floor_at(1), floor_at(1), floor_at(1)});
    for (const Device& device : test_devices()) {
        TraversalKernels kernels(device);
        for (const std::vector<uint>& leaf : {std::vector<uint>{3, 2, 1, 0}, {0, 1, 2, 3}, {2, 0, 3, 1}}) {
            const TracedRays found = kernels.trace_leaf(scene, {down(0.25f, 0.25f)}, leaf);
            CHECK(found.primitive == std::vector<uint>{1});
            CHECK(found.distance(0) == 1.0f);
        }
    }
}

TEST_CASE("a hit at t_max is met but does not block")
{
    const TraversalScene scene({floor_at(1), make_sphere(5, 1, 0.25, 0.5), make_disk(0, 0, 0, 1)});
    const std::vector<TestRay> rays{down(0.25f, 0.25f, 1), down(0.25f, 0.25f, std::nextafter(1.0f, 0.0f)),
                                    down(0.25f, 0.25f, std::nextafter(1.0f, 2.0f)), down(0.25f, 0.25f, 0)};
    for (const Device& device : test_devices()) {
        const TracedRays found = TraversalKernels(device).trace_leaf(scene, rays, every_id(scene));
        CHECK(found.primitive == std::vector<uint>{0, NO_INDEX, 0, NO_INDEX});
        CHECK(found.occluded == std::vector<uint>{0, 0, 1, 0});
        CHECK(found.distance(1) == rays[1].t_max);
    }
}

TEST_CASE("a ray skips the primitive that it comes from and the one that it goes to")
{
    const TraversalScene scene({floor_at(1), floor_at(0.5), make_disk(0, 0, 0, 1)});
    std::vector<TestRay> rays(4, down(0.25f, 0.25f));
    rays[1].from = 0;
    rays[2].to = 0;
    rays[3].from = 0;
    rays[3].to = 1;
    for (const Device& device : test_devices()) {
        const TracedRays found = TraversalKernels(device).trace_leaf(scene, rays, every_id(scene));
        CHECK(found.primitive == std::vector<uint>{0, 1, 1, 2});
        CHECK(found.occluded == std::vector<uint>{1, 1, 1, 1});
    }
}

TEST_CASE("a ray that starts on a sphere meets it again only from inside")
{
    const TraversalScene scene({make_sphere(0, 0, 0, 1)});
    const std::vector<TestRay> rays{{{0, 0, 1}, {0, 0, -1}, INFINITE, 0},
                                    {{0, 0, 1}, {0, 0, 1}, INFINITE, 0},
                                    {{0, 0, 1}, {0.6f, 0, -0.8f}, INFINITE, 0}};
    for (const Device& device : test_devices()) {
        const TracedRays found = TraversalKernels(device).trace_leaf(scene, rays, {0});
        CHECK(found.primitive == std::vector<uint>{0, NO_INDEX, 0});
        CHECK(found.distance(0) == 2.0f);
        CHECK(found.distance(2) == Approx(1.6).epsilon(1e-6));
    }
}
} // namespace etendue
