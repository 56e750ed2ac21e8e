// The hierarchy of Karras, every node on its own, against a recursion.
#include "compute/kernel.h"
#include "reference_hierarchy.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>
#include <cstring>

namespace etendue
{
namespace
{
template<typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}
} // namespace

TEST_CASE("every inner node finds its range, children and parents")
{
    for (const Device& device : test_devices()) {
        const Program program(device, "bvh_build.cl", "-DLANES=1", KernelCache::none());
        Kernel kernel(program, "build_hierarchy");
        for (const std::vector<cl_ulong>& codes : code_sets()) {
            const ReferenceHierarchy expected(codes);
            const cl_uint count = expected.count();
            const Buffer<cl_ulong> code_buffer(device, "codes", codes);
            Buffer<cl_uint2> children(device, "children", count - 1), ranges(device, "ranges", count - 1);
            Buffer<cl_uint> parents(device, "parents", 2 * std::size_t{count} - 1);
            Buffer<cl_uint> arrivals(device, "arrivals", std::vector<cl_uint>(count - 1, 5));
            kernel.launch(count + 3, 0, code_buffer, count, children, ranges, parents, arrivals);
            CAPTURE(count, codes.front(), codes.back());
            CHECK(same_bits(ranges.read(), expected.ranges));
            CHECK(same_bits(children.read(), expected.children));
            CHECK(same_bits(parents.read(), expected.parents));
            CHECK(arrivals.read() == std::vector<cl_uint>(count - 1, 0));
        }
    }
}
} // namespace etendue
