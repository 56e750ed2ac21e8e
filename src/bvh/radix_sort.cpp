// Stable radix sort on the device: per digit, count in chunks, scan the counts, scatter in order.
#include "bvh/radix_sort.h"

#include "bvh/launch_size.h"
#include "math/shared.h"

#include <utility>

namespace etendue
{
RadixSort::RadixSort(const Program& sort_program)
    : device_(&sort_program.device()), scan_(sort_program), count_(sort_program, "radix_count"),
      scatter_(sort_program, "radix_scatter")
{
}

void RadixSort::sort(Buffer<cl_ulong>& keys, Buffer<cl_uint>& values, std::uint32_t count, std::uint32_t chunk_count)
{
    if (count < 2) return;
    const Chunks chunks = make_chunks(*device_, count, chunk_count);
    Buffer<cl_ulong> other_keys(*device_, "sorted keys", keys.size());
    Buffer<cl_uint> other_values(*device_, "sorted values", values.size());
    Buffer<cl_uint> counts(*device_, "digit counts", std::size_t{RADIX_SIZE} * chunks.count);
    for (uint shift = 0; shift < 64; shift += RADIX_BITS) {
        count_.launch(chunks.count, chunks.local_size, keys, count, chunks.size, shift, counts);
        scan_.exclusive(counts, static_cast<std::uint32_t>(counts.size()));
        scatter_.launch(chunks.count, chunks.local_size, keys, values, count, chunks.size, shift, counts, other_keys,
                        other_values);
        std::swap(keys, other_keys);
        std::swap(values, other_values);
    }
}
} // namespace etendue
