// The two steps of a prefix sum, each on its own.
#include "compute/kernel.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>

namespace etendue
{
TEST_CASE("chunks are summed, and scanned from what came before them")
{
    std::mt19937 random(1);
    for (const Device& device : test_devices()) {
        const Program program(device, "sort.cl", "-DLANES=1", KernelCache::none());
        Kernel sum(program, "scan_sums"), scan(program, "scan_chunks");
        for (const cl_uint count : {1u, 2u, 255u, 256u, 257u, 5000u})
            for (const cl_uint chunk_size : {1u, 3u, 256u, 10000u}) {
                const cl_uint chunks = (count + chunk_size - 1) / chunk_size;
                std::vector<cl_uint> values(count), offsets(chunks), sums, expected;
                for (cl_uint& v : values) v = static_cast<cl_uint>(random());
                for (cl_uint& v : offsets) v = static_cast<cl_uint>(random());
                for (cl_uint c = 0; c < chunks; ++c) {
                    const auto first = values.begin() + c * chunk_size;
                    const auto end = c + 1 == chunks ? values.end() : first + chunk_size;
                    sums.push_back(std::accumulate(first, end, cl_uint{0}));
                    std::exclusive_scan(first, end, std::back_inserter(expected), offsets[c]);
                }
                Buffer<cl_uint> buffer(device, "values", values), sum_buffer(device, "sums", chunks);
                sum.launch(chunks, 0, buffer, count, chunk_size, sum_buffer);
                scan.launch(chunks, 0, buffer, count, chunk_size, Buffer<cl_uint>(device, "offsets", offsets));
                CAPTURE(count, chunk_size);
                CHECK(sum_buffer.read() == sums);
                CHECK(buffer.read() == expected);
            }
    }
}
} // namespace etendue
