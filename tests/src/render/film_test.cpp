// The film against long double sums over every sample, fed through blocks as a device fills them.
#include "render/film.h"
#include "util/error.h"
#include "util/statistics.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <thread>

using namespace etendue;

namespace
{
using Sample = std::array<float, 3>;

// One sample into the running sums of a block: Kahan's sum, and Welford's update with the means before and after.
void add_sample(PixelBlock& block, const Sample& sample, bool accident = false)
{
    const float n = block.sum.s[3];
    for (int c = 0; c < 3; ++c) {
        const float x = sample[static_cast<std::size_t>(c)];
        const float before = n > 0.0f ? (block.sum.s[c] - block.compensation.s[c]) / n : 0.0f;
        const float y = x - block.compensation.s[c];
        const float t = block.sum.s[c] + y;
        block.compensation.s[c] = (t - block.sum.s[c]) - y;
        block.sum.s[c] = t;
        const float after = (block.sum.s[c] - block.compensation.s[c]) / (n + 1.0f);
        block.m2.s[c] += (x - before) * (x - after);
    }
    block.sum.s[3] = n + 1.0f;
    if (accident) block.m2.s[3] += 1.0f;
}

// The sample s of a pixel: positive, long-tailed, the same whoever asks.
Sample sample_of(int x, int y, int s)
{
    std::mt19937 random(static_cast<unsigned>((y * 64 + x) * 4096 + s));
    std::lognormal_distribution<float> radiance(0.0f, 1.0f);
    return {radiance(random), radiance(random) * 1e4f, radiance(random) * 1e-4f};
}

// Launch samples [first, last) of a tile; a launch never crosses the end of a block.
void launch(Film& film, const PixelRect& tile, int first, int last)
{
    std::vector<PixelBlock> blocks;
    std::vector<PixelAov> aovs;
    for (int s = first; s < last;) {
        const int end = std::min(last, s / SAMPLES_PER_BLOCK * SAMPLES_PER_BLOCK + SAMPLES_PER_BLOCK);
        film.load_tile(tile, blocks, aovs);
        std::size_t i = 0;
        for (int y = tile.y; y < tile.y + tile.height; ++y)
            for (int x = tile.x; x < tile.x + tile.width; ++x, ++i)
                for (int k = s; k < end; ++k) add_sample(blocks[i], sample_of(x, y, k));
        film.store_tile(tile, blocks, aovs);
        s = end;
    }
}

struct BruteForce {
    std::array<double, 3> mean, standard_error;
};

BruteForce brute_force(int x, int y, int samples)
{
    BruteForce result;
    for (std::size_t c = 0; c < 3; ++c) {
        long double sum = 0, squares = 0;
        for (int s = 0; s < samples; ++s) sum += sample_of(x, y, s)[c];
        const long double mean = sum / samples;
        for (int s = 0; s < samples; ++s) {
            const long double deviation = sample_of(x, y, s)[c] - mean;
            squares += deviation * deviation;
        }
        result.mean[c] = static_cast<double>(mean);
        result.standard_error[c] = static_cast<double>(std::sqrt(squares / (samples - 1) / samples));
    }
    return result;
}

bool same_bits(const Image& a, const Image& b)
{
    return a.channels == b.channels && a.data.size() == b.data.size() &&
           std::memcmp(a.data.data(), b.data.data(), a.data.size() * sizeof(float)) == 0;
}

// A film of one pixel, and its samples one after the other.
struct OnePixel {
    Film film{1, 1, {0, 0, 1, 1}, false};
    std::vector<PixelBlock> blocks{PixelBlock{}};

    void add(const Sample& sample)
    {
        add_sample(blocks[0], sample);
        if (blocks[0].sum.s[3] == SAMPLES_PER_BLOCK) flush();
    }
    // The launch ends here.
    void flush()
    {
        std::vector<PixelAov> none;
        film.store_tile({0, 0, 1, 1}, blocks, none);
        film.load_tile({0, 0, 1, 1}, blocks, none);
    }
    PixelEstimate estimate()
    {
        flush();
        return film.estimate(0, 0);
    }
};
} // namespace

