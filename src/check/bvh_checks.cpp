// Rays by the tree against testing every primitive, on what breaks trees; closed meshes.
#include "check/bvh_checks.h"

#include "bvh/bvh_check.h"
#include "bvh/lbvh_host.h"
#include "check/closed_meshes.h"
#include "check/device_functions.h"
#include "check/findings.h"
#include "check/traversal_cases.h"
#include "util/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>

#include <fmt/format.h>

namespace etendue
{
namespace
{
using Results = std::vector<CheckResult>;

constexpr double INVALID_RAYS_LIMIT = 2.5; // times slower than valid ones: the rule of Embree's own verification
constexpr double VISITS_LIMIT = 2.0;

// The kernels of the device that is checked, compiled once for all checks of a list.
class SharedKernels
{
public:
    TraversalKernels& on(const CheckContext& context)
    {
        // Kernels keep their OpenCL context alive, so that no other one can have its handle.
        const cl_context handle = context.device->context()();
        if (!kernels_ || handle_ != handle) {
            kernels_.reset();
            kernels_.emplace(*context.device);
            handle_ = handle;
        }
        return *kernels_;
    }

private:
    std::optional<TraversalKernels> kernels_;
    cl_context handle_ = nullptr;
};

void expect_same(const TracedRays& expected, const TracedRays& found, const std::vector<TestRay>& rays,
                 Violations& violations)
{
    for (std::size_t i = 0; i < rays.size(); ++i) {
        violations.expect(found.valid[i] == expected.valid[i], "validity");
        violations.expect(found.primitive[i] == expected.primitive[i], "primitive");
        violations.expect(found.t[i] == expected.t[i] && found.b1[i] == expected.b1[i] && found.b2[i] == expected.b2[i],
                          "distance or barycentrics");
        violations.expect(found.occluded[i] == expected.occluded[i], "occlusion");
        violations.expect(found.complete[i] != 0, "stack too small");
    }
}

// B1, B2, B3, B4: the same bits by the tree, with one lane and many; occlusion agrees with the closest hit.
Results check_traversal(SharedKernels& shared, const CheckContext& context, const std::string& name, double rays_factor)
{
    TraversalKernels& kernels = shared.on(context);
    Violations same, consistent;
    std::size_t hits = 0, rays_traced = 0;
    for (const TraversalCase& c : traversal_cases()) {
        const TraversalScene scene(c.primitives);
        const auto trace_all = [&](const std::vector<TestRay>& rays) {
            const TracedRays expected = kernels.trace(scene, rays, ACCELERATOR_BRUTE_FORCE, context.lanes);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const bool met = expected.primitive[i] != NO_INDEX;
                hits += met;
                consistent.expect(expected.valid[i] == static_cast<uint>(is_valid(rays[i])), "validity");
                consistent.expect(expected.valid[i] || !met, "hit of an invalid ray");
                consistent.expect(expected.occluded[i] ==
                                      static_cast<uint>(met && expected.distance(i) < rays[i].t_max),
                                  "occlusion");
            }
            for (const std::uint32_t lanes : {1u, context.lanes ? context.lanes : context.device->preferred_lanes()})
                expect_same(expected, kernels.trace(scene, rays, ACCELERATOR_LBVH, lanes), rays, same);
            rays_traced += rays.size();
            return expected;
        };
        same.set_subject(c.name);
        consistent.set_subject(c.name);
        const auto count = static_cast<std::size_t>(static_cast<double>(c.rays) * rays_factor * context.effort);
        const std::vector<TestRay> rays = nasty_rays(c.primitives, count, static_cast<unsigned>(context.seed + 1));
        std::vector<TestRay> tied = tied_rays(rays, trace_all(rays));
        tied.resize(std::min(tied.size(), count / 4));
        if (!tied.empty()) trace_all(tied);
    }
    Violations enough;
    enough.add_trials(rays_traced);
    enough.add("rays that meet something are too few", hits < rays_traced / 3 ? 1 : 0);
    return {same.result(name, Rule::exact), consistent.result(name + "-occlusion", Rule::exact),
            enough.result(name + "-rays")};
}

// B2, B4: each primitive in one leaf, boxes around boxes, depth within its bound.
Results check_structure(const CheckContext&)
{
    Violations violations;
    for (const PrimitiveSet& set : primitive_sets()) {
        violations.set_subject(set.name);
        violations.add_trials(std::max<std::size_t>(set.primitives.size(), 1));
        for (const std::string& sentence : check_bvh(build_bvh_host(set.primitives), set.primitives))
            violations.add(sentence.c_str(), 1);
    }
    return {violations.result("bvh-structure", Rule::exact)};
}

// B4: more triangles than a float can number.
Results check_many(const CheckContext&)
{
    const std::vector<Primitive> primitives = random_triangles((1u << 24) + 1);
    Violations violations;
    violations.add_trials(primitives.size());
    for (const std::string& sentence : check_bvh(build_bvh_host(primitives), primitives))
        violations.add(sentence.c_str(), 1);
    return {violations.result("bvh-16777217-triangles", Rule::exact)};
}

// B5: rays with numbers that are none, infinite ones or no direction meet nothing, and do not take long over it.
Results check_invalid_rays(SharedKernels& shared, const CheckContext& context)
{
    TraversalKernels& kernels = shared.on(context);
    const TraversalScene scene(soup(2000));
    std::vector<TestRay> valid, invalid;
    for (const TestRay& ray : nasty_rays(scene.primitives(), 1 << 17, static_cast<unsigned>(context.seed + 2)))
        if (is_valid(ray)) valid.push_back(ray);
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < valid.size(); ++i) {
        TestRay ray = valid[i];
        const float bad = i % 3 == 0 ? nan : i % 3 == 1 ? infinity : -infinity;
        if (i % 8 == 7)
            ray.direction[0] = ray.direction[1] = ray.direction[2] = i % 16 == 7 ? 0.0f : -0.0f;
        else if (i % 8 == 6)
            ray.t_max = i % 16 == 6 ? nan : -1.0f;
        else
            (i % 8 < 3 ? ray.origin : ray.direction)[i % 8 % 3] = bad;
        invalid.push_back(ray);
    }
    TracedRays traced;
    const auto seconds = [&](const std::vector<TestRay>& rays) {
        double least = std::numeric_limits<double>::infinity();
        for (int run = 0; run < 4; ++run) {
            const Stopwatch watch;
            traced = kernels.trace(scene, rays, ACCELERATOR_LBVH, context.lanes);
            least = std::min(least, watch.seconds());
        }
        return least;
    };
    const double for_valid = seconds(valid), for_invalid = seconds(invalid);
    Violations hits;
    for (std::size_t i = 0; i < invalid.size(); ++i)
        hits.expect(!traced.valid[i] && traced.primitive[i] == NO_INDEX && !traced.occluded[i], "hits");
    WorstError time;
    time.add(for_invalid / for_valid);
    return {hits.result("invalid-rays"), time.result("invalid-rays-time", INVALID_RAYS_LIMIT, "x valid rays")};
}

