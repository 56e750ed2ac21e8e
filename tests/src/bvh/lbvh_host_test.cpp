// The tree that the host builds.
#include "bvh/lbvh_host.h"

#include "bvh/bvh_check.h"
#include "check/primitive_sets.h"
#include "util/error.h"

#include <algorithm>
#include <catch2/catch.hpp>

namespace etendue
{
namespace
{
double half_area(const BvhNode& node, std::size_t child)
{
    const std::size_t k = 2 * child;
    const double x = static_cast<double>(node.x.s[k + 1]) - node.x.s[k],
                 y = static_cast<double>(node.y.s[k + 1]) - node.y.s[k],
                 z = static_cast<double>(node.z.s[k + 1]) - node.z.s[k];
    return node.x.s[k] > node.x.s[k + 1] ? 0 : x * y + y * z + z * x;
}

// Half area of the box around both children.
double half_area(const BvhNode& node)
{
    const auto extent = [](const real4& v) {
        return static_cast<double>(std::max(v.s[1], v.s[3])) - static_cast<double>(std::min(v.s[0], v.s[2]));
    };
    const double x = extent(node.x), y = extent(node.y), z = extent(node.z);
    return x * y + y * z + z * x;
}

// The surface area heuristic by its definition, in double precision.
double sah_cost(const Bvh& bvh)
{
    double sum = half_area(bvh.nodes[0]);
    for (const BvhNode& node : bvh.nodes)
        for (std::size_t c = 0; c < 2; ++c)
            sum += half_area(node, c) * ((node.child.s[c] & LEAF_BIT) ? node.child.s[c + 2] : 1.0);
    return sum / half_area(bvh.nodes[0]);
}
} // namespace

TEST_CASE("the host's tree is valid for every set of primitives")
{
    for (const PrimitiveSet& set : primitive_sets()) {
        CAPTURE(set.name);
        CHECK(check_bvh(build_bvh_host(set.primitives), set.primitives) == std::vector<std::string>{});
    }
}

TEST_CASE("the recorded cost is the surface area heuristic of the nodes")
{
    for (const std::size_t count : {2, 3, 10, 1000, 20000}) {
        const Bvh bvh = build_bvh_host(random_triangles(count));
        CHECK(bvh.statistics.sah_cost == Approx(sah_cost(bvh)).epsilon(1e-5));
    }
    CHECK(build_bvh_host(random_triangles(1)).statistics.sah_cost == 2);
    CHECK(build_bvh_host({}).statistics.sah_cost == 0);
}

TEST_CASE("no primitives give two empty leaves, one primitive a leaf beside an empty one")
{
    const Bvh none = build_bvh_host({});
    REQUIRE(none.nodes.size() == 1);
    CHECK(none.leaf_primitives.empty());
    for (std::size_t c = 0; c < 2; ++c) {
        CHECK((none.nodes[0].child.s[c] & LEAF_BIT));
        CHECK(none.nodes[0].child.s[c + 2] == 0);
        CHECK(none.nodes[0].x.s[2 * c] > none.nodes[0].x.s[2 * c + 1]);
    }
    const Bvh one = build_bvh_host(random_triangles(1));
    REQUIRE(one.nodes.size() == 1);
    CHECK(one.nodes[0].child.s[0] == LEAF_BIT);
    CHECK(one.nodes[0].child.s[2] == 1);
    CHECK(one.nodes[0].child.s[3] == 0);
    CHECK(one.nodes[0].x.s[0] < one.nodes[0].x.s[1]);
}

TEST_CASE("primitives on one spot share leaves, but kinds do not")
{
    std::vector<Primitive> set(8, triangle_at(0, 0, 0));
    const Bvh same = build_bvh_host(set);
    CHECK(same.nodes.size() == 1);
    CHECK(same.nodes[0].child.s[2] == 4);
    CHECK(same.nodes[0].child.s[3] == 4);

    set = {triangle_at(0, 0, 0), make_sphere(0, 0, 0, 0.01), make_disk(0, 0, 0, 0.01), triangle_at(0, 0, 0)};
    CHECK(build_bvh_host(set).statistics.leaf_count == 4);
}

TEST_CASE("primitives far apart have leaves of their own")
{
    std::vector<Primitive> set;
    for (int i = 0; i < 8; ++i) set.push_back(triangle_at(i & 1, i >> 1 & 1, i >> 2, 1e-3));
    const Bvh bvh = build_bvh_host(set);
    CHECK(bvh.statistics.leaf_count == 8);
    CHECK(bvh.statistics.depth == 3);
    CHECK(bvh.leaf_primitives == std::vector<uint>{0, 4, 2, 6, 1, 5, 3, 7});
}

TEST_CASE("equal codes give a balanced tree")
{
    const Bvh bvh = build_bvh_host(std::vector<Primitive>(1u << 16, triangle_at(0.25, 0.5, -0.5)));
    CHECK(bvh.statistics.depth == 14);
    CHECK(bvh.statistics.leaf_count == 1u << 14);
}

TEST_CASE("a primitive that is not finite changes no other's box")
{
    std::vector<Primitive> set = random_triangles(1000);
    const double clean = build_bvh_host(set).statistics.sah_cost;
    for (int i = 0; i < 10; ++i) set.push_back(triangle_at(std::nan(""), 0, 0));
    const Bvh bvh = build_bvh_host(set);
    CHECK(bvh.statistics.sah_cost < 1.02 * clean);
    for (const BvhNode& node : bvh.nodes)
        for (const real4& v : {node.x, node.y, node.z}) {
            CHECK_FALSE(std::max(v.s[1], v.s[3]) > 2);
            CHECK_FALSE(std::min(v.s[0], v.s[2]) < -2);
        }
}

TEST_CASE("more primitives than numbers are an error")
{
    CHECK_NOTHROW(check_primitive_count(0x7fffffffu));
    CHECK_THROWS_AS(check_primitive_count(0x80000000u), SceneError);
}
} // namespace etendue
