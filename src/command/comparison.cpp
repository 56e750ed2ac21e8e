// Checks that two pictures can be compared, chooses the variance, and judges the tests.
#include "command/comparison.h"

#include "util/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr const char* CHANNELS[] = {"R", "G", "B"};
constexpr double TESTS_OF_VERDICT = 3.0; // some tile, too many small p-values, the whole picture

bool has_channel(const Image& image, const std::string& name)
{
    return std::find(image.channels.begin(), image.channels.end(), name) != image.channels.end();
}

void check_places(const Image& a, const Image& b)
{
    if (a.width != b.width || a.height != b.height)
        throw UsageError(fmt::format("The pictures have different sizes: A has {}x{} pixels, B has {}x{}.", a.width,
                                     a.height, b.width, b.height));
    if (a.x != b.x || a.y != b.y)
        throw UsageError(fmt::format("The pictures show different parts of a film: A begins at {},{}, B at {},{}.", a.x,
                                     a.y, b.x, b.y));
}

std::array<std::size_t, 3> channels_of(const Image& image, const std::string& prefix)
{
    return {image.channel(prefix + "R"), image.channel(prefix + "G"), image.channel(prefix + "B")};
}

Vec3 values_at(const Image& image, std::size_t pixel, const std::array<std::size_t, 3>& channels)
{
    const float* const values = &image.data[pixel * image.channels.size()];
    return Vec3(values[channels[0]], values[channels[1]], values[channels[2]]);
}

// Why the standard errors of a picture cannot be used; "" where they can.
std::string missing_errors(const Image& image, const std::string& name)
{
    for (const char* const channel : {"stderr.R", "stderr.G", "stderr.B", "samples.Y"})
        if (!has_channel(image, channel)) return fmt::format("{} has no channel {}.", name, channel);
    const auto channels = channels_of(image, "stderr.");
    for (std::size_t pixel = 0; pixel < image.pixel_count(); ++pixel) {
        const Vec3 error = values_at(image, pixel, channels);
        for (int c = 0; c < 3; ++c) {
            if (std::isfinite(error[c]) && error[c] >= 0.0) continue;
            const auto width = static_cast<std::size_t>(image.width);
            return fmt::format("{} has a standard error of {} at pixel {},{}.", name, error[c], pixel % width,
                               pixel / width);
        }
    }
    return {};
}

std::vector<PixelMoments> moments_of(const Image& image)
{
    const auto means = channels_of(image, ""), errors = channels_of(image, "stderr.");
    const std::size_t samples = image.channel("samples.Y");
    std::vector<PixelMoments> moments;
    moments.reserve(image.pixel_count());
    for (std::size_t pixel = 0; pixel < image.pixel_count(); ++pixel) {
        const Vec3 error = values_at(image, pixel, errors);
        const double count = image.data[pixel * image.channels.size() + samples];
        moments.push_back({values_at(image, pixel, means), error * error, degrees_of_freedom(count, image.metadata)});
    }
    return moments;
}

// Choose the variance and say why.
void choose_variance(Comparison& comparison, const Image& a, const Image& b, VarianceSource wanted)
{
    std::string missing = missing_errors(a, "A");
    if (missing.empty()) missing = missing_errors(b, "B");
    if (wanted == VarianceSource::standard_errors && !missing.empty())
        throw UsageError("--variance stderr: " + missing + " Without it, the differences within tiles are used.");
    const bool use_errors = missing.empty() && wanted != VarianceSource::differences;
    comparison.variance = use_errors ? VarianceSource::standard_errors : VarianceSource::differences;
    if (use_errors)
        comparison.variance_reason = "The variance is that of the pictures' standard errors.";
    else if (missing.empty())
        comparison.variance_reason = "The variance is that of the differences within a tile, as asked for.";
    else
        comparison.variance_reason = "The variance is that of the differences within a tile: " + missing;
}

void run_tests(Comparison& comparison, const Image& a, const Image& b, const ComparisonSettings& settings)
{
    comparison.test_alpha = settings.alpha / TESTS_OF_VERDICT;
    const int all = std::max(a.width, a.height);
    const auto run = [&](const auto& test, const auto& of_a, const auto& of_b) {
        comparison.tiles = test(of_a, of_b, a.width, a.height, settings.tile, comparison.test_alpha);
        comparison.whole = test(of_a, of_b, a.width, a.height, all, comparison.test_alpha);
    };
    if (comparison.variance == VarianceSource::standard_errors)
        run(welch_test, moments_of(a), moments_of(b));
    else
        run(paired_test, rgb_values(a), rgb_values(b));
}