// B6: rays along an axis through the vertices of a grid visit hardly more than tilted ones, and miss nothing.
Results check_axis_rays(SharedKernels& shared, const CheckContext& context)
{
    constexpr int SIDE = 64;
    std::vector<Primitive> grid;
    const auto vertex = [](int i, int k) { return make_real4(i / 32.0 - 1, 0, k / 32.0 - 1); };
    for (int i = 0; i < SIDE; ++i)
        for (int k = 0; k < SIDE; ++k) {
            grid.push_back(make_triangle(vertex(i, k), vertex(i + 1, k), vertex(i, k + 1)));
            grid.push_back(make_triangle(vertex(i + 1, k), vertex(i + 1, k + 1), vertex(i, k + 1)));
        }
    std::vector<TestRay> straight, tilted;
    for (int i = 0; i <= SIDE; ++i)
        for (int k = 0; k <= SIDE; ++k)
            for (const float zero : {0.0f, -0.0f}) {
                const real4 v = vertex(i, k);
                TestRay ray{{v.s[0], 1, v.s[2]}, {zero, -1, zero}, std::numeric_limits<float>::infinity()};
                straight.push_back(ray);
                ray.direction[0] = ray.direction[2] = 1e-3f;
                tilted.push_back(ray);
            }
    TraversalKernels& kernels = shared.on(context);
    const TraversalScene scene(grid);
    Violations misses;
    const auto mean_visits = [&](const std::vector<TestRay>& rays) {
        const std::vector<uint> visits = kernels.visits(scene, rays);
        for (const uint count : visits) misses.expect(count > 0, "stack too small");
        return std::accumulate(visits.begin(), visits.end(), 0.0) / static_cast<double>(visits.size());
    };
    WorstError ratio;
    ratio.add(mean_visits(straight) / mean_visits(tilted));
    for (const uint id : kernels.trace(scene, straight, ACCELERATOR_LBVH, context.lanes).primitive)
        misses.expect(id != NO_INDEX, "misses");
    return {ratio.result("axis-rays-visits", VISITS_LIMIT, "x tilted rays"), misses.result("axis-rays-misses")};
}

