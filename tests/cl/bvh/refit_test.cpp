// Boxes, costs and leaves bottom-up against brute force over each node's range.
#include "compute/kernel.h"
#include "reference_hierarchy.h"
#include "support/device_evaluate.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

namespace etendue
{
namespace
{
// Inner nodes as the kernels store them.
struct Refitted {
    std::vector<cl_float4> boxes; // lower (w: cost), upper
    std::vector<cl_uint> packed;
};

// Padded boxes of random triangles, spheres and disks, in clusters of one kind, some of nothing.
std::vector<cl_float4> random_boxes(uint count)
{
    std::mt19937 random(count);
    std::uniform_real_distribution<float> u(0, 1);
    const float infinity = std::numeric_limits<float>::infinity();
    std::vector<cl_float4> boxes;
    for (uint i = 0; i < count; ++i) {
        const uint kind = i / 8 % 3;
        const float x = static_cast<float>(i) + u(random), y = u(random), z = u(random);
        if (i % 11 == 10) {
            boxes.push_back({{infinity, infinity, infinity, static_cast<float>(kind)}});
            boxes.push_back({{-infinity, -infinity, -infinity, 0}});
        } else {
            boxes.push_back({{x, y, z, static_cast<float>(kind)}});
            boxes.push_back({{x + 2 * u(random), y + u(random), z + u(random), 0}});
        }
    }
    return boxes;
}

class Inputs
{
public:
    Inputs(const Device& device, const Program& program, const ReferenceHierarchy& tree,
           const std::vector<cl_float4>& boxes)
        : device_(device), program_(program), count_(tree.count()), sorted_boxes_(device, "boxes", boxes),
          children_(device, "children", tree.children), ranges_(device, "ranges", tree.ranges),
          parents_(device, "parents", tree.parents), inner_boxes_(device, "inner boxes", 2 * std::size_t{count_ - 1}),
          packed_(device, "packed", count_ - 1)
    {
    }

    Refitted climb()
    {
        Buffer<cl_uint> arrivals(device_, "arrivals", std::vector<cl_uint>(count_ - 1, 0));
        Kernel(program_, "climb_boxes")
            .launch(count_, 0, count_, sorted_boxes_, children_, ranges_, parents_, arrivals, inner_boxes_, packed_);
        return {inner_boxes_.read(), packed_.read()};
    }

    Refitted by_levels(const std::vector<cl_uint>& expected_levels)
    {
        Buffer<cl_uint> levels(device_, "levels", count_ - 1), deepest(device_, "deepest", std::vector<cl_uint>{0});
        Kernel(program_, "node_levels").launch(count_, 0, count_, parents_, levels, deepest);
        CHECK(levels.read() == expected_levels);
        CHECK(deepest.read().front() == *std::ranges::max_element(expected_levels));
        Kernel refit(program_, "refit_level");
        for (cl_uint level = deepest.read().front() + 1; level-- > 0;)
            refit.launch(count_, 0, count_, level, sorted_boxes_, children_, ranges_, levels, inner_boxes_, packed_);
        return {inner_boxes_.read(), packed_.read()};
    }

private:
    const Device& device_;
    const Program& program_;
    cl_uint count_;
    Buffer<cl_float4> sorted_boxes_;
    Buffer<cl_uint2> children_, ranges_;
    Buffer<cl_uint> parents_;
    Buffer<cl_float4> inner_boxes_;
    Buffer<cl_uint> packed_;
};

double half_area(const std::array<double, 6>& box)
{
    const double x = box[3] - box[0], y = box[4] - box[1], z = box[5] - box[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
}

std::array<double, 6> box_at(const std::vector<cl_float4>& boxes, std::size_t i)
{
    const cl_float4 &l = boxes[2 * i], &u = boxes[2 * i + 1];
    return {l.s[0], l.s[1], l.s[2], u.s[0], u.s[1], u.s[2]};
}

struct Checked {
    double cost;
    uint depth, kinds;
};

// Check a subtree against double precision; where two costs are nearly equal, the device's decision is taken.
Checked check_subtree(const ReferenceHierarchy& tree, const std::vector<cl_float4>& boxes, const Refitted& result,
                      uint reference)
{
    if (reference & LEAF_BIT) {
        const uint position = reference & ~LEAF_BIT;
        return {half_area(box_at(boxes, position)), 0, 1u << static_cast<uint>(boxes[2 * position].s[3])};
    }
    const auto [first, last] = std::pair{tree.ranges[reference].s[0], tree.ranges[reference].s[1]};
    std::array<double, 6> box = box_at(boxes, first);
    for (uint i = first + 1; i <= last; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            box[k] = std::min(box[k], box_at(boxes, i)[k]);
            box[k + 3] = std::max(box[k + 3], box_at(boxes, i)[k + 3]);
        }
    const Checked a = check_subtree(tree, boxes, result, tree.children[reference].s[0]);
    const Checked b = check_subtree(tree, boxes, result, tree.children[reference].s[1]);
    const uint kinds = a.kinds | b.kinds, primitives = last - first + 1;
    const double inner = half_area(box) + a.cost + b.cost, leaf = primitives * half_area(box);
    const uint word = result.packed[reference];
    const bool is_leaf = word >> 3 & 1;
    const bool allowed = reference != 0 && primitives <= 4 && (kinds == 1 || kinds == 2 || kinds == 4);
    CAPTURE(reference, first, last, inner, leaf);
    CHECK(box_at(result.boxes, reference) == box);
    CHECK((word & 7) == kinds);
    if (!allowed || std::abs(inner - leaf) > 1e-6 * inner) CHECK(is_leaf == (allowed && leaf <= inner));
    const Checked checked{is_leaf ? leaf : inner, is_leaf ? 0 : 1 + std::max(a.depth, b.depth), kinds};
    CHECK(word >> 4 == checked.depth);
    CHECK(static_cast<double>(result.boxes[2 * reference].s[3]) == Approx(checked.cost).epsilon(1e-5));
    return checked;
}
} // namespace

TEST_CASE("the climb fills every node from its children, and level by level gives the same bits")
{
    for (const Device& device : test_devices()) {
        const Program program(device, "bvh_build.cl", "-DLANES=1", KernelCache::none());
        for (const std::vector<cl_ulong>& codes : code_sets()) {
            const ReferenceHierarchy tree(codes);
            const std::vector<cl_float4> boxes = random_boxes(tree.count());
            std::vector<cl_uint> levels(tree.count() - 1, 0);
            for (uint i = 0; i + 1 < tree.count(); ++i)
                for (uint node = tree.parents[i]; node != NO_INDEX; node = tree.parents[node]) ++levels[i];

            Inputs inputs(device, program, tree, boxes);
            const Refitted climbed = inputs.climb();
            const Refitted by_levels = inputs.by_levels(levels);
            check_subtree(tree, boxes, climbed, 0);
            CHECK(climbed.packed == by_levels.packed);
            CHECK(std::memcmp(climbed.boxes.data(), by_levels.boxes.data(), climbed.boxes.size() * sizeof(cl_float4)) ==
                  0);
        }
    }
}
} // namespace etendue