TEST_CASE("mean and standard error are those of all samples, whole blocks or not")
{
    for (const int samples : {2, 63, 64, 65, 200}) {
        Film film(3, 2, {0, 0, 3, 2}, false);
        launch(film, film.crop(), 0, samples);
        for (int y = 0; y < 2; ++y) {
            for (int x = 0; x < 3; ++x) {
                const PixelEstimate estimate = film.estimate(x, y);
                const BruteForce expected = brute_force(x, y, samples);
                CHECK(estimate.samples == static_cast<std::uint64_t>(samples));
                for (int c = 0; c < 3; ++c) {
                    const auto i = static_cast<std::size_t>(c);
                    CHECK(estimate.mean[c] == Approx(expected.mean[i]).epsilon(std::exp2(-24))); // Kahan's bound
                    CHECK(estimate.standard_error[c] == Approx(expected.standard_error[i]).epsilon(2e-6));
                }
            }
        }
    }
}

TEST_CASE("blocks are merged in double, compensation and all")
{
    // Three full blocks and one unfinished, of integers (plus a half in the compensation) that double holds exactly.
    const int counts[] = {64, 64, 64, 16};
    const float sums[] = {16777216.0f, 64.0f, 33554432.0f, 1600.0f};
    const float compensations[] = {0.5f, -0.25f, 0.0f, 0.125f};
    const float m2s[] = {1024.0f, 3.0f, 0.0f, 77.0f};
    Film film(1, 1, {0, 0, 1, 1}, false);
    long double total = 0, count = 0;
    for (int b = 0; b < 4; ++b) {
        PixelBlock block{};
        block.sum = {{sums[b], 0, 0, static_cast<float>(counts[b])}};
        block.compensation = {{compensations[b], 0, 0, 0}};
        block.m2 = {{m2s[b], 0, 0, 0}};
        film.store_tile({0, 0, 1, 1}, {block}, {});
        total += static_cast<long double>(sums[b]) - compensations[b];
        count += counts[b];
    }
    // Sum of squares about the mean of all: within the blocks, and between them.
    const long double mean = total / count;
    long double squares = 0;
    for (int b = 0; b < 4; ++b) {
        const long double deviation = (static_cast<long double>(sums[b]) - compensations[b]) / counts[b] - mean;
        squares += m2s[b] + counts[b] * deviation * deviation;
    }
    const PixelEstimate estimate = film.estimate(0, 0);
    CHECK(estimate.samples == 208);
    CHECK(estimate.mean.x == Approx(static_cast<double>(mean)).epsilon(1e-15));
    CHECK(estimate.standard_error.x ==
          Approx(static_cast<double>(std::sqrt(squares / (count - 1) / count))).epsilon(1e-14));
}

TEST_CASE("asking for an estimate does not disturb what follows")
{
    Film asked(2, 2, {0, 0, 2, 2}, false), silent(2, 2, {0, 0, 2, 2}, false);
    for (int s = 0; s < 150; s += 10) {
        launch(asked, asked.crop(), s, s + 10);
        CHECK(asked.estimate(1, 1).samples == static_cast<std::uint64_t>(s + 10));
        asked.resolve(1.0);
        asked.relative_error();
    }
    launch(silent, silent.crop(), 0, 150);
    CHECK(same_bits(asked.resolve(1.0), silent.resolve(1.0)));
}

TEST_CASE("neither the order of tiles nor their size nor the cuts between launches change a bit")
{
    constexpr int size = 8, samples = 170;
    Film whole(size, size, {0, 0, size, size}, false);
    launch(whole, whole.crop(), 0, samples);
    const Image expected = whole.resolve(1.0);

    std::mt19937 random(3);
    for (const int edge : {1, 3, 5}) {
        struct Tile {
            PixelRect rect;
            int done = 0;
        };
        std::vector<Tile> tiles;
        for (int y = 0; y < size; y += edge)
            for (int x = 0; x < size; x += edge)
                tiles.push_back({{x, y, std::min(edge, size - x), std::min(edge, size - y)}});
        Film film(size, size, {0, 0, size, size}, false);
        while (!tiles.empty()) {
            const std::size_t i = random() % tiles.size();
            const int next = std::min(samples, tiles[i].done + 1 + static_cast<int>(random() % 60));
            launch(film, tiles[i].rect, tiles[i].done, next);
            tiles[i].done = next;
            if (next == samples) tiles.erase(tiles.begin() + static_cast<std::ptrdiff_t>(i));
        }
        CHECK(same_bits(film.resolve(1.0), expected));
    }
}

