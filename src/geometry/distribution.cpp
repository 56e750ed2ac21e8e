// Vose's method, exact in 64-bit integers.
#include "geometry/distribution.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace etendue
{
namespace
{
// What one bucket holds: the number of 32-bit integers.
constexpr std::uint64_t FULL = std::uint64_t{1} << 32;

// Split bucket_count * 2^32 among the entries in proportion to their weights.
std::vector<std::uint64_t> integer_masses(std::span<const double> weights, std::size_t bucket_count)
{
    // Divide by the largest weight first, so that the sum cannot overflow.
    const double largest = *std::max_element(weights.begin(), weights.end());
    double sum = 0.0;
    for (const double weight : weights) sum += weight / largest;
    const double total = std::ldexp(static_cast<double>(bucket_count), 32);
    std::vector<std::uint64_t> masses;
    masses.reserve(weights.size());
    std::uint64_t given = 0;
    for (const double weight : weights) {
        const auto share = static_cast<std::uint64_t>(weight / largest / sum * total);
        masses.push_back(weight > 0.0 ? std::max<std::uint64_t>(share, 1) : 0);
        given += masses.back();
    }
    // The heaviest entry takes what rounding left over, or gives what was too much.
    const auto heaviest = std::max_element(masses.begin(), masses.end());
    *heaviest += bucket_count * FULL - given;
    return masses;
}
} // namespace

AliasTable make_alias_table(std::span<const double> weights)
{
    AliasTable table;
    if (std::none_of(weights.begin(), weights.end(), [](double weight) { return weight > 0.0; })) return table;
    const std::size_t count = std::bit_ceil(weights.size());
    std::vector<std::uint64_t> masses = integer_masses(weights, count);
    for (const std::uint64_t mass : masses)
        table.probabilities.push_back(std::ldexp(static_cast<double>(mass), -32) / static_cast<double>(count));

    // Every bucket starts with its own entry; those beyond the entries are empty.
    masses.resize(count, 0);
    std::vector<uint> small, large;
    for (std::size_t i = 0; i < count; ++i) {
        table.buckets.push_back({static_cast<uint>(std::min(masses[i], FULL - 1)), static_cast<uint>(i)});
        if (masses[i] < FULL) small.push_back(static_cast<uint>(i));
        if (masses[i] > FULL) large.push_back(static_cast<uint>(i));
    }
    // Fill each bucket that is not full from an entry that has too much. The sum is exact, so both run out together.
    while (!small.empty()) {
        const uint poor = small.back(), rich = large.back();
        small.pop_back();
        table.buckets[poor] = {static_cast<uint>(masses[poor]), rich};
        masses[rich] -= FULL - masses[poor];
        if (masses[rich] > FULL) continue;
        large.pop_back();
        table.buckets[rich].threshold = static_cast<uint>(std::min(masses[rich], FULL - 1));
        if (masses[rich] < FULL) small.push_back(rich);
    }
    return table;
}
} // namespace etendue
