#include "util/chi_square.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace etendue;

namespace
{
// Shares of tests at this level that found bins uneven by `bias`, half of them fuller and half emptier.
double found_share(double bias, double level, std::size_t bins, double samples, int runs)
{
    std::mt19937_64 random(11);
    int found = 0;
    for (int run = 0; run < runs; ++run) {
        std::vector<double> counts(bins), expected(bins, samples / static_cast<double>(bins));
        for (std::size_t i = 0; i < bins; ++i) {
            std::poisson_distribution<int> poisson(expected[i] * (1.0 + (i % 2 ? bias : -bias)));
            counts[i] = poisson(random);
        }
        found += chi_square(counts, expected, level).p_value < level;
    }
    return static_cast<double>(found) / runs;
}
} // namespace

TEST_CASE("p-values are those of the chi-square distribution", "[util]")
{
    // (10 - 20)^2/20 + 0 + (30 - 20)^2/20 = 10, and with two degrees of freedom p = e^(-10/2).
    const ChiSquare test = chi_square({10, 20, 30}, {20, 20, 20}, 0.01);
    CHECK(test.degrees == 2.0);
    CHECK(test.p_value == Approx(std::exp(-5.0)).epsilon(1e-9));
    CHECK(chi_square({20, 20, 20}, {20, 20, 20}, 0.01).p_value == Approx(1.0));
}

TEST_CASE("bins of which few samples are expected are pooled", "[util]")
{
    // 2 + 2 + 2 make one bin of 6; the last 4 join the bin before.
    const ChiSquare pooled = chi_square({0, 1, 5, 10, 10, 8}, {2, 2, 2, 10, 10, 4}, 0.01);
    const ChiSquare by_hand = chi_square({6, 10, 18}, {6, 10, 14}, 0.01);
    CHECK(pooled.degrees == 2.0);
    CHECK(pooled.p_value == by_hand.p_value);
    CHECK(chi_square({1, 1}, {1, 1}, 0.01).degrees == 0.0);
}

TEST_CASE("the smallest bias named is found in 99 of 100 runs, none as often as the level says", "[util]")
{
    const double level = 1e-3, samples = 20000;
    const std::vector<double> even(64, samples / 64);
    const double bias = chi_square(even, even, level).smallest_bias;
    CAPTURE(bias);
    CHECK(found_share(bias, level, 64, samples, 2000) > 0.98);
    CHECK(found_share(0.5 * bias, level, 64, samples, 2000) < 0.9);
    CHECK(found_share(0.0, level, 64, samples, 4000) < 4e-3);
}

TEST_CASE("points of the square fall into bins row by row, others are counted apart", "[util]")
{
    Histogram histogram(2, 3);
    histogram.add(0.75, 0.1);
    histogram.add(1.0, 1.0);
    histogram.add(0.0, 0.5);
    histogram.add(-0.1, 0.5);
    histogram.add(std::nan(""), 0.5);
    CHECK(histogram.counts() == std::vector<double>{0, 1, 1, 0, 0, 1});
    CHECK(histogram.outside() == 2.0);
    CHECK(histogram.total() == 5.0);
}
