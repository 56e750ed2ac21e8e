// The linear BVH, built by kernels: the order of the launches.
#include "bvh/lbvh_builder.h"

#include "bvh/box.h"
#include "bvh/launch_size.h"
#include "bvh/lbvh_host.h"
#include "util/stopwatch.h"

namespace etendue
{
// The tree before compaction: count - 1 inner nodes over `count` sorted primitives (cl/bvh/refit.h says what is what).
struct LbvhBuilder::Tree {
    Tree(const Device& device, std::uint32_t primitive_count)
        : count(primitive_count), launch(launch_size(device, count)),
          primitive_boxes(device, "primitive boxes", 2 * std::size_t{count}),
          sorted_boxes(device, "sorted boxes", 2 * std::size_t{count}), codes(device, "morton codes", count),
          sorted_primitives(device, "leaf primitives", count), children(device, "hierarchy", count - 1),
          ranges(device, "ranges", count - 1), parents(device, "parents", 2 * std::size_t{count} - 1),
          arrivals(device, "arrivals", count - 1), inner_boxes(device, "inner boxes", 2 * std::size_t{count - 1}),
          packed(device, "subtrees", count - 1)
    {
    }

    std::uint32_t count;
    LaunchSize launch;
    Buffer<cl_float4> primitive_boxes, sorted_boxes;
    Buffer<cl_ulong> codes;
    Buffer<cl_uint> sorted_primitives;
    Buffer<cl_uint2> children, ranges;
    Buffer<cl_uint> parents;
    Buffer<cl_uint> arrivals; // or, level by level, the levels
    Buffer<cl_float4> inner_boxes;
    Buffer<cl_uint> packed;
};

DeviceBvh upload(const Device& device, const Bvh& bvh)
{
    return {Buffer<BvhNode>(device, "bvh nodes", bvh.nodes),
            Buffer<uint>(device, "leaf primitives", bvh.leaf_primitives), bvh.statistics};
}

Bvh download(const DeviceBvh& bvh)
{
    return {bvh.nodes.read(), bvh.leaf_primitives.read(), bvh.statistics};
}

LbvhBuilder::LbvhBuilder(const Device& device, const KernelCache& cache)
    : device_(&device), build_(device, "bvh_build.cl", "-DLANES=1", cache),
      sort_(device, "sort.cl", "-DLANES=1", cache), radix_sort_(sort_), scan_(sort_),
      primitive_boxes_(build_, "primitive_boxes"), reduce_bounds_(build_, "reduce_bounds"),
      morton_codes_(build_, "morton_codes"), sort_boxes_(build_, "sort_boxes"),
      build_hierarchy_(build_, "build_hierarchy"), climb_boxes_(build_, "climb_boxes"),
      node_levels_(build_, "node_levels"), refit_level_(build_, "refit_level"), mark_nodes_(build_, "mark_nodes"),
      emit_nodes_(build_, "emit_nodes")
{
}

DeviceBvh LbvhBuilder::build(const Buffer<Primitive>& primitives, std::uint32_t count, LbvhOptions options)
{
    check_primitive_count(count);
    if (count < 2) {
        std::vector<Primitive> few(count);
        primitives.read(few.data(), count);
        return upload(*device_, build_bvh_host(few));
    }

    BvhStatistics statistics;
    Stopwatch watch;
    const auto end_phase = [&](const char* name) {
        device_->finish();
        statistics.phases.emplace_back(name, watch.restart());
    };

    Tree tree(*device_, count);
    const Chunks chunks = make_chunks(*device_, count, options.chunk_count);
    Buffer<cl_float4> bounds(*device_, "bounds", 2 * std::size_t{chunks.count});
    primitive_boxes_.launch(chunks.count, chunks.local_size, primitives, count, chunks.size, tree.primitive_boxes,
                            bounds);
    reduce_to_one(bounds, chunks.count);
    end_phase("boxes");

    const auto [global, local] = tree.launch;
    morton_codes_.launch(global, local, tree.primitive_boxes, count, bounds, tree.codes, tree.sorted_primitives);
    end_phase("codes");

    radix_sort_.sort(tree.codes, tree.sorted_primitives, count, options.chunk_count);
    end_phase("sort");

    sort_boxes_.launch(global, local, tree.primitive_boxes, tree.sorted_primitives, count, tree.sorted_boxes);
    build_hierarchy_.launch(global, local, tree.codes, count, tree.children, tree.ranges, tree.parents, tree.arrivals);
    end_phase("hierarchy");

    if (options.level_by_level)
        refit_by_levels(tree);
    else
        climb(tree);
    end_phase("boxes and leaves");

    DeviceBvh bvh = compact(tree, statistics);
    end_phase("compaction");
    bvh.statistics = std::move(statistics);
    return bvh;
}

// Leave the box around the first `count` boxes in the first.
void LbvhBuilder::reduce_to_one(Buffer<cl_float4>& bounds, std::uint32_t count)
{
    while (count > 1) {
        const Chunks chunks = make_chunks(*device_, count);
        Buffer<cl_float4> reduced(*device_, "bounds", 2 * std::size_t{chunks.count});
        reduce_bounds_.launch(chunks.count, chunks.local_size, bounds, count, chunks.size, reduced);
        std::swap(bounds, reduced);
        count = chunks.count;
    }
}

void LbvhBuilder::climb(Tree& tree)
{
    climb_boxes_.launch(tree.launch.global, tree.launch.local, tree.count, tree.sorted_boxes, tree.children,
                        tree.ranges, tree.parents, tree.arrivals, tree.inner_boxes, tree.packed);
}

void LbvhBuilder::refit_by_levels(Tree& tree)
{
    const auto [global, local] = tree.launch;
    Buffer<cl_uint> deepest(*device_, "deepest level", std::vector<cl_uint>{0});
    node_levels_.launch(global, local, tree.count, tree.parents, tree.arrivals, deepest);
    for (cl_uint level = deepest.read().front() + 1; level-- > 0;)
        refit_level_.launch(global, local, tree.count, level, tree.sorted_boxes, tree.children, tree.ranges,
                            tree.arrivals, tree.inner_boxes, tree.packed);
}

// Write the nodes that stay, in the order of their numbers.
DeviceBvh LbvhBuilder::compact(Tree& tree, BvhStatistics& statistics)
{
    const auto [global, local] = tree.launch;
    Buffer<cl_uint> marks(*device_, "marks", tree.count);
    mark_nodes_.launch(global, local, tree.count, tree.packed, tree.ranges, tree.parents, marks);
    scan_.exclusive(marks, tree.count);
    cl_uint node_count = 0;
    marks.read(&node_count, 1, tree.count - 1);

    DeviceBvh bvh;
    bvh.nodes = Buffer<BvhNode>(*device_, "bvh nodes", node_count);
    emit_nodes_.launch(global, local, tree.count, tree.sorted_boxes, tree.children, tree.ranges, tree.inner_boxes,
                       tree.packed, marks, bvh.nodes);

    // What the root knows of the whole: its box with the cost in lower.w, and the depth in its packed word.
    Box box;
    cl_float4 corners[2];
    cl_uint word = 0;
    tree.inner_boxes.read(corners, 2);
    tree.packed.read(&word, 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lower[axis] = corners[0].s[axis];
        box.upper[axis] = corners[1].s[axis];
    }
    statistics.primitive_count = tree.count;
    statistics.node_count = node_count;
    statistics.leaf_count = node_count + 1;
    statistics.depth = word >> 4;
    statistics.sah_cost = relative_cost(corners[0].s[3], box.half_area());
    statistics.built_on_device = true;
    bvh.leaf_primitives = std::move(tree.sorted_primitives);
    return bvh;
}

void LbvhBuilder::store_in_cache()
{
    build_.store_in_cache();
    sort_.store_in_cache();
}
} // namespace etendue
