// Integer alias tables: every count is exact.
#include "geometry/distribution.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>

using namespace etendue;

namespace
{
// How many of the n * 2^32 pairs (bucket, 32-bit integer) choose each entry, by the rule of cl/shared/light.h.
std::vector<std::uint64_t> count_choices(const AliasTable& table)
{
    std::vector<std::uint64_t> counts(table.buckets.size(), 0);
    for (std::size_t i = 0; i < table.buckets.size(); ++i) {
        counts[i] += table.buckets[i].threshold;
        counts[table.buckets[i].alias] += (std::uint64_t{1} << 32) - table.buckets[i].threshold;
    }
    return counts;
}

// Check what every table promises; return the counts.
std::vector<std::uint64_t> check_table(const std::vector<double>& weights)
{
    const AliasTable table = make_alias_table(weights);
    REQUIRE(table.probabilities.size() == weights.size());
    REQUIRE(std::has_single_bit(table.buckets.size()));
    REQUIRE(table.buckets.size() >= weights.size());
    REQUIRE(table.buckets.size() < 2 * weights.size());
    for (const AliasBucket& bucket : table.buckets) REQUIRE(bucket.alias < weights.size());

    const auto counts = count_choices(table);
    const double total = std::ldexp(static_cast<double>(table.buckets.size()), 32);
    std::size_t wrong = 0, unreachable = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double weight = i < weights.size() ? weights[i] : 0.0;
        unreachable += (weight > 0.0) != (counts[i] > 0);
        if (i < weights.size()) wrong += table.probabilities[i] != static_cast<double>(counts[i]) / total;
    }
    CHECK(wrong == 0);
    CHECK(unreachable == 0);
    CHECK(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}) == table.buckets.size() << 32);
    CHECK(std::accumulate(table.probabilities.begin(), table.probabilities.end(), 0.0) == Approx(1.0).epsilon(1e-12));
    return counts;
}
} // namespace

TEST_CASE("small alias tables choose each entry as often as its weight says, counted over all integers")
{
    CHECK(check_table({1}) == std::vector<std::uint64_t>{std::uint64_t{1} << 32});
    CHECK(check_table({5, 5}) == std::vector<std::uint64_t>{std::uint64_t{1} << 32, std::uint64_t{1} << 32});
    CHECK(check_table({1, 3}) == std::vector<std::uint64_t>{std::uint64_t{1} << 31, 3 * (std::uint64_t{1} << 31)});
    CHECK(check_table({1, 0, 2, 1}) ==
          std::vector<std::uint64_t>{std::uint64_t{1} << 32, 0, std::uint64_t{2} << 32, std::uint64_t{1} << 32});
    // Three entries in four buckets: a third of 2^34 is no integer, so that one entry gets one more.
    const auto thirds = check_table({1, 1, 1});
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(std::abs(static_cast<double>(thirds[i]) - std::ldexp(1.0, 34) / 3) <= 1.0);
}

TEST_CASE("an entry of weight zero is never chosen and one of positive weight always can be")
{
    check_table({0, 0, 1});
    check_table({0, 1e-300, 0, 1e300, 0});
    check_table({1e-8, 1e8});
    check_table({1e308, 1e308, 1e308, 1e308, 1e308});
    check_table({5e-324, 5e-324, 0});
    CHECK(make_alias_table(std::vector<double>{}).buckets.empty());
    CHECK(make_alias_table(std::vector<double>{0, 0}).buckets.empty());
}

TEST_CASE("a hundred thousand weights over many orders of magnitude keep their shares to one part in 2^31")
{
    std::mt19937 random(2);
    std::uniform_real_distribution<double> exponent(-8.0, 8.0);
    std::vector<double> weights(100000);
    for (double& weight : weights) weight = std::pow(10.0, exponent(random));
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto counts = check_table(weights);
    const double total = std::ldexp(static_cast<double>(counts.size()), 32);
    double worst = 0.0;
    const auto heaviest = std::max_element(weights.begin(), weights.end()) - weights.begin();
    for (std::size_t i = 0; i < weights.size(); ++i)
        if (static_cast<std::ptrdiff_t>(i) != heaviest)
            worst = std::max(worst, std::abs(static_cast<double>(counts[i]) - weights[i] / sum * total));
    CHECK(worst <= 2.0);
    CHECK(std::abs(static_cast<double>(counts[static_cast<std::size_t>(heaviest)]) / total -
                   weights[static_cast<std::size_t>(heaviest)] / sum) <= std::ldexp(1.0, -31));
}
