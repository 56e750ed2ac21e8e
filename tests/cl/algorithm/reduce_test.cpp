// The box around many boxes, chunk by chunk.
#include "compute/kernel.h"
#include "math/shared.h"
#include "support/device_evaluate.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

namespace etendue
{
TEST_CASE("each chunk's box is the least and greatest of its boxes")
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> u(-1, 1);
    const float infinity = std::numeric_limits<float>::infinity();
    for (const Device& device : test_devices()) {
        const Program program(device, "bvh_build.cl", "-DLANES=1", KernelCache::none());
        Kernel kernel(program, "reduce_bounds");
        for (const cl_uint count : {1u, 2u, 3u, 255u, 256u, 257u, 4096u, 10001u})
            for (const cl_uint chunk_size : {1u, 2u, 100u, 20000u}) {
                const cl_uint chunks = (count + chunk_size - 1) / chunk_size;
                std::vector<cl_float4> boxes(2 * std::size_t{count});
                std::vector<cl_float4> expected(2 * std::size_t{chunks});
                for (cl_uint c = 0; c < chunks; ++c)
                    for (std::size_t k = 0; k < 3; ++k) {
                        expected[2 * c].s[k] = infinity;
                        expected[2 * c + 1].s[k] = -infinity;
                    }
                for (cl_uint i = 0; i < count; ++i)
                    for (std::size_t k = 0; k < 3; ++k) {
                        const bool nothing = i % 5 == 4;
                        const float lower = nothing ? infinity : u(random), upper = nothing ? -infinity : lower + 0.5f;
                        boxes[2 * i].s[k] = lower;
                        boxes[2 * i + 1].s[k] = upper;
                        cl_float& least = expected[2 * (i / chunk_size)].s[k];
                        cl_float& greatest = expected[2 * (i / chunk_size) + 1].s[k];
                        least = std::min(least, lower);
                        greatest = std::max(greatest, upper);
                    }
                Buffer<cl_float4> reduced(device, "reduced", expected.size());
                kernel.launch(chunks, 0, Buffer<cl_float4>(device, "boxes", boxes), count, chunk_size, reduced);
                const std::vector<cl_float4> result = reduced.read();
                CAPTURE(count, chunk_size);
                for (std::size_t i = 0; i < result.size(); ++i)
                    CHECK(std::equal(result[i].s, result[i].s + 3, expected[i].s));
            }
    }
}
} // namespace etendue
