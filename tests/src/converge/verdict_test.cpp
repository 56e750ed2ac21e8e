// The verdict over many synthetic studies: planted biases are found, and no others.
#include "converge/verdict.h"

#include "synthetic_study.h"

#include <catch2/catch.hpp>

#include <map>

using namespace etendue;
using Catch::Contains;

namespace
{
// How often each result came of so many studies.
std::map<BiasResult, int> results_of(const SyntheticOptions& options, int studies)
{
    std::map<BiasResult, int> results;
    for (int i = 0; i < studies; ++i)
        ++results[analysis_of(options, 1000 + static_cast<std::uint64_t>(i)).verdict.result];
    return results;
}
} // namespace

TEST_CASE("no alarm over many studies without a bias", "[converge]")
{
    // Expected are 0.2 alarms of 200.
    std::map<BiasResult, int> results = results_of({}, 200);
    CHECK(results[BiasResult::biased] + results[BiasResult::failed] <= 2);
    CHECK(results[BiasResult::unbiased] >= 195);
}

TEST_CASE("no alarm over many studies against a noisy reference", "[converge]")
{
    // The last checkpoint has 256 samples, the reference 16 times that; then one that hides the last checkpoints.
    for (const double samples : {4096.0, 256.0}) {
        CAPTURE(samples);
        SyntheticOptions options;
        options.reference_samples = samples;
        std::map<BiasResult, int> results = results_of(options, 100);
        CHECK(results[BiasResult::biased] + results[BiasResult::failed] <= 1);
    }
}

TEST_CASE("a planted bias is found by all three parts", "[converge]")
{
    SyntheticOptions options;
    options.bias = 0.05;
    const BiasVerdict verdict = analysis_of(options, 7).verdict;
    CHECK(verdict.result == BiasResult::biased);
    CHECK_FALSE(verdict.floor_passed);
    CHECK(verdict.floor.contains(0.05 * 0.05));
    CHECK_FALSE(verdict.tiles_passed);
    CHECK_FALSE(verdict.mean_passed);
    CHECK(verdict.mean_error == Approx(0.05 / 1.0).epsilon(0.1));
    CHECK(verdict.reasons.size() >= 3);
}

TEST_CASE("a bias much below the last error is found by the mean", "[converge]")
{
    SyntheticOptions options;
    options.bias = 0.01; // the error of the last checkpoint is 0.03
    for (const double samples : {0.0, 1e5}) {
        CAPTURE(samples);
        options.reference_samples = samples;
        std::map<BiasResult, int> results = results_of(options, 20);
        CHECK(results[BiasResult::biased] == 20);
    }
}

TEST_CASE("a bias in one corner is found by its tiles although the mean is right", "[converge]")
{
    Study study = synthetic_study({}, 3);
    StudiedConfiguration& studied = study.configurations[0];
    // Brighter on the left, darker on the right by as much.
    PixelPool shifted;
    for (std::uint64_t s = 0; s < 8; ++s) {
        Pixels picture = SyntheticScene({}, 50 + s).run("x", studied.reference).pool.mean();
        for (std::size_t i = 0; i < picture.size(); ++i) picture[i] += Vec3(i % 16 < 8 ? 0.02 : -0.02);
        shifted.add(picture);
    }
    studied.pool = shifted;
    const BiasVerdict verdict = analyse(study).configurations[0].verdict;
    CHECK(verdict.result == BiasResult::biased);
    CHECK_FALSE(verdict.tiles_passed);
    CHECK(verdict.mean_passed);
}

TEST_CASE("a bias of a single tile is found", "[converge]")
{
    Study study = synthetic_study({}, 3);
    StudiedConfiguration& studied = study.configurations[0];
    PixelPool shifted;
    for (std::uint64_t s = 0; s < 8; ++s) {
        Pixels picture = SyntheticScene({}, 50 + s).run("x", studied.reference).pool.mean();
        for (const std::size_t i : {0, 1, 16, 17}) picture[i] += Vec3(0.2);
        shifted.add(picture);
    }
    studied.pool = shifted;
    const BiasVerdict verdict = analyse(study).configurations[0].verdict;
    CHECK(verdict.result == BiasResult::biased);
    CHECK(verdict.tile_p_value > 0.01); // all tiles together do not see it
    CHECK(verdict.worst_tile_z > 10.0);
}

TEST_CASE("skewed noise is judged in larger tiles, or not at all", "[converge]")
{
    SyntheticOptions options;
    options.reference_samples = 4096.0;
    const auto verdict_with = [&](double skewness, double bias) {
        options.bias = bias;
        Study study = synthetic_study(options, 7);
        auto skewed = std::make_shared<Reference>(*study.configurations[0].reference);
        skewed->skewness = skewness;
        study.configurations[0].reference = skewed;
        return analyse(study).configurations[0].verdict;
    };
    const BiasVerdict plain = verdict_with(0.0, 0.0), larger = verdict_with(2.6, 0.0), never = verdict_with(60.0, 0.0);
    CHECK(plain.tile == 2);
    CHECK(plain.result == BiasResult::unbiased);
    CHECK(larger.tile == 4);
    CHECK(larger.tiles_passed);
    CHECK(larger.result == BiasResult::unbiased);
    CHECK(larger.detectable_bias > plain.detectable_bias);
    CHECK(never.result == BiasResult::underpowered);
    CHECK_FALSE(never.tiles_passed);
    CHECK_FALSE(never.mean_passed);
    CHECK_THAT(never.reasons.front() + never.reasons.back(), Contains("too skewed"));
    // A bias is found all the same.
    CHECK(verdict_with(2.6, 0.05).result == BiasResult::biased);
}

