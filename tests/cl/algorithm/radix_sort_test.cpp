// One pass of the radix sort: count, then scatter.
#include "compute/kernel.h"
#include "math/shared.h"
#include "support/device_evaluate.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>

namespace etendue
{
TEST_CASE("a pass counts the digits of each chunk and moves keys stably to the places of their digits")
{
    std::mt19937_64 random(1);
    for (const Device& device : test_devices()) {
        const Program program(device, "sort.cl", "-DLANES=1", KernelCache::none());
        Kernel count_kernel(program, "radix_count"), scatter(program, "radix_scatter");
        for (const cl_uint count : {1u, 2u, 255u, 256u, 257u, 5000u})
            for (const cl_uint chunk_size : {1u, 100u, 10000u})
                for (const cl_uint shift : {0u, 8u, 56u}) {
                    const cl_uint chunks = (count + chunk_size - 1) / chunk_size;
                    std::vector<cl_ulong> keys(count);
                    for (cl_ulong& key : keys) key = random();
                    const auto digit = [&](cl_uint i) { return static_cast<cl_uint>(keys[i] >> shift) % RADIX_SIZE; };
                    std::vector<cl_uint> counts(std::size_t{RADIX_SIZE} * chunks), values(count);
                    std::iota(values.begin(), values.end(), 0u);
                    for (cl_uint i = 0; i < count; ++i) ++counts[digit(i) * chunks + i / chunk_size];
                    std::vector<cl_uint> expected = values, offsets(counts.size());
                    std::ranges::stable_sort(expected, {}, digit);
                    std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0u);

                    const Buffer<cl_ulong> key_buffer(device, "keys", keys);
                    Buffer<cl_uint> count_buffer(device, "counts", counts.size()),
                        sorted_values(device, "sorted", count);
                    Buffer<cl_ulong> sorted_keys(device, "sorted", count);
                    count_kernel.launch(chunks, 0, key_buffer, count, chunk_size, shift, count_buffer);
                    scatter.launch(chunks, 0, key_buffer, Buffer<cl_uint>(device, "values", values), count, chunk_size,
                                   shift, Buffer<cl_uint>(device, "offsets", offsets), sorted_keys, sorted_values);
                    const std::vector<cl_ulong> keys_after = sorted_keys.read();
                    CAPTURE(count, chunk_size, shift);
                    CHECK(count_buffer.read() == counts);
                    CHECK(sorted_values.read() == expected);
                    CHECK(std::ranges::equal(keys_after, expected, {}, {}, [&](cl_uint i) { return keys[i]; }));
                }
    }
}
} // namespace etendue
