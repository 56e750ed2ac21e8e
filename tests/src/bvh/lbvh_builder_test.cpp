// The tree that the kernels build is the host's, bit for bit.
#include "bvh/lbvh_builder.h"

#include "bvh/bvh_check.h"
#include "bvh/lbvh_host.h"
#include "check/primitive_sets.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>
#include <cstring>

namespace etendue
{
namespace
{
bool same_bits(const Bvh& a, const Bvh& b)
{
    return a.nodes.size() == b.nodes.size() &&
           std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0 &&
           a.leaf_primitives == b.leaf_primitives && a.statistics.depth == b.statistics.depth &&
           a.statistics.node_count == b.statistics.node_count && a.statistics.leaf_count == b.statistics.leaf_count &&
           a.statistics.sah_cost == b.statistics.sah_cost;
}
} // namespace

TEST_CASE("device and host build the same tree, climbing or level by level, however the work is divided")
{
    const std::vector<PrimitiveSet> sets = primitive_sets();
    for (const Device& device : test_devices()) {
        LbvhBuilder builder(device, KernelCache::none());
        for (const PrimitiveSet& set : sets) {
            const Bvh expected = build_bvh_host(set.primitives);
            const Buffer<Primitive> primitives(device, "primitives", set.primitives);
            const std::uint32_t count = static_cast<std::uint32_t>(set.primitives.size());
            for (const LbvhOptions& options :
                 {LbvhOptions{}, LbvhOptions{}, LbvhOptions{true, 0}, LbvhOptions{false, 1}, LbvhOptions{false, 777}}) {
                const DeviceBvh built = builder.build(primitives, count, options);
                CAPTURE(set.name, options.level_by_level, options.chunk_count);
                CHECK(same_bits(download(built), expected));
                CHECK(built.statistics.built_on_device == (count >= 2));
            }
        }
    }
}

TEST_CASE("the tree covers the first primitives of a longer buffer")
{
    std::vector<Primitive> set = random_triangles(500);
    for (const Device& device : test_devices()) {
        const Buffer<Primitive> primitives(device, "primitives", set);
        LbvhBuilder builder(device, KernelCache::none());
        for (const std::uint32_t count : {0u, 1u, 2u, 300u}) {
            const std::vector<Primitive> first(set.begin(), set.begin() + count);
            CHECK(same_bits(download(builder.build(primitives, count)), build_bvh_host(first)));
        }
    }
}

TEST_CASE("a tree survives the way to the device and back")
{
    const Bvh bvh = build_bvh_host(random_triangles(100));
    for (const Device& device : test_devices()) CHECK(same_bits(download(upload(device, bvh)), bvh));
}

TEST_CASE("the phases of a build are named and timed")
{
    for (const Device& device : test_devices()) {
        const Buffer<Primitive> primitives(device, "primitives", random_triangles(100));
        const DeviceBvh bvh = LbvhBuilder(device, KernelCache::none()).build(primitives, 100);
        std::vector<std::string> names;
        for (const auto& [name, seconds] : bvh.statistics.phases) {
            names.push_back(name);
            CHECK(seconds > 0);
        }
        CHECK(names ==
              std::vector<std::string>{"boxes", "codes", "sort", "hierarchy", "boxes and leaves", "compaction"});
    }
}
} // namespace etendue
