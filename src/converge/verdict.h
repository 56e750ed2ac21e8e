// Whether a configuration converges to the reference: a floor under its errors, tiles, the mean.
#pragma once

#include "converge/interval.h"
#include "converge/picture.h"
#include "converge/reference.h"
#include "image/welch.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace etendue
{
enum class BiasResult {
    unbiased,     // all three parts see nothing, and could have
    biased,       // a part sees a bias
    underpowered, // no part sees one, but a bias as large as delta could have hidden
    unknown,      // there is no reference
    failed        // samples were not finite or negative, or errors fall at a rate that independent samples cannot have
};
const char* bias_result_name(BiasResult result); // "UNBIASED"

struct BiasVerdict {
    BiasResult result = BiasResult::unknown;
    std::vector<std::string> reasons; // sentences
    // Errors are those of rounding, so that nothing else could be seen.
    bool exact = false;
    // 1. MSE = a / N + b: b at the level of the verdict, which must not be above 0.
    Interval floor;
    bool floor_passed = false;
    // 2. The pooled picture against the reference by Welch's test per tile: none that is too small by itself, and no
    // more small p-values than uniform ones have. Not uniform at all is no bias by itself: a variance that is known too
    // badly does that too.
    double tile_p_value = std::numeric_limits<double>::quiet_NaN();    // against too many small ones
    double uniform_p_value = std::numeric_limits<double>::quiet_NaN(); // against any other distribution
    double worst_tile_z = std::numeric_limits<double>::quiet_NaN();
    int tile = 0; // pixels of its edge
    bool tiles_passed = false;
    // 3. The signed error of the picture's mean, the worst channel.
    double mean_error = std::numeric_limits<double>::quiet_NaN(); // relative
    double z = std::numeric_limits<double>::quiet_NaN();
    double critical = std::numeric_limits<double>::quiet_NaN();
    double detectable_bias = std::numeric_limits<double>::quiet_NaN(); // relative, with 99 % certainty
    bool mean_passed = false;
};

// What the verdict looks at.
struct BiasEvidence {
    const Reference* reference = nullptr;
    int width = 0, height = 0;
    const PixelPool* pool = nullptr;     // the last pictures of all seeds
    std::vector<Vec3> picture_means;     // of the same pictures
    std::vector<Vec3> picture_variances; // of these means, as the films estimate them
    double largest_mse = 0.0;            // of any checkpoint, as measured
    double last_mse = 0.0;               // at the last usable checkpoint
    Interval floor;                      // b at the verdict's level
    Interval slope;                      // on samples, at the verdict's level
    bool independent_samples = true;     // whose errors must fall with slope -1
    std::uint64_t accidents = 0, bad_values = 0;
    std::string replay; // the command that replays the first accident
};

struct VerdictLevels {
    double test_alpha = 1e-4; // of each of the tests
    double delta = 0.005;
};

// Tests of one configuration: the floor, the slope, the tiles, the mean of each channel.
constexpr std::size_t TESTS_OF_VERDICT = 6;
// The floor, as an MSE, over the last error that the floor's test must be able to see.
constexpr double FLOOR_POWER = 4.0;
// Of other samples than independent ones only the spread between seeds tells the error: so many tell it well.
constexpr std::size_t ENOUGH_SEEDS = 16;
// Slopes of independent samples: -1 within this, beyond their interval.
constexpr double EXPECTED_SLOPE = -1.0, SLOPE_TOLERANCE = 0.05;

BiasVerdict judge_bias(const BiasEvidence& evidence, const VerdictLevels& levels);

// Edge of the tiles of a picture: at least 8 along its shorter edge where that has the pixels, none above 8 pixels.
int tile_edge(int width, int height);

// Welch's test of the pool against the reference, tile by tile; `alpha` is the level of all tiles together. Tiles are
// larger than tile_edge() where the noise of more than a tenth of them is too skewed to be tested, as long as there are
// five of them.
WelchTiles compare_tiles(const PixelPool& pool, const Reference& reference, int width, int height, double alpha = 1e-3);
} // namespace etendue
