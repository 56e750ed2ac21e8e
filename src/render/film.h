// The film: what every pixel has received, with its variance. Blocks of SAMPLES_PER_BLOCK samples are summed in float
// on the device and merged here in double, always in sample order, so that no way of cutting the work changes a bit.
#pragma once

#include "image/image.h"
#include "math/shared.h"
#include "math/vector.h"
#include "util/statistics.h"

#include <array>
#include <cstdint>
#include <mutex>
#include <vector>

namespace etendue
{
// Pixels of the whole film; (0, 0) is the top left one.
struct PixelRect {
    int x = 0, y = 0, width = 0, height = 0;
};

// What tells the error of a pixel's mean, which is up to the sampler.
enum class ErrorEstimate {
    samples, // the variance of its samples, which are independent
    blocks,  // the variance of the means of its blocks, which are independent while the samples of one are not
    halves,  // the difference of the means of its even and its odd blocks, which are independent as two halves
    none     // nothing: its samples all depend on each other
};

// "samples" and so on.
const char* name_of(ErrorEstimate estimate);

// Radiance of a pixel: the mean of its samples, and the standard error of that mean. With fewer than two samples, full
// blocks or halves the standard error is infinite: nothing is known of the variance, and no number that could be taken
// for one is reported.
struct PixelEstimate {
    Vec3 mean{0.0};
    Vec3 standard_error{0.0};
    std::uint64_t samples = 0;
    std::uint64_t accidents = 0; // samples that counted as zero because something in them was not finite or negative
};

// Holds the pixels of the crop only. Every function may be called from any thread; a tile belongs to one caller from
// load_tile to store_tile.
class Film
{
public:
    // Throws UsageError for an empty film and for a crop that is empty or reaches outside.
    Film(int full_width, int full_height, const PixelRect& crop, bool has_aov);

    const PixelRect& crop() const { return crop_; }
    bool has_aov() const { return has_aov_; }

    // Independent samples unless set otherwise; Renderer::render sets what its sampler needs. Throws std::logic_error
    // when there are samples already.
    void set_error_estimate(ErrorEstimate estimate);
    ErrorEstimate error_estimate() const { return error_estimate_; }

    // Copy the unfinished blocks of a tile, row by row, for a launch; `aovs` comes back empty without AOVs.
    void load_tile(const PixelRect& tile, std::vector<PixelBlock>& blocks, std::vector<PixelAov>& aovs) const;
    // Take them back after the launch. Blocks that are full are merged and begin anew. The true sum of a block is
    // sum - compensation (Kahan: y = x - c; t = sum + y; c = (t - sum) - y; sum = t). Throws DeviceError where a block
    // has an impossible number of samples.
    void store_tile(const PixelRect& tile, const std::vector<PixelBlock>& blocks, const std::vector<PixelAov>& aovs);

    // Of all samples so far, unfinished blocks included. x and y are those of the whole film, within the crop.
    PixelEstimate estimate(int x, int y) const;

    // Channels R, G, B, stderr.R/G/B, with AOVs albedo.R/G/B and normal.X/Y/Z (means over all samples) and depth.Z
    // (mean over the samples that hit something, times depth_scale; 0 where none did), and samples.Y.
    Image resolve(double depth_scale) const;

    // By pixel, row by row: the mean over its channels of se^2 / (x^2 + (mean / 100)^2), where mean is that of the
    // picture; what is known exactly counts 0. Infinite where the standard error is.
    std::vector<double> squared_relative_errors() const;
    // The root of their mean.
    double relative_error() const;

    // Whether no sample brought any light yet.
    bool is_black() const;

    // The fewest and the sum of samples over the pixels.
    std::uint64_t min_samples() const;
    std::uint64_t total_samples() const;

private:
    // The merged blocks of a pixel.
    struct Pixel {
        std::array<Moments, 3> radiance;
        std::uint64_t samples = 0;
        std::uint64_t accidents = 0;
    };
    // What the errors of blocks and halves are worked out from: of the merged blocks.
    using BlockMeans = std::array<Moments, 3>;
    struct Halves {
        std::array<Vec3, 2> sum{Vec3(0.0), Vec3(0.0)}; // of the samples of even and odd blocks
    };
    // Sums over the samples of the merged blocks.
    struct Aov {
        Vec3 albedo{0.0}, normal{0.0};
        double depth = 0.0;
        double hits = 0.0;
    };

    std::size_t index(int x, int y) const;
    void check_tile(const PixelRect& tile) const;
    static void merge_block(Pixel& pixel, const PixelBlock& block);
    static void add_aov(Aov& total, const PixelAov& aov);
    static void add_to_half(Halves& halves, std::uint64_t samples_before, const PixelBlock& block);
    void merge_replicates(std::size_t i, const PixelBlock& block);
    Pixel pixel_now(std::size_t i) const;
    PixelEstimate estimate_now(std::size_t i) const;
    Vec3 standard_error_now(std::size_t i, const Pixel& pixel) const;
    Aov aov_now(std::size_t i) const;

    int full_width_, full_height_;
    PixelRect crop_;
    bool has_aov_;
    ErrorEstimate error_estimate_ = ErrorEstimate::samples;
    mutable std::mutex mutex_;
    std::vector<Pixel> pixels_;
    std::vector<PixelBlock> pending_;
    std::vector<BlockMeans> block_means_; // empty unless the error comes from blocks
    std::vector<Halves> halves_;          // empty unless the error comes from halves
    std::vector<Aov> aovs_;               // empty without AOVs
    std::vector<PixelAov> pending_aovs_;  // empty without AOVs
};
} // namespace etendue
