// How an array is divided among work-items.
#pragma once

#include "compute/device.h"

#include <algorithm>

namespace etendue
{
// `count` chunks of `size` consecutive elements, the last perhaps shorter, none empty: one work-item each.
struct Chunks {
    std::uint32_t count = 0;
    std::uint32_t size = 0;
    std::size_t local_size = 0;
};

// At most `wanted` chunks of `elements`; 0: a few for each core of a CPU, thousands for other devices.
inline Chunks make_chunks(const Device& device, std::uint32_t elements, std::uint32_t wanted = 0)
{
    constexpr std::uint32_t CHUNKS_PER_CORE = 4;  // so that a core that is late is waited for a quarter of its part
    constexpr std::uint32_t CHUNKS_PER_UNIT = 64; // two wavefronts of 32 on each compute unit of a GPU
    constexpr std::uint32_t LEAST_SIZE = 64;      // below, starting a work-item costs more than its work
    if (elements == 0) return {};
    if (wanted == 0) {
        wanted = device.compute_units() * (device.is_cpu() ? CHUNKS_PER_CORE : CHUNKS_PER_UNIT);
        wanted = std::min(wanted, 1 + (elements - 1) / LEAST_SIZE);
    }
    const std::uint32_t size = 1 + (elements - 1) / std::max(wanted, 1u);
    // A work-group runs on one core of a CPU, so there each chunk is a group.
    return {1 + (elements - 1) / size, size, device.is_cpu() ? std::size_t{1} : std::size_t{0}};
}

// For one work-item per element: work-groups of one size, so that a driver that compiles for the size does so once.
struct LaunchSize {
    std::size_t global = 0;
    std::size_t local = 0;
};

inline LaunchSize launch_size(const Device& device, std::uint32_t elements)
{
    const std::size_t local = std::min<std::size_t>(64, std::max<std::size_t>(1, device.info().max_work_group_size));
    return {(elements + local - 1) / local * local, local};
}
} // namespace etendue