TEST_CASE("a crop holds the same bits as its place in the whole film")
{
    Film whole(7, 6, {0, 0, 7, 6}, false), crop(7, 6, {2, 1, 4, 3}, false);
    launch(whole, whole.crop(), 0, 100);
    launch(crop, crop.crop(), 0, 100);
    const Image outer = whole.resolve(1.0), inner = crop.resolve(1.0);
    CHECK(inner.width == 4);
    CHECK(inner.height == 3);
    CHECK(inner.x == 2);
    CHECK(inner.y == 1);
    CHECK(inner.full_width == 7);
    CHECK(inner.full_height == 6);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x)
            for (std::size_t c = 0; c < inner.channels.size(); ++c)
                CHECK(inner.at(x, y, c) == outer.at(x + 2, y + 1, c));
    CHECK_THROWS_AS(crop.estimate(1, 1), std::out_of_range);
}

TEST_CASE("a constant stays what it is over 2^24 samples")
{
    const Sample constant{0.1f, 1e-8f, 1e8f};
    OnePixel pixel;
    std::uint64_t done = 0;
    for (int power = 0; power <= 24; ++power) {
        for (; done < std::uint64_t{1} << power; ++done) pixel.add(constant);
        const PixelEstimate estimate = pixel.estimate();
        REQUIRE(estimate.samples == done);
        for (int c = 0; c < 3; ++c) {
            const float value = constant[static_cast<std::size_t>(c)];
            const float ulp = std::nextafter(value, std::numeric_limits<float>::infinity()) - value;
            CHECK(std::abs(estimate.mean[c] - static_cast<double>(value)) <= 2.0 * static_cast<double>(ulp));
            if (done > 1) CHECK(estimate.standard_error[c] <= 1e-6 * static_cast<double>(value));
        }
    }
}

TEST_CASE("the variance of a narrow distribution far from zero is right")
{
    std::mt19937 random(4);
    std::normal_distribution<double> normal(1000.0, 0.1);
    OnePixel pixel;
    constexpr int samples = 1 << 16;
    for (int s = 0; s < samples; ++s) pixel.add({static_cast<float>(normal(random)), 0.0f, 0.0f});
    const double variance = std::pow(pixel.estimate().standard_error.x, 2) * samples;
    // The variance of a sample variance is 2 sigma^4 / (n - 1).
    CHECK(std::abs(variance - 0.01) < 5 * 0.01 * std::sqrt(2.0 / (samples - 1)));
}

TEST_CASE("with fewer than two samples the standard error is infinite")
{
    OnePixel pixel;
    PixelEstimate estimate = pixel.estimate();
    CHECK(estimate.samples == 0);
    CHECK(estimate.mean == Vec3(0.0));
    CHECK(std::isinf(estimate.standard_error.x));
    CHECK(std::isinf(pixel.film.relative_error()));
    pixel.add({1.0f, 2.0f, 3.0f});
    estimate = pixel.estimate();
    CHECK(estimate.mean == Vec3(1.0, 2.0, 3.0));
    CHECK(std::isinf(estimate.standard_error.y));
    CHECK(std::isinf(pixel.film.relative_error()));
    pixel.add({1.0f, 2.0f, 3.0f});
    CHECK(pixel.estimate().standard_error == Vec3(0.0));
    CHECK(pixel.film.relative_error() == 0.0);
}

