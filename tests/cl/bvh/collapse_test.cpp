// Which nodes stay, and how they refer to each other, against a walk from the root.
#include "compute/kernel.h"
#include "reference_hierarchy.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

namespace etendue
{
namespace
{
bool is_leaf(const std::vector<cl_uint>& packed, uint reference)
{
    return (reference & LEAF_BIT) || (packed[reference] >> 3 & 1);
}

// Mark what a walk from the root meets that does not enter leaves.
void mark(const ReferenceHierarchy& tree, const std::vector<cl_uint>& packed, uint node, std::vector<cl_uint>& marks)
{
    marks[node] = 1;
    for (const uint child : tree.children[node].s)
        if (!is_leaf(packed, child)) mark(tree, packed, child, marks);
}

// Nodes of at most four primitives are leaves by chance; box i is i wide along every axis.
struct Fixture {
    explicit Fixture(const ReferenceHierarchy& tree) : packed(tree.count() - 1)
    {
        std::mt19937 random(tree.count());
        for (uint i = 0; i + 1 < tree.count(); ++i) {
            const uint primitives = tree.ranges[i].s[1] - tree.ranges[i].s[0] + 1;
            packed[i] = 1u | (i != 0 && primitives <= MAX_LEAF_PRIMITIVES && random() % 2 ? 8u : 0u) | 1u << 4;
            inner_boxes.push_back(make_real4(1, 2, 3));
            inner_boxes.push_back(make_real4(1 + i, 2 + i, 3 + i));
        }
        for (uint i = 0; i < tree.count(); ++i) {
            sorted_boxes.push_back(make_real4(-1, -2, -3, PRIMITIVE_TRIANGLE));
            sorted_boxes.push_back(make_real4(-1.0 + i, -2.0 + i, -3.0 + i));
        }
    }
    std::vector<cl_uint> packed;
    std::vector<cl_float4> inner_boxes, sorted_boxes;
};

void check_child(const ReferenceHierarchy& tree, const Fixture& fixture, const std::vector<cl_uint>& new_indices,
                 const BvhNode& node, uint old_reference, std::size_t c)
{
    const bool primitive = old_reference & LEAF_BIT;
    const uint i = old_reference & ~LEAF_BIT;
    if (primitive || is_leaf(fixture.packed, old_reference)) {
        const uint first = primitive ? i : tree.ranges[i].s[0], last = primitive ? i : tree.ranges[i].s[1];
        CHECK(node.child.s[c] == (LEAF_BIT | first));
        CHECK(node.child.s[c + 2] == last - first + 1);
    } else {
        CHECK(node.child.s[c] == new_indices[i]);
        CHECK(node.child.s[c + 2] == 0);
    }
    const float lower = primitive ? -1.0f : 1.0f, step = primitive ? -1.0f : 1.0f, size = static_cast<float>(i);
    CHECK(node.x.s[2 * c] == lower);
    CHECK(node.y.s[2 * c] == lower + step);
    CHECK(node.z.s[2 * c] == lower + 2 * step);
    CHECK(node.x.s[2 * c + 1] == lower + size);
    CHECK(node.y.s[2 * c + 1] == lower + step + size);
    CHECK(node.z.s[2 * c + 1] == lower + 2 * step + size);
}
} // namespace

TEST_CASE("the nodes that stay are those that a walk from the root meets, renumbered in order")
{
    for (const Device& device : test_devices()) {
        const Program program(device, "bvh_build.cl", "-DLANES=1", KernelCache::none());
        for (const std::vector<cl_ulong>& codes : code_sets()) {
            const ReferenceHierarchy tree(codes);
            const cl_uint count = tree.count();
            const Fixture fixture(tree);
            std::vector<cl_uint> expected(count, 0);
            mark(tree, fixture.packed, 0, expected);

            const Buffer<cl_uint2> children(device, "children", tree.children), ranges(device, "ranges", tree.ranges);
            const Buffer<cl_uint> parents(device, "parents", tree.parents), packed(device, "packed", fixture.packed);
            Buffer<cl_uint> marks(device, "marks", count);
            Kernel(program, "mark_nodes").launch(count, 0, count, packed, ranges, parents, marks);
            CAPTURE(count);
            REQUIRE(marks.read() == expected);

            std::vector<cl_uint> new_indices(count);
            for (uint i = 1; i < count; ++i) new_indices[i] = new_indices[i - 1] + expected[i - 1];
            Buffer<BvhNode> nodes(device, "nodes", new_indices.back());
            Kernel(program, "emit_nodes")
                .launch(count, 0, count, Buffer<cl_float4>(device, "boxes", fixture.sorted_boxes), children, ranges,
                        Buffer<cl_float4>(device, "inner boxes", fixture.inner_boxes), packed,
                        Buffer<cl_uint>(device, "new indices", new_indices), nodes);
            const std::vector<BvhNode> written = nodes.read();
            for (uint i = 0; i + 1 < count; ++i)
                for (std::size_t c = 0; expected[i] && c < 2; ++c)
                    check_child(tree, fixture, new_indices, written[new_indices[i]], tree.children[i].s[c], c);
        }
    }
}
} // namespace etendue
