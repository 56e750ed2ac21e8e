// What a noisy reference adds to errors, and what is taken away again.
#include "converge/errors.h"

#include "synthetic_study.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace etendue;

namespace
{
Snapshot snapshot_of(const Pixels& picture)
{
    Snapshot snapshot;
    snapshot.pixels.mean = picture;
    snapshot.pixels.variance.assign(picture.size(), Vec3(0.25));
    return snapshot;
}
} // namespace

TEST_CASE("the reference's variance is in what is measured, and not in what is reported", "[converge]")
{
    // E (x - r)^2 = Var x + Var r for an unbiased picture: 0.25 t^2 / N for each, t the pixel's mean.
    SyntheticOptions options;
    options.width = options.height = 32;
    options.reference_samples = 16.0;
    SyntheticScene scene(options, 5);
    const StudiedConfiguration studied = scene.run("default", scene.reference());
    double squares = 0.0;
    for (std::size_t i = 0; i < 1024; ++i) squares += true_value(i) * true_value(i) / 1024;
    CHECK(studied.reference->floor == Approx(0.25 * squares / 16.0));
    for (std::size_t k : {0u, 4u, 8u}) {
        const double variance = 0.25 * squares / std::exp2(k);
        std::vector<double> measured, corrected, relative;
        for (const Run& run : studied.runs) {
            measured.push_back(run.rows[k].metrics.mse);
            corrected.push_back(run.rows[k].mse);
            relative.push_back(run.rows[k].relmse);
        }
        CAPTURE(k);
        CHECK(mean_of(measured) == Approx(variance + studied.reference->floor).epsilon(0.05));
        // What stays is known as well as the reference says.
        CHECK(std::abs(mean_of(corrected) - variance) < 5 * studied.reference->floor_error + 0.03 * variance);
        CHECK(std::abs(mean_of(relative) - 0.25 / std::exp2(k)) < 0.03 / 16 + 0.03 / std::exp2(k));
    }
}

TEST_CASE("the floor's own error is the spread that it has", "[converge]")
{
    SyntheticOptions options;
    options.reference_samples = 16.0;
    std::vector<double> excess;
    double predicted = 0.0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SyntheticScene scene(options, seed);
        const auto reference = scene.reference();
        double squares = 0.0;
        for (std::size_t i = 0; i < reference->mean.size(); ++i) {
            const Vec3 error = reference->mean[i] - Vec3(true_value(i));
            squares += glm::dot(error, error) / (3.0 * static_cast<double>(reference->mean.size()));
        }
        excess.push_back(squares - reference->floor);
        predicted = reference->floor_error;
    }
    double variance = 0.0;
    for (const double x : excess) variance += x * x / 300.0;
    // The channels here are independent, which the prediction takes for equal: sqrt(3) less spread.
    CHECK(predicted == Approx(std::sqrt(3.0 * variance)).epsilon(0.15));
}

TEST_CASE("a row holds what the film says of itself", "[converge]")
{
    const Pixels picture{Vec3(1, 2, 3), Vec3(std::nan(""), -1, INFINITY)};
    const ErrorRow row = bare_row(snapshot_of(picture));
    CHECK(row.bad.nan == 1);
    CHECK(row.bad.infinite == 1);
    CHECK(row.bad.negative == 1);
    CHECK(row.var_mean == 0.25 / 2);
}

TEST_CASE("errors between seeds are the variance, and see no bias", "[converge]")
{
    SyntheticOptions options;
    options.width = options.height = 32;
    options.seeds = 1;
    std::vector<Run> runs(4);
    std::vector<std::vector<Pixels>> pictures(4);
    for (std::uint64_t s = 0; s < 4; ++s) {
        options.bias = 0.5; // the same for all
        SyntheticScene scene(options, s);
        pictures[s] = {scene.run("default", scene.reference()).pool.mean()};
        runs[s].rows.resize(1);
    }
    // A run that ended before its second checkpoint counts for the first.
    runs[0].rows.resize(2);
    runs[0].rows[1].checkpoint = 1;
    pictures[0].push_back(pictures[0][0]);
    set_errors_between_seeds(runs, pictures, {});
    double squares = 0.0, mse = 0.0;
    for (std::size_t i = 0; i < 1024; ++i) squares += true_value(i) * true_value(i) / 1024;
    for (const Run& run : runs) mse += run.rows[0].mse / 4;
    CHECK(mse == Approx(0.25 * squares / 256).epsilon(0.05));
    CHECK(std::isnan(runs[0].rows[1].mse));
}

TEST_CASE("pools of pictures know their spread", "[converge]")
{
    PixelPool pool;
    pool.add({Vec3(1.0)});
    CHECK(std::isinf(pool.variance_of_mean()[0].x));
    pool.add({Vec3(3.0)});
    pool.add({Vec3(5.0)});
    CHECK(pool.mean()[0] == Vec3(3.0));
    CHECK(pool.variance_of_mean()[0].x == Approx(4.0 / 3.0));
}
