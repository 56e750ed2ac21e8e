// Merging of blocks, and what is read from the merged pixels.
#include "render/film.h"

#include "util/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace etendue
{
namespace
{
// A crop or tile must have pixels and lie within `outer`.
bool lies_within(const PixelRect& inner, const PixelRect& outer)
{
    return inner.width > 0 && inner.height > 0 && inner.x >= outer.x && inner.y >= outer.y &&
           inner.width <= outer.width && inner.height <= outer.height &&
           inner.x - outer.x <= outer.width - inner.width && inner.y - outer.y <= outer.height - inner.height;
}

double at(const real4& v, int i)
{
    return static_cast<double>(v.s[i]);
}

Vec3 xyz(const real4& v)
{
    return Vec3(at(v, 0), at(v, 1), at(v, 2));
}

// Mean of one channel of a block, compensation and all.
double block_mean(const PixelBlock& block, int c)
{
    return (at(block.sum, c) - at(block.compensation, c)) / at(block.sum, 3);
}

// Samples of the even and the odd blocks among the first n of a pixel.
std::array<double, 2> half_counts(std::uint64_t n)
{
    const std::uint64_t pairs = n / (2 * SAMPLES_PER_BLOCK), rest = n % (2 * SAMPLES_PER_BLOCK);
    const std::uint64_t even = std::min<std::uint64_t>(rest, SAMPLES_PER_BLOCK);
    return {static_cast<double>(pairs * SAMPLES_PER_BLOCK + even),
            static_cast<double>(pairs * SAMPLES_PER_BLOCK + rest - even)};
}

// se^2 / (x^2 + floor^2), where 0/0 is an exact zero.
double squared_relative_error(double standard_error, double x, double floor)
{
    if (standard_error == 0.0) return 0.0;
    const double ratio = standard_error / std::hypot(x, floor);
    return ratio * ratio;
}
} // namespace

const char* name_of(ErrorEstimate estimate)
{
    static constexpr std::array<const char*, 4> names{"samples", "blocks", "halves", "none"};
    return names.at(static_cast<std::size_t>(estimate));
}

Film::Film(int full_width, int full_height, const PixelRect& crop, bool has_aov)
    : full_width_(full_width), full_height_(full_height), crop_(crop), has_aov_(has_aov)
{
    if (full_width <= 0 || full_height <= 0)
        throw UsageError(fmt::format("The film has no pixels: its size is {}x{}.", full_width, full_height));
    if (!lies_within(crop, {0, 0, full_width, full_height}))
        throw UsageError(fmt::format("The crop {},{},{},{} (x, y, width, height) does not lie within the film of {}x{} "
                                     "pixels, or is empty.",
                                     crop.x, crop.y, crop.width, crop.height, full_width, full_height));
    const std::size_t count = static_cast<std::size_t>(crop.width) * static_cast<std::size_t>(crop.height);
    pixels_.resize(count);
    pending_.resize(count);
    if (has_aov_) {
        aovs_.resize(count);
        pending_aovs_.resize(count);
    }
}

void Film::set_error_estimate(ErrorEstimate estimate)
{
    if (total_samples() > 0) throw std::logic_error("a film with samples cannot change how its error is estimated");
    error_estimate_ = estimate;
    block_means_.resize(estimate == ErrorEstimate::blocks ? pixels_.size() : 0);
    halves_.resize(estimate == ErrorEstimate::halves ? pixels_.size() : 0);
}

std::size_t Film::index(int x, int y) const
{
    return static_cast<std::size_t>(y - crop_.y) * static_cast<std::size_t>(crop_.width) +
           static_cast<std::size_t>(x - crop_.x);
}

void Film::check_tile(const PixelRect& tile) const
{
    if (!lies_within(tile, crop_)) throw std::out_of_range("a tile lies outside the film's crop");
}

void Film::load_tile(const PixelRect& tile, std::vector<PixelBlock>& blocks, std::vector<PixelAov>& aovs) const
{
    check_tile(tile);
    blocks.clear();
    aovs.clear();
    const std::lock_guard lock(mutex_);
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
        const auto begin = static_cast<std::ptrdiff_t>(index(tile.x, y)), end = begin + tile.width;
        blocks.insert(blocks.end(), pending_.begin() + begin, pending_.begin() + end);
        if (has_aov_) aovs.insert(aovs.end(), pending_aovs_.begin() + begin, pending_aovs_.begin() + end);
    }
}

