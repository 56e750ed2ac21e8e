// A chi-square test (util/chi_square.h) as assertions of Catch2.
#pragma once

#include "util/chi_square.h"

#include <string>
#include <vector>

namespace etendue
{
// Test that each bin has its probability: none outside the square, none where the probability is zero, probabilities
// that add up to 1, a p-value that is one of a family of 500 tests at level 1e-3, and power to see `smallest_bias`.
// Prints the smallest bias that would have been seen.
void check_histogram(const std::string& subject, const Histogram& histogram, const std::vector<double>& probabilities,
                     double smallest_bias = 0.02);
} // namespace etendue