TEST_CASE("accidents are counted over all blocks and count as samples")
{
    Film film(1, 1, {0, 0, 1, 1}, false);
    std::vector<PixelBlock> blocks;
    std::vector<PixelAov> none;
    for (int s = 0; s < 130; ++s) {
        film.load_tile(film.crop(), blocks, none);
        const bool accident = s % 10 == 0;
        const float value = accident ? 0.0f : 1.0f;
        add_sample(blocks[0], {value, value, value}, accident);
        film.store_tile(film.crop(), blocks, none);
    }
    CHECK(film.estimate(0, 0).accidents == 13);
    CHECK(film.estimate(0, 0).samples == 130);
    CHECK(film.estimate(0, 0).mean.x == Approx(117.0 / 130.0).epsilon(1e-14));
    CHECK(film.min_samples() == 130);
    CHECK(film.total_samples() == 130);
}

TEST_CASE("the relative error follows its formula")
{
    Film film(2, 1, {0, 0, 2, 1}, false);
    launch(film, film.crop(), 0, 100);
    double mean = 0.0, sum = 0.0;
    for (int x = 0; x < 2; ++x)
        for (const double value : brute_force(x, 0, 100).mean) mean += value / 6;
    for (int x = 0; x < 2; ++x) {
        const BruteForce pixel = brute_force(x, 0, 100);
        for (std::size_t c = 0; c < 3; ++c)
            sum += std::pow(pixel.standard_error[c], 2) / (std::pow(pixel.mean[c], 2) + std::pow(0.01 * mean, 2));
    }
    CHECK(film.relative_error() == Approx(std::sqrt(sum / 6)).epsilon(1e-5));
}

TEST_CASE("a black picture without variance has no relative error")
{
    OnePixel pixel;
    for (int s = 0; s < 70; ++s) pixel.add({0.0f, 0.0f, 0.0f});
    pixel.flush();
    CHECK(pixel.film.relative_error() == 0.0);
}

TEST_CASE("the picture has every channel under its name")
{
    Film film(2, 1, {0, 0, 2, 1}, true);
    std::vector<PixelBlock> blocks;
    std::vector<PixelAov> aovs;
    // The left pixel hits something with three of four samples, the right one with none.
    for (int s = 0; s < 128; ++s) {
        film.load_tile(film.crop(), blocks, aovs);
        add_sample(blocks[0], {0.25f, 0.5f, 0.75f});
        add_sample(blocks[1], {1.0f, 1.0f, 1.0f});
        if (s % 4 != 0) {
            const float albedo[] = {0.5f, 0.25f, 0.125f, 3.0f}, normal[] = {0.0f, 0.0f, 1.0f, 1.0f};
            for (int c = 0; c < 4; ++c) {
                aovs[0].albedo.s[c] += albedo[c];
                aovs[0].normal.s[c] += normal[c];
            }
        }
        film.store_tile(film.crop(), blocks, aovs);
    }
    const Image image = film.resolve(10.0);
    const std::vector<std::string> names{"R",        "G",        "B",        "stderr.R", "stderr.G",
                                         "stderr.B", "albedo.R", "albedo.G", "albedo.B", "normal.X",
                                         "normal.Y", "normal.Z", "depth.Z",  "samples.Y"};
    CHECK(image.channels == names);
    const std::vector<float> left{0.25f,   0.5f,     0.75f, 0.0f, 0.0f,  0.0f,  0.375f,
                                  0.1875f, 0.09375f, 0.0f,  0.0f, 0.75f, 30.0f, 128.0f};
    const std::vector<float> right{1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 128};
    for (std::size_t c = 0; c < names.size(); ++c) {
        CHECK(image.at(0, 0, c) == left[c]);
        CHECK(image.at(1, 0, c) == right[c]);
    }
    CHECK(Film(1, 1, {0, 0, 1, 1}, false).resolve(1.0).channels.size() == 7);
}

TEST_CASE("workers may store different tiles at the same time")
{
    Film serial(8, 8, {0, 0, 8, 8}, false), parallel(8, 8, {0, 0, 8, 8}, false);
    launch(serial, serial.crop(), 0, 130);
    std::vector<std::thread> workers;
    for (int w = 0; w < 4; ++w) workers.emplace_back([&parallel, w] { launch(parallel, {0, w * 2, 8, 2}, 0, 130); });
    while (parallel.min_samples() < 130) CHECK(parallel.relative_error() >= 0.0);
    for (std::thread& worker : workers) worker.join();
    CHECK(same_bits(serial.resolve(1.0), parallel.resolve(1.0)));
}

