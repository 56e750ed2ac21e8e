// Exclusive prefix sums on the device (kernels scan_sums and scan_chunks of sort.cl).
#pragma once

#include "compute/kernel.h"

#include <cstdint>

namespace etendue
{
class Scan
{
public:
    // `sort_program` is sort.cl; it and its device outlive the Scan.
    explicit Scan(const Program& sort_program);

    // Replace the first `count` values by the sums of those before them, modulo 2^32. chunk_count 0: as suits the
    // device; the result does not depend on it. Does not wait. Throws DeviceError.
    void exclusive(Buffer<cl_uint>& values, std::uint32_t count, std::uint32_t chunk_count = 0);

private:
    const Device* device_;
    Kernel sums_, chunks_;
    Buffer<cl_uint> zero_; // what comes before the only chunk
};
} // namespace etendue
