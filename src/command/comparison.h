// What two pictures have to do with each other: the numbers, the tests and the verdict of `etendue compare`.
#pragma once

#include "image/image.h"
#include "image/metrics.h"
#include "image/welch.h"

#include <map>
#include <string>
#include <vector>

namespace etendue
{
// Where the variance of a tile comes from.
enum class VarianceSource {
    automatic,      // the standard errors where both pictures have them, else the differences
    differences,    // between the pixels of a tile
    standard_errors // channels stderr.R, stderr.G, stderr.B and samples.Y
};

struct ComparisonSettings {
    VarianceSource variance = VarianceSource::automatic;
    int tile = 8;
    double alpha = 1e-3; // that equal pictures are said to differ, all tests together
};

struct Comparison {
    Metrics metrics;
    VarianceSource variance = VarianceSource::automatic; // what it was
    std::string variance_reason;                         // a sentence
    WelchTiles tiles;
    WelchTiles whole;        // the whole picture as one tile
    double test_alpha = 0.0; // of each of the three: some tile, too many small p-values, the whole
    bool identical = false;  // every value of R, G and B

    std::vector<std::string> failures; // sentences; none: the pictures do not differ beyond the level
    std::vector<std::string> remarks;  // what to know, without failing

    bool passed() const { return failures.empty(); }
    // The smallest differences that would have been found with 99 % certainty, relative to the reference's mean: of the
    // whole picture, and within one tile in the middle of all.
    double detectable_bias() const { return whole.detectable_difference() / metrics.reference_mean; }
    double detectable_in_tile() const { return tiles.detectable_difference() / metrics.reference_mean; }
};

// Pixels of R, G and B in double.
std::vector<Vec3> rgb_values(const Image& image);

// Degrees of freedom behind a pixel's standard error: samples - 1, unless the picture's metadata say that it comes from
// halves (1) or from so many blocks (their number - 1; 1 where that is not known).
double degrees_of_freedom(double samples, const std::map<std::string, std::string>& metadata);

// Where the worst tile is: "R at 8,16" of the picture's pixels.
std::string place_of_worst(const WelchTiles& tiles);

// `a` against the reference `b`. Throws UsageError where sizes or places differ, where standard errors are asked for
// that are not there, and where nothing can be tested.
Comparison compare_images(const Image& a, const Image& b, const ComparisonSettings& settings);
} // namespace etendue