TEST_CASE("a film without pixels and a crop outside are refused in words")
{
    CHECK_THROWS_WITH(Film(0, 5, {0, 0, 0, 5}, false), "The film has no pixels: its size is 0x5.");
    for (const PixelRect& crop : {PixelRect{0, 0, 0, 1}, PixelRect{-1, 0, 2, 2}, PixelRect{3, 0, 2, 1},
                                  PixelRect{0, 2147483647, 2, 2147483647}})
        CHECK_THROWS_AS(Film(4, 4, crop, false), UsageError);
    CHECK_THROWS_WITH(Film(4, 4, {3, 0, 2, 1}, false), Catch::Contains("The crop 3,0,2,1") && Catch::Contains("4x4"));
}

TEST_CASE("a tile outside the crop and a block with too many samples are refused")
{
    Film film(4, 4, {1, 1, 2, 2}, false);
    std::vector<PixelBlock> blocks;
    std::vector<PixelAov> none;
    CHECK_THROWS_AS(film.load_tile({0, 1, 2, 2}, blocks, none), std::out_of_range);
    film.load_tile({1, 1, 2, 2}, blocks, none);
    CHECK_THROWS_AS(film.store_tile({1, 1, 2, 1}, blocks, none), std::invalid_argument);
    blocks[3].sum.s[3] = 65.0f;
    CHECK_THROWS_AS(film.store_tile({1, 1, 2, 2}, blocks, none), DeviceError);
    blocks[3].sum.s[3] = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_AS(film.store_tile({1, 1, 2, 2}, blocks, none), DeviceError);
    CHECK(film.total_samples() == 0);
}

TEST_CASE("the error of blocks is that of their means, and of halves that of their difference")
{
    const double unknown = std::numeric_limits<double>::infinity();
    for (const int samples : {1, 63, 64, 65, 127, 128, 150, 192, 256, 300}) {
        Film film(2, 1, {0, 0, 2, 1}, false), blocks(2, 1, {0, 0, 2, 1}, false), halves(2, 1, {0, 0, 2, 1}, false);
        Film none(2, 1, {0, 0, 2, 1}, false);
        blocks.set_error_estimate(ErrorEstimate::blocks);
        halves.set_error_estimate(ErrorEstimate::halves);
        none.set_error_estimate(ErrorEstimate::none);
        for (Film* f : {&film, &blocks, &halves, &none}) launch(*f, f->crop(), 0, samples);
        for (int x = 0; x < 2; ++x)
            for (int c = 0; c < 3; ++c) {
                CAPTURE(samples, x, c);
                const auto channel = static_cast<std::size_t>(c);
                long double sums[2] = {0, 0}, counts[2] = {0, 0};
                std::vector<long double> means(static_cast<std::size_t>(samples / SAMPLES_PER_BLOCK));
                for (int s = 0; s < samples; ++s) {
                    const long double value = sample_of(x, 0, s)[channel];
                    const auto block = static_cast<std::size_t>(s / SAMPLES_PER_BLOCK);
                    sums[block % 2] += value;
                    counts[block % 2] += 1;
                    if (block < means.size()) means[block] += value / SAMPLES_PER_BLOCK;
                }
                // The mean of what is known is the same bits, whatever tells its error.
                for (const Film* f : {&blocks, &halves, &none})
                    CHECK(f->estimate(x, 0).mean[c] == film.estimate(x, 0).mean[c]);
                CHECK(none.estimate(x, 0).standard_error[c] == unknown);

                long double mean = 0, squares = 0;
                const auto n = static_cast<long double>(means.size());
                for (const long double m : means) mean += m / n;
                for (const long double m : means) squares += (m - mean) * (m - mean);
                const double of_blocks =
                    means.size() < 2 ? unknown : static_cast<double>(std::sqrt(squares / (n - 1) / n));
                CHECK(blocks.estimate(x, 0).standard_error[c] == Approx(of_blocks).epsilon(1e-5));

                const long double weights = counts[0] * counts[1] / (samples * static_cast<long double>(samples));
                const double of_halves =
                    counts[1] == 0
                        ? unknown
                        : static_cast<double>(std::abs(sums[0] / counts[0] - sums[1] / counts[1]) * std::sqrt(weights));
                CHECK(halves.estimate(x, 0).standard_error[c] == Approx(of_halves).epsilon(1e-5));
            }
    }
}

