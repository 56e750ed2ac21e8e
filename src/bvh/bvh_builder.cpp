// Where a tree is built.
#include "bvh/bvh_builder.h"

#include "bvh/bvh_check.h"
#include "bvh/lbvh_host.h"
#include "util/error.h"

#include <cassert>

namespace etendue
{
namespace
{
BvhBuild build_on_device(const Device& device, const KernelCache& cache, const Buffer<Primitive>& primitives,
                         std::uint32_t count)
{
    BvhBuild result;
    result.builder = std::make_unique<LbvhBuilder>(device, cache);
    result.bvh = result.builder->build(primitives, count);
    return result;
}
} // namespace

BvhPlace choose_bvh_place(BvhPlace wanted, std::uint32_t primitive_count, std::uint32_t threshold)
{
    if (wanted != BvhPlace::automatic) return wanted;
    return primitive_count < threshold ? BvhPlace::host : BvhPlace::device;
}

BvhBuild build_bvh(BvhPlace place, const Device& device, const KernelCache& cache,
                   const std::vector<Primitive>& primitives, const Buffer<Primitive>& device_primitives,
                   std::uint32_t threshold)
{
    check_primitive_count(primitives.size());
    const std::uint32_t count = static_cast<std::uint32_t>(primitives.size());
    std::string warning;
    if (choose_bvh_place(place, count, threshold) == BvhPlace::device) {
        try {
            BvhBuild result = build_on_device(device, cache, device_primitives, count);
            assert(check_bvh(download(result.bvh), primitives).empty());
            return result;
        } catch (const Error& error) {
            if (place == BvhPlace::device) throw;
            warning = std::string("The tree is built on the host, because the device failed: ") + error.what();
        }
    }
    const Bvh bvh = build_bvh_host(primitives);
    assert(check_bvh(bvh, primitives).empty());
    return {upload(device, bvh), warning, nullptr};
}
} // namespace etendue
