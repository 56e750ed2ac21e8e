// Where a tree is built: on the host, on the device, or whichever is ready first.
#pragma once

#include "bvh/lbvh_builder.h"

#include <memory>
#include <string>
#include <vector>

namespace etendue
{
enum class BvhPlace { automatic, host, device };

// automatic: the host below this many primitives. Measured with PoCL on two cores: the host takes 0.2 microseconds a
// primitive, the kernels half of that and 0.02 s to load from the cache, once they have been compiled for 1.7 s.
inline constexpr std::uint32_t AUTOMATIC_DEVICE_THRESHOLD = 1u << 18;

// The place that `automatic` means for so many primitives; the others mean themselves.
BvhPlace choose_bvh_place(BvhPlace wanted, std::uint32_t primitive_count,
                          std::uint32_t threshold = AUTOMATIC_DEVICE_THRESHOLD);

struct BvhBuild {
    DeviceBvh bvh;
    std::string warning;                  // a sentence when the device failed and the host took over, else empty
    std::unique_ptr<LbvhBuilder> builder; // for its reports and store_in_cache(); null when no kernel was asked for
};

// The tree of these primitives, on the device. `device_primitives` holds the same as `primitives`. Where `automatic`
// chose the device and an Error comes of it, the host builds the same tree instead. Throws SceneError for too many
// primitives, DeviceError, and BuildError for BvhPlace::device.
BvhBuild build_bvh(BvhPlace place, const Device& device, const KernelCache& cache,
                   const std::vector<Primitive>& primitives, const Buffer<Primitive>& device_primitives,
                   std::uint32_t threshold = AUTOMATIC_DEVICE_THRESHOLD);
} // namespace etendue
