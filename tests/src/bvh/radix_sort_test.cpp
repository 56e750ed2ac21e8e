// The radix sort on the device against std::stable_sort.
#include "bvh/radix_sort.h"

#include "support/device_evaluate.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <numeric>
#include <random>

namespace etendue
{
namespace
{
struct KeyKind {
    const char* name;
    std::function<cl_ulong(std::mt19937_64&, std::uint32_t i, std::uint32_t count)> make;
};

const std::vector<KeyKind> KEY_KINDS{
    {"random", [](auto& random, auto, auto) { return random(); }},
    {"few values", [](auto& random, auto, auto) { return random() % 5; }},
    {"sorted", [](auto&, auto i, auto) { return cl_ulong{i} << 20; }},
    {"reversed", [](auto&, auto i, auto count) { return cl_ulong{count - i} << 20; }},
    {"all equal", [](auto&, auto, auto) { return cl_ulong{0x0123456789abcdef}; }},
    {"only the highest digit differs", [](auto& random, auto, auto) { return random() << 56 | 0xabcdef; }},
    {"only the lowest digit differs", [](auto& random, auto, auto) { return (random() & 255) | cl_ulong{77} << 50; }},
};
} // namespace

TEST_CASE("the radix sort is std::stable_sort at every size, however it is divided")
{
    std::mt19937_64 random(1);
    for (const Device& device : test_devices()) {
        const Program program(device, "sort.cl", "-DLANES=1", KernelCache::none());
        RadixSort sort(program);
        for (const std::uint32_t count :
             {0u, 1u, 2u, 3u, 255u, 256u, 257u, 4095u, 4096u, 4097u, 65535u, 65536u, 65537u, 100000u})
            for (const KeyKind& kind : KEY_KINDS) {
                std::vector<cl_ulong> keys(count);
                for (std::uint32_t i = 0; i < count; ++i) keys[i] = kind.make(random, i, count);
                std::vector<cl_uint> values(count);
                std::iota(values.begin(), values.end(), 1000000u);
                std::vector<cl_uint> expected = values;
                std::ranges::stable_sort(expected, {}, [&](cl_uint value) { return keys[value - 1000000u]; });

                const std::vector<std::uint32_t> divisions =
                    count < 5000 ? std::vector<std::uint32_t>{0, 1, 7, 300} : std::vector<std::uint32_t>{0};
                for (const std::uint32_t chunks : divisions) {
                    Buffer<cl_ulong> key_buffer(device, "keys", keys);
                    Buffer<cl_uint> value_buffer(device, "values", values);
                    sort.sort(key_buffer, value_buffer, count, chunks);
                    CAPTURE(kind.name, count, chunks);
                    CHECK(value_buffer.read() == expected);
                    CHECK(std::ranges::is_sorted(key_buffer.read()));
                }
            }
    }
}
} // namespace etendue
