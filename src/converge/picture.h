// What a study takes from a film: pixels in double with their variance.
#pragma once

#include "image/image.h"
#include "math/vector.h"
#include "render/film.h"
#include "util/statistics.h"

#include <array>
#include <cstdint>
#include <vector>

namespace etendue
{
// Row by row from the top.
using Pixels = std::vector<Vec3>;

struct FilmPixels {
    Pixels mean;
    Pixels variance; // of the mean, as the film estimates it; infinite where it cannot
};
FilmPixels pixels_of(const Film& film);

// Mean over the pixels, by channel.
Vec3 mean_of(const Pixels& pixels);

// How many values of a picture no radiance can be.
struct BadValues {
    std::uint64_t nan = 0, infinite = 0, negative = 0;
};
BadValues count_bad_values(const Pixels& pixels);

// Pictures of independent replicates together: their mean and what they say of its variance.
class PixelPool
{
public:
    void add(const Pixels& picture);

    std::size_t count() const { return count_; }
    Pixels mean() const;
    // Of the mean, from the spread between the pictures; infinite for fewer than two.
    Pixels variance_of_mean() const;
    // The skewness of the noise of a pixel's mean, on average over the pixels and channels that have more noise than
    // rounding: the third cumulant over the 3/2 power of the variance. One number for the picture, since that of a
    // pixel is hardly known. By the spread of eight pictures it is about half of what it should be. 0 for fewer than
    // three pictures, and without noise.
    double skewness_of_mean() const { return skewness_of_mean(variance_of_mean()); }
    // The same where the variances of the means are known better than from the spread.
    double skewness_of_mean(const Pixels& variance_of_mean) const;

private:
    std::size_t count_ = 0;
    std::vector<std::array<Moments, 3>> pixels_;
    Pixels cubes_; // sums of cubed deviations from the means
};

// Channels R, G, B and, where there are variances, stderr.R/G/B.
Image image_of(const Pixels& mean, const Pixels& variance, int width, int height);
} // namespace etendue