TestRay ray_through(const Long3& origin, const Long3& target)
{
    TestRay ray{};
    ray.t_max = std::numeric_limits<float>::infinity();
    ray.from = ray.to = NO_INDEX;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = static_cast<float>(origin[axis]);
        ray.direction[axis] = static_cast<float>(target[axis] - origin[axis]);
    }
    return ray;
}

// Rays from inside a mesh, to vertices, to the middle of edges and anywhere in turn; the origin is rounded first, so
// that the direction aims from where the ray begins.
std::vector<TestRay> rays_from_inside(const ClosedMesh& mesh, std::size_t count)
{
    Randoms randoms;
    std::vector<TestRay> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const Long3 origin = to_long(round_to_float(mesh.inside(randoms)));
        const Primitive& triangle = mesh.triangles[i / 3 % mesh.triangles.size()];
        const std::size_t which = i / 3 / mesh.triangles.size() % 3;
        const Long3 vertices[] = {to_long(triangle.a), to_long(triangle.b), to_long(triangle.c)};
        const Long3 targets[] = {vertices[which], 0.5l * (vertices[which] + vertices[(which + 1) % 3]),
                                 origin + randoms.direction()};
        rays.push_back(ray_through(origin, targets[i % 3]));
    }
    return rays;
}

// R1: no ray from inside a closed mesh gets out, wherever the mesh is.
Results check_watertight(SharedKernels& shared, const CheckContext& context, const std::string& name, double rays)
{
    struct Place {
        const char* name;
        Placement placement;
    };
    // Embree's offset is the one of its own verification.
    const Place places[] = {
        {"-at-origin", {}}, {"-at-1e5", {1, {1e5l, 1e5l, 1e5l}}}, {"-at-embree-offset", {1, {148376, 1234, -223423}}}};
    TraversalKernels& kernels = shared.on(context);
    Results results;
    for (const Place& place : places) {
        Violations violations;
        for (const ClosedMesh& mesh : make_closed_meshes(place.placement)) {
            const TraversalScene scene(mesh.triangles);
            const auto inside = rays_from_inside(mesh, static_cast<std::size_t>(rays * context.effort / 12));
            violations.set_subject(mesh.name);
            for (const uint id : kernels.trace(scene, inside, ACCELERATOR_LBVH, context.lanes).primitive)
                violations.expect(id != NO_INDEX, "rays that got out");
        }
        results.push_back(violations.result(name + place.name));
    }
    return results;
}

