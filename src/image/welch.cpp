// Sums over tiles, and Student's distribution with Welch and Satterthwaite's degrees of freedom.
#include "image/welch.h"

#include "math/rounding.h"
#include "util/statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace etendue
{
namespace
{
constexpr double UNKNOWN = std::numeric_limits<double>::quiet_NaN();
constexpr double POWER_QUANTILE = 2.3263478740408408; // normal, 99 %

// Mean difference of one channel in one tile, what is known of its error, and how large the values are.
struct TileDifference {
    double mean = 0.0, variance = 0.0, degrees = 0.0;
    double size = 0.0;     // mean |b|
    double skewness = 0.0; // of the mean's noise
};

using DifferenceOf = std::function<TileDifference(const std::vector<std::size_t>& pixels, int channel)>;

// Pixels of a tile; the last of a row or column reaches the edge.
std::vector<std::size_t> pixels_of(const WelchTiles& tiles, int column, int row, int width, int height)
{
    const int left = column * tiles.tile, top = row * tiles.tile;
    const int right = column + 1 == tiles.columns ? width : left + tiles.tile;
    const int bottom = row + 1 == tiles.rows ? height : top + tiles.tile;
    std::vector<std::size_t> pixels;
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
            pixels.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x));
    return pixels;
}

void add_test(WelchTiles& tiles, const TileDifference& difference)
{
    double p = UNKNOWN, z = UNKNOWN;
    // What rounding explains is no difference.
    const double excess = std::max(0.0, std::abs(difference.mean) - MEAN_ROUNDINGS * FLOAT_ROUNDING * difference.size);
    if (std::isfinite(difference.mean) && difference.variance == 0.0) {
        // Without noise, equal or not is a fact.
        p = excess == 0.0 ? 1.0 : 0.0;
        z = excess == 0.0 ? 0.0 : std::copysign(std::numeric_limits<double>::infinity(), difference.mean);
        ++tiles.exact;
    } else if (std::abs(difference.skewness) > LARGEST_SKEWNESS) {
        ++tiles.untested;
        ++tiles.too_skewed;
    } else if (std::isfinite(difference.mean) && std::isfinite(difference.variance) && difference.degrees > 0.0) {
        const double t = without_skewness(std::copysign(excess / std::sqrt(difference.variance), difference.mean),
                                          difference.skewness);
        const double tail = student_t_cdf(-std::abs(t), difference.degrees);
        p = std::min(1.0, 2.0 * tail);
        // Where the tail is too small for a number, t itself is as good.
        z = std::copysign(tail > 0.0 ? std::max(0.0, -normal_quantile(std::min(tail, 0.5))) : std::abs(t), t);
    } else {
        ++tiles.untested;
    }
    tiles.p_values.push_back(p);
    tiles.z_values.push_back(z);
    tiles.differences.push_back(difference.mean);
    tiles.standard_errors.push_back(std::sqrt(difference.variance));
}

// What all tests say together.
void summarise(WelchTiles& tiles, double alpha)
{
    tiles.tests = tiles.p_values.size() - tiles.untested;
    tiles.test_alpha = sidak_alpha(alpha, std::max<std::size_t>(tiles.tests, 1));
    for (std::size_t i = 0; i < tiles.p_values.size(); ++i) {
        if (tiles.p_values[i] < tiles.test_alpha) ++tiles.below_alpha;
        if (std::abs(tiles.z_values[i]) > std::abs(tiles.worst_z)) {
            tiles.worst_z = tiles.z_values[i];
            tiles.worst = i;
        }
    }
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::vector<double> values = tiles.noisy_p_values(channel);
        if (values.size() < 5) continue;
        tiles.ks_p_value = std::fmin(tiles.ks_p_value, std::min(1.0, 3.0 * ks_uniform_p_value(values)));
        tiles.excess_p_value = std::fmin(tiles.excess_p_value, std::min(1.0, 3.0 * ks_small_p_value(values)));
    }
}

WelchTiles test_tiles(int width, int height, int tile, double alpha, const DifferenceOf& difference_of)
{
    WelchTiles tiles;
    tiles.tile = tile;
    tiles.width = width;
    tiles.height = height;
    tiles.columns = std::max(1, width / tile);
    tiles.rows = std::max(1, height / tile);
    for (int row = 0; row < tiles.rows; ++row) {
        for (int column = 0; column < tiles.columns; ++column) {
            const std::vector<std::size_t> pixels = pixels_of(tiles, column, row, width, height);
            for (int channel = 0; channel < 3; ++channel) add_test(tiles, difference_of(pixels, channel));
        }
    }
    summarise(tiles, alpha);
    return tiles;
}

