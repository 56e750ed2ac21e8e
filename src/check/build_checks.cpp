// Builders: the sort, and the tree of the kernels against the host's.
#include "check/bvh_checks.h"

#include "bvh/lbvh_builder.h"
#include "bvh/lbvh_host.h"
#include "bvh/radix_sort.h"
#include "check/findings.h"
#include "check/primitive_sets.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>

#include <fmt/format.h>

namespace etendue
{
namespace
{
bool same_bits(const Bvh& a, const Bvh& b)
{
    return a.nodes.size() == b.nodes.size() &&
           std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0 &&
           a.leaf_primitives == b.leaf_primitives && a.statistics.depth == b.statistics.depth &&
           a.statistics.node_count == b.statistics.node_count && a.statistics.leaf_count == b.statistics.leaf_count &&
           a.statistics.sah_cost == b.statistics.sah_cost;
}

// Random keys, few values, sorted, reversed, equal, and such as differ in one digit.
std::vector<cl_ulong> keys_of_kind(int kind, std::uint32_t count, std::mt19937_64& random)
{
    std::vector<cl_ulong> keys(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const cl_ulong kinds[] = {random(),
                                  random() % 5,
                                  cl_ulong{i} << 20,
                                  cl_ulong{count - i} << 20,
                                  0x0123456789abcdef,
                                  random() << 56 | 0xabcdef,
                                  (random() & 255) | cl_ulong{77} << 50};
        keys[i] = kinds[kind];
    }
    return keys;
}
constexpr int KEY_KINDS = 7;
} // namespace

CheckResult check_sort(const CheckContext& context, const std::string& name)
{
    const Device& device = *context.device;
    const Program program(device, "sort.cl", "-DLANES=1", context.cache);
    RadixSort sort(program);
    std::mt19937_64 random(context.seed + 1);
    Violations violations;
    for (const std::uint32_t count : {1u, 2u, 255u, 256u, 257u, 4097u, 65537u, 100000u})
        for (int kind = 0; kind < KEY_KINDS; ++kind) {
            const std::vector<cl_ulong> keys = keys_of_kind(kind, count, random);
            std::vector<cl_uint> values(count);
            std::iota(values.begin(), values.end(), 0u);
            std::vector<cl_uint> expected = values;
            std::ranges::stable_sort(expected, {}, [&](cl_uint value) { return keys[value]; });

            Buffer<cl_ulong> key_buffer(device, "keys", keys);
            Buffer<cl_uint> value_buffer(device, "values", values);
            sort.sort(key_buffer, value_buffer, count);
            violations.set_subject(fmt::format("{} keys of kind {}", count, kind));
            violations.expect(value_buffer.read() == expected, "order of values");
            violations.expect(std::ranges::is_sorted(key_buffer.read()), "order of keys");
        }
    return violations.result(name, Rule::exact);
}

CheckResult check_device_tree(const CheckContext& context, const std::string& name)
{
    const Device& device = *context.device;
    LbvhBuilder builder(device, context.cache);
    Violations violations;
    for (const PrimitiveSet& set : primitive_sets()) {
        const Bvh expected = build_bvh_host(set.primitives);
        const Buffer<Primitive> primitives(device, "primitives", set.primitives);
        const auto count = static_cast<std::uint32_t>(set.primitives.size());
        violations.set_subject(set.name);
        for (const LbvhOptions& options : {LbvhOptions{}, LbvhOptions{true, 0}, LbvhOptions{false, 1}})
            violations.expect(same_bits(download(builder.build(primitives, count, options)), expected),
                              "trees that are not the host's");
    }
    return violations.result(name, Rule::exact);
}
} // namespace etendue
