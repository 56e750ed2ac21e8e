// Pearson's chi-square test of samples against a density, with the smallest bias that it would have seen.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace etendue
{
// Counts of points of the unit square by bin, row by row; columns by x.
class Histogram
{
public:
    Histogram(std::size_t columns, std::size_t rows) : columns_(columns), rows_(rows), counts_(columns * rows) {}

    // Points outside the square are counted apart.
    void add(double x, double y);

    std::size_t columns() const { return columns_; }
    std::size_t rows() const { return rows_; }
    const std::vector<double>& counts() const { return counts_; }
    double outside() const { return outside_; }
    double total() const;

private:
    std::size_t columns_, rows_;
    std::vector<double> counts_;
    double outside_ = 0.0;
};

struct ChiSquare {
    double p_value = 0.0;
    double degrees = 0.0;
    // Root mean square relative error of the bins' probabilities that the test misses once in a hundred runs.
    double smallest_bias = 0.0;
};

// Bins of which fewer than five are expected are pooled, in order. The test fails at p-values below `level`; its power
// depends on that.
ChiSquare chi_square(const std::vector<double>& counts, const std::vector<double>& expected, double level);
} // namespace etendue
