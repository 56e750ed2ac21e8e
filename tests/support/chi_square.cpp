// Assertions about a histogram.
#include "support/chi_square.h"

#include "util/statistics.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <iostream>

namespace etendue
{
namespace
{
constexpr double FAMILY_LEVEL = 1e-3;
constexpr std::size_t FAMILY_TESTS = 500;
} // namespace

void check_histogram(const std::string& subject, const Histogram& histogram, const std::vector<double>& probabilities,
                     double smallest_bias)
{
    const double samples = histogram.total(), level = sidak_alpha(FAMILY_LEVEL, FAMILY_TESTS);
    std::vector<double> expected;
    double sum = 0.0, where_none = histogram.outside();
    for (std::size_t i = 0; i < probabilities.size(); ++i) {
        expected.push_back(probabilities[i] * samples);
        sum += probabilities[i];
        if (probabilities[i] == 0.0) where_none += histogram.counts()[i];
    }
    const ChiSquare test = chi_square(histogram.counts(), expected, level);
    CAPTURE(subject, samples, test.degrees, test.p_value, test.smallest_bias);
    CHECK(where_none == 0.0);
    CHECK(sum == Approx(1.0).epsilon(1e-4));
    CHECK(test.p_value > level);
    const bool has_power = test.degrees > 0.0 && test.smallest_bias <= smallest_bias;
    CHECK(has_power);
    std::cout << fmt::format("{}: chi-square with {} degrees of freedom; a bias of {:.2g} % would have been seen.\n",
                             subject, test.degrees, 100.0 * test.smallest_bias);
}
} // namespace etendue