TEST_CASE("a difference from a picture of unknown error is no bias, and no proof of none", "[converge]")
{
    SyntheticOptions options;
    options.bias = 0.05;
    Study study = synthetic_study(options, 7);
    auto unknown = std::make_shared<Reference>(*study.configurations[0].reference);
    unknown->knows_error = false;
    study.configurations[0].reference = unknown;
    CHECK(analyse(study).configurations[0].verdict.result == BiasResult::unknown);
}

TEST_CASE("two seeds do not know whether there is a floor", "[converge]")
{
    SyntheticOptions options;
    options.seeds = 2;
    options.width = options.height = 64;
    const BiasVerdict verdict = analysis_of(options, 7).verdict;
    CHECK(verdict.result == BiasResult::underpowered);
    CHECK_FALSE(verdict.floor_passed);
    CHECK_THAT(verdict.reasons.front(), Contains("A floor 2 times the last error could hide"));
}

TEST_CASE("runs are joined by their checkpoints, though one look of a run served two", "[converge]")
{
    Study study = synthetic_study({}, 3);
    std::vector<Run>& runs = study.configurations[0].runs;
    runs[2].rows.erase(runs[2].rows.begin() + 3);
    runs[5].rows.erase(runs[5].rows.begin());
    const std::vector<CurvePoint> curve = analyse(study).configurations[0].curve;
    REQUIRE(curve.size() == 7);
    const std::vector<double> samples{2, 4, 16, 32, 64, 128, 256};
    for (std::size_t k = 0; k < 7; ++k) CHECK(curve[k].samples == samples[k]);
}

TEST_CASE("what could not have been seen is underpowered", "[converge]")
{
    Study study = synthetic_study({}, 3);
    study.options.delta = 1e-4;
    const BiasVerdict verdict = analyse(study).configurations[0].verdict;
    CHECK(verdict.result == BiasResult::underpowered);
    CHECK(verdict.detectable_bias > 1e-4);
    REQUIRE(verdict.reasons.size() == 1);
    CHECK_THAT(verdict.reasons[0], Contains("could hide"));

    SyntheticOptions one_seed;
    one_seed.seeds = 1;
    CHECK(analysis_of(one_seed, 3).verdict.result == BiasResult::underpowered);
    SyntheticOptions few_checkpoints;
    few_checkpoints.checkpoints = 2;
    few_checkpoints.spread = 0.1; // no value below zero
    CHECK(analysis_of(few_checkpoints, 3).verdict.result == BiasResult::underpowered);
}

TEST_CASE("the detectable bias is one that is detected", "[converge]")
{
    // With 99 % certainty; of 40 studies one or two may miss it.
    SyntheticOptions options;
    const double detectable = analysis_of(options, 5).verdict.detectable_bias;
    options.bias = detectable * 1.1; // the mean is about 1
    int found = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) found += !analysis_of(options, 100 + seed).verdict.mean_passed;
    CHECK(found >= 36);
}

TEST_CASE("accidents and impossible slopes fail whatever the picture looks like", "[converge]")
{
    Study study = synthetic_study({}, 3);
    study.configurations[0].runs[2].rows.back().accidents = 5;
    study.configurations[0].runs[2].replay = "etendue replay synthetic.json --pixel 1,2 --sample 3 --seed 4";
    BiasVerdict verdict = analyse(study).configurations[0].verdict;
    CHECK(verdict.result == BiasResult::failed);
    CHECK_THAT(verdict.reasons.at(0), Contains("5 samples were not finite") &&
                                          Contains("the first: etendue replay synthetic.json --pixel 1,2"));

    study = synthetic_study({}, 3);
    for (Run& run : study.configurations[0].runs)
        for (ErrorRow& row : run.rows) {
            row.mse *= std::pow(static_cast<double>(row.samples), -0.3);
            row.metrics.mse = row.mse;
        }
    verdict = analyse(study).configurations[0].verdict;
    CHECK(verdict.result == BiasResult::failed);
    CHECK_THAT(verdict.reasons.at(0), Contains("must fall with slope -1"));
}

TEST_CASE("pictures that are the reference but for rounding are unbiased", "[converge]")
{
    SyntheticOptions options;
    options.spread = 1e-8;
    const BiasVerdict verdict = analysis_of(options, 3).verdict;
    CHECK(verdict.exact);
    CHECK(verdict.result == BiasResult::unbiased);
    options.bias = 1e-4;
    CHECK(analysis_of(options, 3).verdict.result == BiasResult::biased);
}

TEST_CASE("without a reference nothing is known of a bias", "[converge]")
{
    Study study = synthetic_study({}, 3);
    study.configurations[0].reference = std::make_shared<const Reference>();
    const BiasVerdict verdict = analyse(study).configurations[0].verdict;
    CHECK(verdict.result == BiasResult::unknown);
    CHECK_THAT(verdict.reasons.at(0), Contains("no bias"));
}

TEST_CASE("tiles are neither too few nor too large", "[converge]")
{
    CHECK(tile_edge(64, 64) == 8);
    CHECK(tile_edge(600, 400) == 8);
    CHECK(tile_edge(16, 64) == 2);
    CHECK(tile_edge(4, 4) == 1);
}
