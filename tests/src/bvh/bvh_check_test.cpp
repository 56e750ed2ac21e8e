// The structure check finds what is wrong.
#include "bvh/bvh_check.h"

#include "bvh/lbvh_host.h"
#include "check/primitive_sets.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>

namespace etendue
{
namespace
{
// The first inner child of a node other than the root: (node, child).
std::pair<std::size_t, std::size_t> find_child(const Bvh& bvh, bool leaf)
{
    for (std::size_t i = 1; i < bvh.nodes.size(); ++i)
        for (std::size_t c = 0; c < 2; ++c)
            if (((bvh.nodes[i].child.s[c] & LEAF_BIT) != 0) == leaf) return {i, c};
    FAIL("The tree is too small.");
    return {};
}

struct Corruption {
    const char* expected; // part of one violation
    std::function<void(Bvh&, std::vector<Primitive>&)> apply;
};
} // namespace

TEST_CASE("every seeded corruption of a tree is found")
{
    const std::vector<Corruption> corruptions{
        {"no nodes", [](Bvh& b, auto&) { b.nodes.clear(); }},
        {"list 199 primitives", [](Bvh& b, auto&) { b.leaf_primitives.pop_back(); }},
        {"is listed 2 times", [](Bvh& b, auto&) { b.leaf_primitives[3] = b.leaf_primitives[4]; }},
        {"is listed 0 times", [](Bvh& b, auto&) { b.leaf_primitives[3] = b.leaf_primitives[4]; }},
        {"lists primitive 1000", [](Bvh& b, auto&) { b.leaf_primitives[3] = 1000; }},
        {"reached more than once",
         [](Bvh& b, auto&) {
             const auto [i, c] = find_child(b, false);
             b.nodes[i].child.s[c] = 0;
         }},
        {"is never reached", [](Bvh& b, auto&) { b.nodes.push_back(b.nodes.back()); }},
        {", of",
         [](Bvh& b, auto&) {
             const auto [i, c] = find_child(b, false);
             b.nodes[i].child.s[c] = 12345;
         }},
        {"is a node and a leaf of 2",
         [](Bvh& b, auto&) {
             const auto [i, c] = find_child(b, false);
             b.nodes[i].child.s[c + 2] = 2;
         }},
        {"has 0 primitives",
         [](Bvh& b, auto&) {
             const auto [i, c] = find_child(b, true);
             b.nodes[i].child.s[c + 2] = 0;
         }},
        {"has 5 primitives",
         [](Bvh& b, auto&) {
             const auto [i, c] = find_child(b, true);
             b.nodes[i].child.s[c + 2] = 5;
         }},
        {"is in 0 leaves",
         [](Bvh& b, auto&) {
             const auto [i, c] = find_child(b, true);
             b.nodes[i].child.s[c] = (b.nodes[i].child.s[c] & ~LEAF_BIT) < 100 ? LEAF_BIT | 150u : LEAF_BIT | 50u;
         }},
        {"ends at position",
         [](Bvh& b, auto&) {
             const auto [i, c] = find_child(b, true);
             b.nodes[i].child.s[c] = LEAF_BIT | 200u;
         }},
        {"does not contain that of its child",
         [](Bvh& b, auto&) {
             const auto [i, c] = find_child(b, true);
             b.nodes[i].y.s[2 * c + 1] += 10;
         }},
        {"does not contain primitive",
         [](Bvh& b, auto&) {
             const auto [i, c] = find_child(b, true);
             b.nodes[i].z.s[2 * c] = b.nodes[i].z.s[2 * c + 1];
         }},
        {"is not finite",
         [](Bvh& b, auto&) {
             const auto [i, c] = find_child(b, false);
             b.nodes[i].x.s[2 * c] = -std::numeric_limits<float>::infinity();
         }},
        {"different kinds",
         [](Bvh& b, auto& primitives) {
             for (const BvhNode& node : b.nodes)
                 for (std::size_t c = 0; c < 2; ++c)
                     if (node.child.s[c + 2] > 1)
                         primitives[b.leaf_primitives[node.child.s[c] & ~LEAF_BIT]].a.s[3] = PRIMITIVE_SPHERE;
         }},
        {"say depth", [](Bvh& b, auto&) { ++b.statistics.depth; }},
        {"nodes, the tree has", [](Bvh& b, auto&) { ++b.statistics.node_count; }},
        {"leaves, the tree has", [](Bvh& b, auto&) { ++b.statistics.leaf_count; }},
        {"primitives, the scene has 200", [](Bvh& b, auto&) { ++b.statistics.primitive_count; }},
    };
    std::vector<Primitive> primitives = random_triangles(100);
    for (std::size_t i = 0; i < 100; ++i) primitives.push_back(primitives[i]);
    const Bvh valid = build_bvh_host(primitives);
    REQUIRE(check_bvh(valid, primitives) == std::vector<std::string>{});
    for (const Corruption& corruption : corruptions) {
        Bvh bvh = valid;
        std::vector<Primitive> scene = primitives;
        corruption.apply(bvh, scene);
        const std::vector<std::string> found = check_bvh(bvh, scene);
        CAPTURE(corruption.expected, found);
        CHECK(std::ranges::any_of(
            found, [&](const std::string& text) { return text.find(corruption.expected) != std::string::npos; }));
    }
}

TEST_CASE("a tree that is too deep is found")
{
    // A chain: node i has primitive i and node i + 1.
    constexpr uint COUNT = 100;
    const std::vector<Primitive> primitives(COUNT, triangle_at(0, 0, 0));
    Bvh bvh = build_bvh_host({primitives[0]});
    BvhNode node = bvh.nodes[0];
    for (real4* v : {&node.x, &node.y, &node.z}) v->s[2] = v->s[0], v->s[3] = v->s[1];
    bvh.nodes.clear();
    bvh.leaf_primitives.clear();
    for (uint i = 0; i < COUNT; ++i) {
        bvh.leaf_primitives.push_back(i);
        const bool last = i + 2 == COUNT;
        node.child = {{LEAF_BIT | i, last ? LEAF_BIT | (i + 1) : i + 1, 1, last ? 1u : 0u}};
        if (i + 1 < COUNT) bvh.nodes.push_back(node);
    }
    bvh.statistics = {COUNT, COUNT - 1, COUNT, COUNT - 1, 0.0, false, {}};
    CHECK(check_bvh(bvh, primitives) == std::vector<std::string>{"The tree is 99 deep; 100 primitives allow 70."});
}

TEST_CASE("an empty leaf that rays meet is found")
{
    Bvh bvh = build_bvh_host({});
    for (real4* v : {&bvh.nodes[0].x, &bvh.nodes[0].y, &bvh.nodes[0].z}) v->s[2] = 0, v->s[3] = 1;
    CHECK(check_bvh(bvh, {}) == std::vector<std::string>{"The empty leaf of node 0 has a box that rays meet."});
}

TEST_CASE("a thousand violations give a hundred sentences")
{
    Bvh bvh = build_bvh_host(random_triangles(1000));
    std::ranges::fill(bvh.leaf_primitives, 5u);
    CHECK(check_bvh(bvh, random_triangles(1000)).size() == 100);
}
} // namespace etendue
