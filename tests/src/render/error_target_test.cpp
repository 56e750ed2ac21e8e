// Stopping at an error: films filled with noise of a known size, so that the true error of each is known too.
#include "render/error_target.h"
#include "scene/scene_loader.h"
#include "util/error.h"
#include "util/statistics.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>
#include <random>

#include <fmt/format.h>

using namespace etendue;

namespace
{
constexpr int SIZE = 16;
constexpr std::uint64_t PIXELS = SIZE * SIZE;

// A picture of bright and dark pixels, whose noise is as strong as they are bright, and the blocks of its film. Samples
// are normal, so that a block's sum and M2 can be drawn at once.
class NoisyFilm
{
public:
    NoisyFilm(ErrorEstimate estimate, unsigned seed) : random_(seed)
    {
        film_.set_error_estimate(estimate);
        for (std::uint64_t i = 0; i < PIXELS; ++i) means_.push_back(std::exp(normal_(random_)));
    }

    Film& film() { return film_; }

    void add_block()
    {
        std::vector<PixelBlock> blocks(PIXELS);
        std::chi_squared_distribution<double> chi_squared(SAMPLES_PER_BLOCK - 1);
        for (std::uint64_t i = 0; i < PIXELS; ++i) {
            // Channels are different multiples of one number, as grey light would be.
            const double z = normal_(random_), m2 = chi_squared(random_), mean = means_[i];
            const double sum = SAMPLES_PER_BLOCK * mean + std::sqrt(SAMPLES_PER_BLOCK) * mean * z;
            for (int c = 0; c < 3; ++c) {
                blocks[i].sum.s[c] = static_cast<float>(sum * (c + 1));
                blocks[i].m2.s[c] = static_cast<float>(m2 * mean * mean * (c + 1) * (c + 1));
            }
            blocks[i].sum.s[3] = SAMPLES_PER_BLOCK;
        }
        film_.store_tile(film_.crop(), blocks, {});
    }

    // By the means that the pixels really have.
    double true_error() const
    {
        double average = 0.0, sum = 0.0;
        for (const double mean : means_) average += mean * 2.0 / PIXELS;
        for (std::uint64_t i = 0; i < PIXELS; ++i)
            for (int c = 0; c < 3; ++c) {
                const double truth = means_[i] * (c + 1);
                const double found = film_.estimate(static_cast<int>(i % SIZE), static_cast<int>(i / SIZE)).mean[c];
                sum += std::pow((found - truth) / std::hypot(truth, 0.01 * average), 2.0) / (3.0 * PIXELS);
            }
        return std::sqrt(sum);
    }

    // As a renderer does, pass by pass; returns the samples per pixel at the stop.
    std::uint64_t render(ErrorTarget& target)
    {
        for (std::uint64_t samples = SAMPLES_PER_BLOCK;; samples += SAMPLES_PER_BLOCK) {
            add_block();
            if (!target.go_on({samples, 0.0}) || samples > 100000) return samples;
        }
    }

private:
    Film film_{SIZE, SIZE, {0, 0, SIZE, SIZE}, false};
    std::vector<double> means_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
};

// A film whose every pixel is 1 without noise but those of `worst`.
Film& constant_blocks(Film& film, int blocks, int worst = 0)
{
    const PixelRect crop = film.crop();
    for (int b = 0; b < blocks; ++b) {
        std::vector<PixelBlock> all(static_cast<std::size_t>(crop.width * crop.height));
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i].sum = {{64.0f, 64.0f, 64.0f, 64.0f}}, all[i].m2.s[0] = static_cast<int>(i) < worst ? 1000.0f : 0.1f;
        film.store_tile(crop, all, {});
    }
    return film;
}
} // namespace

TEST_CASE("the true error at the stop is below the target as often as promised, and not by much")
{
    constexpr int RUNS = 160;
    constexpr double WANTED = 0.03;
    for (const double confidence : {0.95, 0.7})
        for (const ErrorEstimate kind : {ErrorEstimate::samples, ErrorEstimate::blocks, ErrorEstimate::halves}) {
            int kept = 0;
            RunningStatistics ratio, samples;
            for (unsigned run = 0; run < RUNS; ++run) {
                NoisyFilm noisy(kind, run + 1);
                ErrorTarget target(noisy.film(), WANTED, confidence);
                samples.add(static_cast<double>(noisy.render(target)));
                CHECK(target.report().reached);
                CHECK(target.report().error.high <= WANTED);
                kept += noisy.true_error() <= WANTED;
                ratio.add(noisy.true_error() / WANTED);
            }
            std::cout << fmt::format(
                "error target by {}, confidence {}: kept in {} of {} runs, true error {:.3f} of the "
                "target, {:.0f} samples\n",
                name_of(kind), confidence, kept, RUNS, ratio.mean(), samples.mean());
            // Fewer than this happen once in ten thousand where the promise holds.
            const double least = RUNS * confidence - 3.72 * std::sqrt(RUNS * confidence * (1.0 - confidence));
            CAPTURE(name_of(kind), confidence, kept);
            CHECK(kept >= least);
            // Noise as strong as the signal needs 1 / WANTED^2 = 1111 samples.
            CHECK(samples.mean() > 1111.0);
            CHECK(samples.mean() < 1111.0 * 1.5);
        }
}

