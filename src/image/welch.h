// Whether two noisy pictures can be of the same light: Welch's test tile by tile, and whether its p-values are uniform
// as they then must be (Jung, Hanika, Dachsbacher: Detecting Bias in Monte Carlo Renderers using Welch's t-test,
// JCGT 9(2), 2020).
#pragma once

#include "math/vector.h"

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace etendue
{
// Of one pixel of one picture.
struct PixelMoments {
    Vec3 mean{0.0};
    Vec3 variance_of_mean{0.0}; // the squared standard error; 0: known exactly
    double degrees = 0.0;       // of freedom, behind the variance: samples - 1 where samples are independent
    double skewness = 0.0;      // of the mean's noise
};

// A difference whose noise is skewed is as significant as t without its skewness says (util/statistics.h). Differences
// of up to 16 roundings of a float count as none. One test per tile and channel: index (row * columns + column) * 3 +
// channel, row by row from the top. Tiles are `tile` pixels wide and high; the last of a row or column takes what is
// left over too, so that none is small.
struct WelchTiles {
    int tile = 0, columns = 0, rows = 0;
    int width = 0, height = 0;           // of the pictures
    std::vector<double> p_values;        // two-sided; NaN where nothing was tested
    std::vector<double> z_values;        // signed: what a normal variable of the same p-value would be, + where a > b
    std::vector<double> differences;     // mean of a - b in the tile
    std::vector<double> standard_errors; // of that difference
    // That the p-values are uniform (Kolmogorov and Smirnov): each channel by itself, for channels are not independent,
    // the least of the three times three. NaN for fewer than 5 tiles with noise.
    double ks_p_value = std::numeric_limits<double>::quiet_NaN();
    // The same against more small p-values than there should be: of pictures that share their noise, which are nearer
    // to each other than chance, only the other one is small.
    double excess_p_value = std::numeric_limits<double>::quiet_NaN();
    double worst_z = 0.0;        // of the largest |z|
    std::size_t worst = 0;       // its index
    std::size_t tests = 0;       // made, of those with noise and those known exactly
    std::size_t exact = 0;       // of these, tiles without any noise: p is 1 where equal, else 0
    std::size_t untested = 0;    // nothing is known of the variance, something is not finite, or the noise too skewed
    std::size_t too_skewed = 0;  // of these, the last
    double test_alpha = 0.0;     // level of one test: the family's after Sidak
    std::size_t below_alpha = 0; // tests whose p-value is below it

    // The difference that a test would have found with 99 % certainty: that of the tile in the middle, all sorted.
    double detectable_difference() const;
    // The p-values where there is noise, which are uniform between pictures of the same light; of one channel or of
    // all.
    std::vector<double> noisy_p_values(std::size_t channel) const;
    std::vector<double> noisy_p_values() const;
};

// Both row by row; throws std::invalid_argument where a size does not fit. `alpha` is the level of all tests together.
WelchTiles welch_test(std::span<const PixelMoments> a, std::span<const PixelMoments> b, int width, int height, int tile,
                      double alpha = 1e-3);

// The same for pictures of which only the values are known: the variance is that of a - b within the tile, with one
// degree of freedom fewer than it has pixels.
WelchTiles paired_test(std::span<const Vec3> a, std::span<const Vec3> b, int width, int height, int tile,
                       double alpha = 1e-3);
} // namespace etendue
