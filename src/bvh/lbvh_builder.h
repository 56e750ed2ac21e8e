// The linear BVH, built by kernels (bvh_build.cl and sort.cl, the same two programs for every scene).
#pragma once

#include "bvh/bvh.h"
#include "bvh/radix_sort.h"
#include "compute/buffer.h"
#include "compute/program.h"

namespace etendue
{
// A tree where rays are traced. leaf_primitives is no buffer when there are no primitives.
struct DeviceBvh {
    Buffer<BvhNode> nodes;
    Buffer<uint> leaf_primitives;
    BvhStatistics statistics;
};

DeviceBvh upload(const Device& device, const Bvh& bvh);
Bvh download(const DeviceBvh& bvh);

struct LbvhOptions {
    bool level_by_level = false;   // refit without atomics: slower, the same bits
    std::uint32_t chunk_count = 0; // of sort and reduction; 0: as suits the device; the same bits
};

class LbvhBuilder
{
public:
    // Compiles or loads the programs. Throws BuildError, DeviceError. The device outlives the builder.
    LbvhBuilder(const Device& device, const KernelCache& cache);

    // The tree of build_bvh_host, bit for bit, over the first `count` primitives. Fewer than two need no kernel. Throws
    // SceneError for too many, DeviceError.
    DeviceBvh build(const Buffer<Primitive>& primitives, std::uint32_t count, LbvhOptions options = {});

    const BuildReport& build_report() const { return build_.report(); }
    const BuildReport& sort_report() const { return sort_.report(); }

    // Keep both binaries for the next run; may be slow, so call it when there is time. Never throws.
    void store_in_cache();

private:
    struct Tree;
    void reduce_to_one(Buffer<cl_float4>& bounds, std::uint32_t count);
    void climb(Tree& tree);
    void refit_by_levels(Tree& tree);
    DeviceBvh compact(Tree& tree, BvhStatistics& statistics);

    const Device* device_;
    Program build_, sort_;
    RadixSort radix_sort_;
    Scan scan_;
    Kernel primitive_boxes_, reduce_bounds_, morton_codes_, sort_boxes_, build_hierarchy_, climb_boxes_, node_levels_,
        refit_level_, mark_nodes_, emit_nodes_;
};
} // namespace etendue
