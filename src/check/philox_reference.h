// Philox4x32-10 from its definition: ten rounds of two multiplications, the key raised in between.
#pragma once

#include <array>
#include <cstdint>

namespace etendue
{
using PhiloxBlock = std::array<std::uint32_t, 4>;

inline PhiloxBlock reference_philox(PhiloxBlock c, std::uint32_t k0, std::uint32_t k1)
{
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t first = 0xD2511F53ull * c[0], second = 0xCD9E8D57ull * c[2];
        c = {static_cast<std::uint32_t>(second >> 32) ^ c[1] ^ k0, static_cast<std::uint32_t>(second),
             static_cast<std::uint32_t>(first >> 32) ^ c[3] ^ k1, static_cast<std::uint32_t>(first)};
        k0 += 0x9E3779B9u;
        k1 += 0xBB67AE85u;
    }
    return c;
}
} // namespace etendue
