// Pixels of films and of several pictures.
#include "converge/picture.h"

#include "math/rounding.h"

#include <cmath>
#include <limits>

namespace etendue
{
FilmPixels pixels_of(const Film& film)
{
    FilmPixels pixels;
    const PixelRect& crop = film.crop();
    for (int y = crop.y; y < crop.y + crop.height; ++y)
        for (int x = crop.x; x < crop.x + crop.width; ++x) {
            const PixelEstimate estimate = film.estimate(x, y);
            pixels.mean.push_back(estimate.mean);
            pixels.variance.push_back(estimate.standard_error * estimate.standard_error);
        }
    return pixels;
}

Vec3 mean_of(const Pixels& pixels)
{
    Vec3 sum(0.0);
    for (const Vec3& pixel : pixels) sum += pixel;
    return sum / static_cast<double>(pixels.size());
}

BadValues count_bad_values(const Pixels& pixels)
{
    BadValues bad;
    for (const Vec3& pixel : pixels)
        for (int c = 0; c < 3; ++c) {
            bad.nan += std::isnan(pixel[c]);
            bad.infinite += std::isinf(pixel[c]);
            bad.negative += pixel[c] < 0.0;
        }
    return bad;
}

void PixelPool::add(const Pixels& picture)
{
    pixels_.resize(picture.size());
    cubes_.resize(picture.size(), Vec3(0.0));
    const double n = static_cast<double>(count_) + 1;
    for (std::size_t i = 0; i < picture.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            Moments& moments = pixels_[i][static_cast<std::size_t>(c)];
            // Pebay 2008, eq. 1.6.
            const double d = picture[i][c] - moments.mean;
            cubes_[i][c] += d * d * d * (n - 1) * (n - 2) / (n * n) - 3 * d * moments.m2 / n;
            moments = merge_moments(moments, static_cast<double>(count_), {picture[i][c], 0.0}, 1.0);
        }
    ++count_;
}

Pixels PixelPool::mean() const
{
    Pixels mean;
    for (const auto& pixel : pixels_) mean.emplace_back(pixel[0].mean, pixel[1].mean, pixel[2].mean);
    return mean;
}

Pixels PixelPool::variance_of_mean() const
{
    const double n = static_cast<double>(count_);
    const double scale = count_ < 2 ? std::numeric_limits<double>::infinity() : 1.0 / (n * (n - 1));
    Pixels variance;
    for (const auto& pixel : pixels_)
        variance.push_back(count_ < 2 ? Vec3(scale) : Vec3(pixel[0].m2, pixel[1].m2, pixel[2].m2) * scale);
    return variance;
}

double PixelPool::skewness_of_mean(const Pixels& variance_of_mean) const
{
    if (count_ < 3) return 0.0;
    // The third k-statistic of one picture is n / ((n - 1) (n - 2)) of the sum; the cumulant of the mean is 1 / n^2 of
    // it.
    const double n = static_cast<double>(count_), scale = 1.0 / (n * (n - 1) * (n - 2));
    RunningStatistics skewness;
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double error = std::sqrt(variance_of_mean[i][c]);
            const double mean = pixels_[i][static_cast<std::size_t>(c)].mean;
            if (error > MEAN_ROUNDINGS * FLOAT_ROUNDING * std::abs(mean))
                skewness.add(scale * cubes_[i][c] / (error * error * error));
        }
    return skewness.mean();
}

Image image_of(const Pixels& mean, const Pixels& variance, int width, int height)
{
    Image image;
    image.width = image.full_width = width;
    image.height = image.full_height = height;
    image.channels = {"R", "G", "B"};
    if (!variance.empty()) image.channels.insert(image.channels.end(), {"stderr.R", "stderr.G", "stderr.B"});
    for (std::size_t i = 0; i < mean.size(); ++i) {
        for (int c = 0; c < 3; ++c) image.data.push_back(static_cast<float>(mean[i][c]));
        if (variance.empty()) continue;
        for (int c = 0; c < 3; ++c) image.data.push_back(static_cast<float>(std::sqrt(variance[i][c])));
    }
    return image;
}
} // namespace etendue
