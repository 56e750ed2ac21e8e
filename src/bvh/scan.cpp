// Exclusive prefix sums on the device: sum chunks, scan the sums (by the same means), scan each chunk from its sum.
#include "bvh/scan.h"

#include "bvh/launch_size.h"

namespace etendue
{
Scan::Scan(const Program& sort_program)
    : device_(&sort_program.device()), sums_(sort_program, "scan_sums"), chunks_(sort_program, "scan_chunks"),
      zero_(*device_, "zero", std::vector<cl_uint>{0})
{
}

void Scan::exclusive(Buffer<cl_uint>& values, std::uint32_t count, std::uint32_t chunk_count)
{
    if (count == 0) return;
    const Chunks chunks = make_chunks(*device_, count, chunk_count);
    if (chunks.count == 1) {
        chunks_.launch(1, chunks.local_size, values, count, chunks.size, zero_);
        return;
    }
    Buffer<cl_uint> sums(*device_, "prefix sums", chunks.count);
    sums_.launch(chunks.count, chunks.local_size, values, count, chunks.size, sums);
    exclusive(sums, chunks.count);
    chunks_.launch(chunks.count, chunks.local_size, values, count, chunks.size, sums);
}
} // namespace etendue