void Film::store_tile(const PixelRect& tile, const std::vector<PixelBlock>& blocks, const std::vector<PixelAov>& aovs)
{
    check_tile(tile);
    const std::size_t count = static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height);
    if (blocks.size() != count || (has_aov_ && aovs.size() != count))
        throw std::invalid_argument("a tile comes back with another number of pixels than it has");
    for (const PixelBlock& block : blocks)
        if (!(at(block.sum, 3) >= 0.0 && at(block.sum, 3) <= SAMPLES_PER_BLOCK))
            throw DeviceError(fmt::format("The device returned a block of {} samples; a block has at most {}.",
                                          at(block.sum, 3), SAMPLES_PER_BLOCK));

    const std::lock_guard lock(mutex_);
    std::size_t source = 0;
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
        for (int x = tile.x; x < tile.x + tile.width; ++x, ++source) {
            const std::size_t i = index(x, y);
            pending_[i] = blocks[source];
            if (has_aov_) pending_aovs_[i] = aovs[source];
            if (at(pending_[i].sum, 3) < SAMPLES_PER_BLOCK) continue;
            merge_replicates(i, pending_[i]);
            pixels_[i] = pixel_now(i);
            pending_[i] = PixelBlock{};
            if (!has_aov_) continue;
            aovs_[i] = aov_now(i);
            pending_aovs_[i] = PixelAov{};
        }
    }
}

void Film::merge_block(Pixel& pixel, const PixelBlock& block)
{
    const double count = at(block.sum, 3);
    if (count == 0.0) return;
    for (int c = 0; c < 3; ++c) {
        // Rounding may leave the M2 of nearly equal samples a little below zero; a NaN stays one.
        const double m2 = at(block.m2, c) < 0.0 ? 0.0 : at(block.m2, c);
        const Moments of_block{block_mean(block, c), m2};
        Moments& merged = pixel.radiance[static_cast<std::size_t>(c)];
        merged = merge_moments(merged, static_cast<double>(pixel.samples), of_block, count);
    }
    pixel.samples += static_cast<std::uint64_t>(count);
    pixel.accidents += static_cast<std::uint64_t>(at(block.m2, 3));
}

void Film::add_aov(Aov& total, const PixelAov& aov)
{
    total.albedo += xyz(aov.albedo);
    total.normal += xyz(aov.normal);
    total.depth += at(aov.albedo, 3);
    total.hits += at(aov.normal, 3);
}

void Film::add_to_half(Halves& halves, std::uint64_t samples_before, const PixelBlock& block)
{
    Vec3& sum = halves.sum[samples_before / SAMPLES_PER_BLOCK % 2];
    sum += xyz(block.sum) - xyz(block.compensation);
}

// Before the full block is merged into its pixel.
void Film::merge_replicates(std::size_t i, const PixelBlock& block)
{
    if (error_estimate_ == ErrorEstimate::halves) add_to_half(halves_[i], pixels_[i].samples, block);
    if (error_estimate_ != ErrorEstimate::blocks) return;
    const double blocks = static_cast<double>(pixels_[i].samples / SAMPLES_PER_BLOCK);
    for (int c = 0; c < 3; ++c) {
        Moments& merged = block_means_[i][static_cast<std::size_t>(c)];
        merged = merge_moments(merged, blocks, {block_mean(block, c), 0.0}, 1.0);
    }
}

Film::Pixel Film::pixel_now(std::size_t i) const
{
    Pixel pixel = pixels_[i];
    merge_block(pixel, pending_[i]);
    return pixel;
}

Film::Aov Film::aov_now(std::size_t i) const
{
    Aov aov = aovs_[i];
    add_aov(aov, pending_aovs_[i]);
    return aov;
}

PixelEstimate Film::estimate_now(std::size_t i) const
{
    const Pixel pixel = pixel_now(i);
    PixelEstimate estimate;
    estimate.samples = pixel.samples;
    estimate.accidents = pixel.accidents;
    for (int c = 0; c < 3; ++c) estimate.mean[c] = pixel.radiance[static_cast<std::size_t>(c)].mean;
    estimate.standard_error = standard_error_now(i, pixel);
    return estimate;
}