bool equal_values(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Vec3& x, const Vec3& y) { return x == y; });
}

void judge(Comparison& c)
{
    if (c.metrics.non_finite > 0)
        c.failures.push_back(fmt::format("{} pixel{} not finite: no picture of light has such.", c.metrics.non_finite,
                                         c.metrics.non_finite == 1 ? " is" : "s are"));
    if (c.tiles.below_alpha > 0)
        c.failures.push_back(
            fmt::format("{} of {} tests of tiles {} a p-value below {:.2g}; the worst has z = {:.3g} in "
                        "{}.",
                        c.tiles.below_alpha, c.tiles.tests, c.tiles.below_alpha == 1 ? "has" : "have",
                        c.tiles.test_alpha, c.tiles.worst_z, place_of_worst(c.tiles)));
    if (c.tiles.excess_p_value < c.test_alpha)
        c.failures.push_back(
            fmt::format("More p-values of tiles are small than chance allows (p = {:.2g}).", c.tiles.excess_p_value));
    if (c.whole.below_alpha > 0)
        c.failures.push_back(
            fmt::format("The pictures as a whole differ: the mean of channel {} by {:.3g}, z = {:.3g}.",
                        CHANNELS[c.whole.worst % 3], c.whole.differences[c.whole.worst], c.whole.worst_z));

    if (c.metrics.negative > 0)
        c.remarks.push_back(fmt::format("{} pixel{} of A {} below 0.", c.metrics.negative,
                                        c.metrics.negative == 1 ? "" : "s", c.metrics.negative == 1 ? "is" : "are"));
    if (c.tiles.untested > 0)
        c.remarks.push_back(
            fmt::format("{} of {} tests of tiles could not be made.", c.tiles.untested, c.tiles.p_values.size()));
    if (std::isnan(c.tiles.ks_p_value))
        c.remarks.push_back("Too few tiles have noise for a test of their p-values.");
    else if (!c.identical && c.tiles.ks_p_value < c.test_alpha && !(c.tiles.excess_p_value < c.test_alpha))
        c.remarks.push_back("The pictures are nearer to each other than their noise allows: they share random numbers, "
                            "or their standard errors are too large. A difference may hide.");
}
} // namespace

std::vector<Vec3> rgb_values(const Image& image)
{
    const auto channels = channels_of(image, "");
    std::vector<Vec3> values;
    values.reserve(image.pixel_count());
    for (std::size_t pixel = 0; pixel < image.pixel_count(); ++pixel)
        values.push_back(values_at(image, pixel, channels));
    return values;
}

double degrees_of_freedom(double samples, const std::map<std::string, std::string>& metadata)
{
    const auto found = metadata.find("etendue:error_estimate");
    if (found == metadata.end()) return samples - 1.0;
    const std::string& estimate = found->second;
    if (estimate.find("halves") != std::string::npos) return 1.0;
    if (estimate.find("block") == std::string::npos) return samples - 1.0;
    int blocks = 2;
    const auto digit =
        std::find_if(estimate.begin(), estimate.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    std::from_chars(estimate.data() + (digit - estimate.begin()), estimate.data() + estimate.size(), blocks);
    return std::max(1.0, blocks - 1.0);
}

std::string place_of_worst(const WelchTiles& tiles)
{
    const std::size_t tile = tiles.worst / 3, columns = static_cast<std::size_t>(tiles.columns);
    const auto size = static_cast<std::size_t>(tiles.tile);
    return fmt::format("{} of the tile at {},{}", CHANNELS[tiles.worst % 3], tile % columns * size,
                       tile / columns * size);
}

Comparison compare_images(const Image& a, const Image& b, const ComparisonSettings& settings)
{
    check_places(a, b);
    Comparison comparison;
    const std::vector<Vec3> picture = rgb_values(a), reference = rgb_values(b);
    comparison.metrics = compare_pictures(picture, reference);
    comparison.identical = equal_values(picture, reference);
    choose_variance(comparison, a, b, settings.variance);
    run_tests(comparison, a, b, settings);
    if (comparison.tiles.tests == 0 && comparison.metrics.non_finite == 0)
        throw UsageError("Nothing can be tested: the pictures have neither standard errors nor two pixels.");
    judge(comparison);
    return comparison;
}
} // namespace etendue
