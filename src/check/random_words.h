// Words that stand for the random numbers of a device function.
#pragma once

#include "math/shared.h"

#include <array>
#include <cstddef>
#include <random>
#include <vector>

namespace etendue
{
using RandomWords = std::array<uint, 4>;

inline std::vector<RandomWords> random_words(std::size_t count, std::uint64_t seed)
{
    std::mt19937_64 random(seed);
    std::vector<RandomWords> words(count);
    for (RandomWords& w : words)
        for (uint& x : w) x = static_cast<uint>(random() >> 32);
    return words;
}
} // namespace etendue
