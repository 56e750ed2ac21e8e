// Stable sort of 64-bit keys with 32-bit values on the device (kernels radix_count and radix_scatter of sort.cl).
#pragma once

#include "bvh/scan.h"

namespace etendue
{
class RadixSort
{
public:
    // `sort_program` is sort.cl; it and its device outlive the RadixSort.
    explicit RadixSort(const Program& sort_program);

    // Sort the first `count` keys and their values by key; equal keys keep their order. chunk_count 0: as suits the
    // device; the result does not depend on it. Does not wait. Throws DeviceError.
    void sort(Buffer<cl_ulong>& keys, Buffer<cl_uint>& values, std::uint32_t count, std::uint32_t chunk_count = 0);

private:
    const Device* device_;
    Scan scan_;
    Kernel count_, scatter_;
};
} // namespace etendue