// `pixel` is the pixel now, unfinished block included.
Vec3 Film::standard_error_now(std::size_t i, const Pixel& pixel) const
{
    const Vec3 unknown(std::numeric_limits<double>::infinity());
    Vec3 error = unknown;
    if (error_estimate_ == ErrorEstimate::samples && pixel.samples >= 2) {
        const double n = static_cast<double>(pixel.samples);
        for (int c = 0; c < 3; ++c) error[c] = std::sqrt(pixel.radiance[static_cast<std::size_t>(c)].m2 / (n - 1) / n);
    }
    // An unfinished block makes the mean better than is said here.
    const std::uint64_t blocks = pixels_[i].samples / SAMPLES_PER_BLOCK;
    if (error_estimate_ == ErrorEstimate::blocks && blocks >= 2) {
        const double n = static_cast<double>(blocks);
        for (int c = 0; c < 3; ++c) error[c] = std::sqrt(block_means_[i][static_cast<std::size_t>(c)].m2 / (n - 1) / n);
    }
    // The weights w of the halves in the mean make w0 w1 (a - b)^2 its squared error where a half's falls with its
    // number of samples, more where it falls faster, and (a - b)^2 / 4 for equal ones.
    const std::array<double, 2> counts = half_counts(pixel.samples);
    if (error_estimate_ == ErrorEstimate::halves && counts[1] > 0.0) {
        Halves now = halves_[i];
        add_to_half(now, pixels_[i].samples, pending_[i]);
        error = glm::abs(now.sum[0] / counts[0] - now.sum[1] / counts[1]) * std::sqrt(counts[0] * counts[1]) /
                static_cast<double>(pixel.samples);
    }
    return error;
}

PixelEstimate Film::estimate(int x, int y) const
{
    check_tile({x, y, 1, 1});
    const std::lock_guard lock(mutex_);
    return estimate_now(index(x, y));
}

Image Film::resolve(double depth_scale) const
{
    Image image;
    image.width = crop_.width;
    image.height = crop_.height;
    image.x = crop_.x;
    image.y = crop_.y;
    image.full_width = full_width_;
    image.full_height = full_height_;
    image.channels = {"R", "G", "B", "stderr.R", "stderr.G", "stderr.B"};
    if (has_aov_)
        image.channels.insert(image.channels.end(),
                              {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z"});
    image.channels.push_back("samples.Y");
    image.data.reserve(pixels_.size() * image.channels.size());

    const auto put = [&image](double value) { image.data.push_back(static_cast<float>(value)); };
    const auto put3 = [&put](const Vec3& v) {
        for (int c = 0; c < 3; ++c) put(v[c]);
    };
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const PixelEstimate estimate = estimate_now(i);
        put3(estimate.mean);
        put3(estimate.standard_error);
        if (has_aov_) {
            const Aov aov = aov_now(i);
            const double n = std::max(1.0, static_cast<double>(estimate.samples));
            put3(aov.albedo / n);
            put3(aov.normal / n);
            put(aov.hits > 0.0 ? aov.depth / aov.hits * depth_scale : 0.0);
        }
        put(static_cast<double>(estimate.samples));
    }
    return image;
}

std::vector<double> Film::squared_relative_errors() const
{
    const std::lock_guard lock(mutex_);
    double sum = 0.0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const Vec3 mean = estimate_now(i).mean;
        sum += mean.x + mean.y + mean.z;
    }
    const double values = 3.0 * static_cast<double>(pixels_.size());
    const double floor = 0.01 * sum / values;

    std::vector<double> errors(pixels_.size());
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const PixelEstimate estimate = estimate_now(i);
        for (int c = 0; c < 3; ++c)
            errors[i] += squared_relative_error(estimate.standard_error[c], estimate.mean[c], floor) / 3.0;
    }
    return errors;
}

double Film::relative_error() const
{
    const std::vector<double> errors = squared_relative_errors();
    return std::sqrt(std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size()));
}

bool Film::is_black() const
{
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        if (estimate_now(i).mean != Vec3(0.0)) return false;
    return true;
}

std::uint64_t Film::min_samples() const
{
    const std::lock_guard lock(mutex_);
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        least = std::min(least, pixels_[i].samples + static_cast<std::uint64_t>(at(pending_[i].sum, 3)));
    return least;
}

std::uint64_t Film::total_samples() const
{
    const std::lock_guard lock(mutex_);
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        sum += pixels_[i].samples + static_cast<std::uint64_t>(at(pending_[i].sum, 3));
    return sum;
}
} // namespace etendue