TEST_CASE("no picture stops at its first look, however good it seems")
{
    struct Least {
        ErrorEstimate kind;
        std::uint64_t samples;
    };
    for (const auto& [kind, least] :
         {Least{ErrorEstimate::samples, 128}, Least{ErrorEstimate::blocks, 320}, Least{ErrorEstimate::halves, 384}}) {
        INFO(name_of(kind));
        Film film(8, 8, {0, 0, 8, 8}, false);
        film.set_error_estimate(kind);
        ErrorTarget target(film, 0.5, 0.95);
        for (const std::uint64_t samples : {1, 2, 4, 8, 16, 32}) CHECK(target.go_on({samples, 0.0}));
        CHECK(target.report().looks == 0);
        std::uint64_t samples = 0;
        do constant_blocks(film, 1), samples += SAMPLES_PER_BLOCK;
        while (target.go_on({samples, 0.0}) && samples < 10000);
        CHECK(samples == least);
        CHECK(target.report().reached);
        CHECK(target.report().looks == 2);
    }
}

TEST_CASE("limits close in on the estimate as pixels become more")
{
    const auto width_of = [](int size) {
        Film film(size, size, {0, 0, size, size}, false);
        const ErrorInterval error = estimate_error(constant_blocks(film, 2), 0.95);
        CHECK(error.low < error.relative_error);
        CHECK(error.relative_error < error.high);
        CHECK(error.relative_error == Approx(film.relative_error()).epsilon(1e-12));
        return (error.high - error.low) / error.relative_error;
    };
    CHECK(width_of(64) == Approx(width_of(16) / 4.0).epsilon(0.05));
    Film film(16, 16, {0, 0, 16, 16}, false);
    constant_blocks(film, 2);
    CHECK(estimate_error(film, 0.99).high > estimate_error(film, 0.9).high);
    CHECK(estimate_error(film, 0.5).high == Approx(film.relative_error()));
}

TEST_CASE("an error that few pixels make is told as one")
{
    Film film(50, 40, {0, 0, 50, 40}, false), even(50, 40, {0, 0, 50, 40}, false);
    CHECK(estimate_error(constant_blocks(film, 1, 2), 0.95).top_share ==
          Approx(2000.0 / (2000.0 + 199.8)).epsilon(1e-5));
    CHECK(estimate_error(film, 0.95).heavy_tail());
    CHECK(estimate_error(constant_blocks(even, 1), 0.95).top_share == Approx(0.001).epsilon(1e-5));
    CHECK_FALSE(estimate_error(even, 0.95).heavy_tail());
}

TEST_CASE("an unknown error has no limits and stops nothing")
{
    Film film(8, 8, {0, 0, 8, 8}, false);
    film.set_error_estimate(ErrorEstimate::none);
    ErrorTarget target(film, 1e9, 0.95);
    for (std::uint64_t samples = 64; samples <= 1024; samples += 64) {
        constant_blocks(film, 1);
        CHECK(target.go_on({samples, 0.0}));
    }
    CHECK_FALSE(target.report().reached);
    CHECK(std::isinf(target.report().error.high));
    CHECK(target.report().error.low == 0.0);
}

TEST_CASE("a picture that is black so far is not known to be black")
{
    Film film(8, 8, {0, 0, 8, 8}, false);
    ErrorTarget target(film, 0.5, 0.95);
    for (std::uint64_t samples = 64; samples <= 1024; samples += 64) {
        std::vector<PixelBlock> blocks(64);
        for (PixelBlock& block : blocks) block.sum.s[3] = SAMPLES_PER_BLOCK;
        film.store_tile({0, 0, 8, 8}, blocks, {});
        CHECK(target.go_on({samples, 0.0}));
    }
    CHECK(film.is_black());
    CHECK_THROWS_WITH(check_error_target(parse_scene(R"({"shapes": [{"type": "sphere", "material": "m"}],
                                           "materials": [{"name": "m", "type": "diffuse"}]})",
                                                     "a.json")
                                             .scene,
                                         {0, 0, 8, 8}),
                      Catch::Contains("Nothing in the scene emits light"));
}

TEST_CASE("what cannot tell its error is refused before it is rendered")
{
    const auto check = [](const std::vector<std::string>& overrides, const PixelRect& crop = {0, 0, 8, 8}) {
        check_error_target(parse_scene(R"({"environment": {"radiance": 1}})", "a.json", overrides).scene, crop);
    };
    CHECK_NOTHROW(check({}));
    CHECK_NOTHROW(check({"sampler.type=sobol"}));
    CHECK_NOTHROW(check({"sampler.type=stratified"}));
    CHECK_THROWS_AS(check({R"(sampler={"type":"sobol","replicates":1})"}), UsageError);
    CHECK_THROWS_WITH(check({R"(sampler={"type":"sobol","replicates":1})"}), Catch::Contains("sampler.replicates=2"));
    CHECK_THROWS_AS(check({"integrator.type=normals"}), UsageError);
    CHECK_THROWS_WITH(check({}, {0, 0, 9, 7}), Catch::Contains("63 pixels"));
}