// R2: the diagonal of a square, an integer grid from above, and the vertices of a turned grid.
Results check_known_misses(SharedKernels& shared, const CheckContext& context)
{
    TraversalKernels& kernels = shared.on(context);
    Violations violations;
    const auto expect_hits = [&](const char* what, const std::vector<Primitive>& set,
                                 const std::vector<TestRay>& rays) {
        violations.set_subject(what);
        for (const uint id : kernels.trace(TraversalScene(set), rays, ACCELERATOR_LBVH, context.lanes).primitive)
            violations.expect(id != NO_INDEX, "misses");
    };
    const auto add_square = [](std::vector<Primitive>& set, const Long3& a, const Long3& b, const Long3& c,
                               const Long3& d) {
        set.push_back(make_triangle(a, b, c));
        set.push_back(make_triangle(c, d, a));
    };
    // A direction that misses both halves of a square at its diagonal where they are tested one by one.
    std::vector<Primitive> square;
    add_square(square, {-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0});
    const Long3 direction{.30458447l, .30458447l, -.9024725l};
    expect_hits("diagonal", square, {ray_through({0, 0, 10}, Long3{0, 0, 10} + direction)});

    std::vector<Primitive> grid;
    std::vector<TestRay> rays;
    for (int x = 0; x < 8; ++x)
        for (int y = 0; y < 8; ++y) {
            const auto at = [&](int dx, int dy) {
                return Long3{static_cast<long double>(x + dx), static_cast<long double>(y + dy),
                             static_cast<long double>((x + dx) * (y + dy) % 3)};
            };
            add_square(grid, at(0, 0), at(1, 0), at(1, 1), at(0, 1));
        }
    for (int x = 0; x <= 32; ++x)
        for (int y = 0; y <= 32; ++y)
            for (const long double side : {10.0l, -10.0l}) {
                const Long3 origin{x / 4.0l, y / 4.0l, side};
                rays.push_back(ray_through(origin, origin - Long3{0, 0, side}));
            }
    expect_hits("integer grid", grid, rays);

    // Two turns about different axes, so that no coordinate is round.
    const auto turned = [](long double x, long double y) {
        const long double c = std::cos(0.7l), s = std::sin(0.7l), k = std::cos(0.4l), h = std::sin(0.4l);
        const long double x1 = c * x - s * y, y1 = s * x + c * y;
        return Long3{x1, k * y1, h * y1};
    };
    grid.clear(), rays.clear();
    for (int x = -16; x < 16; ++x)
        for (int y = -16; y < 16; ++y)
            add_square(grid, turned(x / 16.0l, y / 16.0l), turned((x + 1) / 16.0l, y / 16.0l),
                       turned((x + 1) / 16.0l, (y + 1) / 16.0l), turned(x / 16.0l, (y + 1) / 16.0l));
    for (int x = -15; x <= 15; ++x)
        for (int y = -15; y <= 15; ++y) {
            const Long3 vertex = to_long(round_to_float(turned(x / 16.0l, y / 16.0l)));
            rays.push_back(ray_through({0.25l, -0.5l, 5}, vertex));
            rays.push_back(ray_through(vertex + Long3{0, 0, 4}, vertex));
        }
    expect_hits("turned grid", grid, rays);
    return {violations.result("known-misses")};
}
} // namespace

std::vector<CheckResult> check_watertight(const CheckContext& context, const std::string& name, double rays)
{
    SharedKernels kernels;
    return check_watertight(kernels, context, name, rays);
}

std::vector<Check> bvh_checks()
{
    const auto kernels = std::make_shared<SharedKernels>();
    const auto add = [](std::vector<Check>& checks, const std::string& name, auto run, bool is_long = false) {
        checks.push_back(make_check("bvh", name, run, 0, is_long));
    };
    std::vector<Check> checks;
    add(checks, "bvh-structure", check_structure);
    add(checks, "bvh-16777217-triangles", check_many, true);
    add(checks, "bvh-device-tree",
        [](const CheckContext& c) { return Results{check_device_tree(c, "bvh-device-tree")}; });
    add(checks, "bvh-sort", [](const CheckContext& c) { return Results{check_sort(c, "bvh-sort")}; });
    add(checks, "traversal", [=](const CheckContext& c) { return check_traversal(*kernels, c, "traversal", 0.5); });
    add(
        checks, "traversal-million",
        [=](const CheckContext& c) { return check_traversal(*kernels, c, "traversal-million", 6); }, true);
    add(checks, "invalid-rays", [=](const CheckContext& c) { return check_invalid_rays(*kernels, c); });
    add(checks, "axis-rays", [=](const CheckContext& c) { return check_axis_rays(*kernels, c); });
    add(checks, "watertight", [=](const CheckContext& c) { return check_watertight(*kernels, c, "watertight", 1e6); });
    add(
        checks, "watertight-long",
        [=](const CheckContext& c) { return check_watertight(*kernels, c, "watertight-long", 1e7); }, true);
    add(checks, "known-misses", [=](const CheckContext& c) { return check_known_misses(*kernels, c); });
    for (Check& check : offset_checks()) checks.push_back(std::move(check));
    return checks;
}
} // namespace etendue