TEST_CASE("samples, blocks and halves agree on the error of independent samples")
{
    // The mean over pixels of the squared standard error is unbiased by each of the three.
    constexpr int SIZE = 24, SAMPLES = 256;
    constexpr double VARIANCE = 1.0 / SAMPLES; // of the mean of exponential samples
    std::mt19937 random(5);
    std::exponential_distribution<float> radiance;
    for (const ErrorEstimate kind : {ErrorEstimate::samples, ErrorEstimate::blocks, ErrorEstimate::halves}) {
        Film film(SIZE, SIZE, {0, 0, SIZE, SIZE}, false);
        film.set_error_estimate(kind);
        for (int b = 0; b < SAMPLES / SAMPLES_PER_BLOCK; ++b) {
            std::vector<PixelBlock> blocks(SIZE * SIZE);
            for (PixelBlock& block : blocks)
                for (int s = 0; s < SAMPLES_PER_BLOCK; ++s) add_sample(block, {radiance(random), 0.0f, 0.0f});
            film.store_tile(film.crop(), blocks, {});
        }
        RunningStatistics squares;
        for (int y = 0; y < SIZE; ++y)
            for (int x = 0; x < SIZE; ++x) squares.add(std::pow(film.estimate(x, y).standard_error.x, 2.0));
        INFO(name_of(kind) << ": " << squares.mean() << " +- " << squares.standard_error() << " for " << VARIANCE);
        CHECK(std::abs(squares.mean() - VARIANCE) < 4.5 * squares.standard_error());
        CHECK(squares.standard_error() < 0.08 * VARIANCE);
    }
}

TEST_CASE("the relative error is the root of the mean over the pixels, and unknown where one pixel's is")
{
    Film film(3, 2, {0, 0, 3, 2}, false);
    film.set_error_estimate(ErrorEstimate::halves);
    launch(film, film.crop(), 0, 64);
    CHECK(std::isinf(film.relative_error()));
    launch(film, {0, 0, 2, 2}, 64, 128);
    CHECK(std::isinf(film.relative_error()));
    CHECK(std::isinf(film.squared_relative_errors().at(5)));
    CHECK(std::isfinite(film.squared_relative_errors().at(3)));
    launch(film, {2, 0, 1, 2}, 64, 128);
    double sum = 0.0;
    for (const double error : film.squared_relative_errors()) sum += error;
    CHECK(film.squared_relative_errors().size() == 6);
    CHECK(film.relative_error() == Approx(std::sqrt(sum / 6.0)).epsilon(1e-14));
}

TEST_CASE("how a film estimates its error is settled before its first sample")
{
    Film film(1, 1, {0, 0, 1, 1}, false);
    CHECK(film.error_estimate() == ErrorEstimate::samples);
    film.set_error_estimate(ErrorEstimate::halves);
    CHECK(film.error_estimate() == ErrorEstimate::halves);
    launch(film, film.crop(), 0, 1);
    CHECK_THROWS_AS(film.set_error_estimate(ErrorEstimate::samples), std::logic_error);
    CHECK(film.error_estimate() == ErrorEstimate::halves);
    CHECK(name_of(ErrorEstimate::samples) == std::string("samples"));
    CHECK(name_of(ErrorEstimate::blocks) == std::string("blocks"));
    CHECK(name_of(ErrorEstimate::halves) == std::string("halves"));
    CHECK(name_of(ErrorEstimate::none) == std::string("none"));
}
