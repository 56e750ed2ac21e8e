/* Prefix sums and the radix sort. Work-item c of every kernel owns elements [c chunk_size, (c + 1) chunk_size). */
#include "algorithm/radix_sort.h"
#include "algorithm/scan.h"

/* The sum of each chunk. */
kernel void scan_sums(global const uint* values, uint count, uint chunk_size, global uint* sums)
{
    const uint chunk = (uint)get_global_id(0);
    const uint first = chunk * chunk_size;
    sums[chunk] = scan_sum(values, first, min(first + chunk_size, count));
}

/* The exclusive prefix sum in place; offsets[c] is the sum of the chunks before chunk c. */
kernel void scan_chunks(global uint* values, uint count, uint chunk_size, global const uint* offsets)
{
    const uint chunk = (uint)get_global_id(0);
    const uint first = chunk * chunk_size;
    scan_exclusive(values, first, min(first + chunk_size, count), offsets[chunk]);
}

/* Digits per chunk: counts[digit * chunk_count + chunk]. */
kernel void radix_count(global const ulong* keys, uint count, uint chunk_size, uint shift, global uint* counts)
{
    const uint chunk = (uint)get_global_id(0);
    const uint first = chunk * chunk_size;
    radix_count_chunk(keys, first, min(first + chunk_size, count), shift, counts, chunk, (uint)get_global_size(0));
}

/* Keys and values in the order of the digit; offsets are the scanned counts. */
kernel void radix_scatter(global const ulong* keys, global const uint* values, uint count, uint chunk_size, uint shift,
                          global const uint* offsets, global ulong* sorted_keys, global uint* sorted_values)
{
    const uint chunk = (uint)get_global_id(0);
    const uint first = chunk * chunk_size;
    radix_scatter_chunk(keys, values, first, min(first + chunk_size, count), shift, offsets, chunk,
                        (uint)get_global_size(0), sorted_keys, sorted_values);
}