double third_cumulant(const PixelMoments& pixel, int channel)
{
    return pixel.skewness == 0.0 ? 0.0 : pixel.skewness * std::pow(pixel.variance_of_mean[channel], 1.5);
}

void check_sizes(std::size_t a, std::size_t b, int width, int height, int tile)
{
    if (width <= 0 || height <= 0 || tile <= 0 || a != b ||
        a != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
        throw std::invalid_argument("pictures of another size than they should have are compared");
}
} // namespace

std::vector<double> WelchTiles::noisy_p_values(std::size_t channel) const
{
    std::vector<double> values;
    for (std::size_t i = channel; i < p_values.size(); i += 3)
        if (std::isfinite(p_values[i]) && standard_errors[i] > 0.0) values.push_back(p_values[i]);
    return values;
}

std::vector<double> WelchTiles::noisy_p_values() const
{
    std::vector<double> values;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::vector<double> more = noisy_p_values(channel);
        values.insert(values.end(), more.begin(), more.end());
    }
    return values;
}

double WelchTiles::detectable_difference() const
{
    std::vector<double> errors;
    for (std::size_t i = 0; i < p_values.size(); ++i)
        if (std::isfinite(p_values[i])) errors.push_back(standard_errors[i]);
    if (errors.empty()) return UNKNOWN;
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    return (POWER_QUANTILE - normal_quantile(test_alpha / 2)) * *middle;
}

WelchTiles welch_test(std::span<const PixelMoments> a, std::span<const PixelMoments> b, int width, int height, int tile,
                      double alpha)
{
    check_sizes(a.size(), b.size(), width, height, tile);
    return test_tiles(width, height, tile, alpha, [&](const std::vector<std::size_t>& pixels, int channel) {
        const double n = static_cast<double>(pixels.size());
        TileDifference sum;
        double largest = 0.0, cubes = 0.0;
        for (const std::size_t i : pixels) {
            sum.mean += a[i].mean[channel] - b[i].mean[channel];
            sum.size += std::abs(b[i].mean[channel]);
            sum.variance += a[i].variance_of_mean[channel] + b[i].variance_of_mean[channel];
            largest = std::max({largest, a[i].variance_of_mean[channel], b[i].variance_of_mean[channel]});
            // Third cumulants add up, too.
            cubes += third_cumulant(a[i], channel) - third_cumulant(b[i], channel);
        }
        // Degrees of a sum of variances: (sum v)^2 / sum (v^2 / degrees) (Welch 1947, Satterthwaite 1946); of ratios to
        // the largest, whose squares neither overflow nor vanish.
        double spread = 0.0;
        const auto add_spread = [&](const PixelMoments& pixel) {
            const double ratio = pixel.variance_of_mean[channel] / largest;
            if (ratio > 0.0) spread += ratio * ratio / pixel.degrees;
        };
        for (const std::size_t i : pixels) {
            add_spread(a[i]);
            add_spread(b[i]);
        }
        const double ratios = sum.variance / largest;
        return TileDifference{sum.mean / n, sum.variance / (n * n), largest > 0.0 ? ratios * ratios / spread : 0.0,
                              sum.size / n, sum.variance > 0.0 ? cubes / std::pow(sum.variance, 1.5) : 0.0};
    });
}

WelchTiles paired_test(std::span<const Vec3> a, std::span<const Vec3> b, int width, int height, int tile, double alpha)
{
    check_sizes(a.size(), b.size(), width, height, tile);
    return test_tiles(width, height, tile, alpha, [&](const std::vector<std::size_t>& pixels, int channel) {
        RunningStatistics differences;
        double size = 0.0;
        for (const std::size_t i : pixels) {
            differences.add(a[i][channel] - b[i][channel]);
            size += std::abs(b[i][channel]);
        }
        const double error = differences.standard_error();
        return TileDifference{differences.mean(), error * error, static_cast<double>(pixels.size()) - 1.0,
                              size / static_cast<double>(pixels.size())};
    });
}
} // namespace etendue
