// Curves, slopes, times, ratios and calibration of studies whose truth is known.
#include "converge/analysis.h"

#include "converge/ratios.h"
#include "synthetic_study.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace etendue;

TEST_CASE("independent samples have slope -1, no floor and the efficiency they were made with", "[converge]")
{
    const ConfigurationAnalysis analysis = analysis_of({}, 3);
    REQUIRE(analysis.curve.size() == 9);
    CHECK(analysis.slope_samples.contains(-1.0));
    CHECK(analysis.slope_seconds.contains(-1.0));
    CHECK(analysis.slope_samples.high - analysis.slope_samples.low < 0.1);
    CHECK(analysis.floor.contains(0.0));
    double squares = 0.0;
    for (std::size_t i = 0; i < 256; ++i) squares += true_value(i) * true_value(i) / 256;
    CHECK(analysis.efficiency.contains(1.0 / (0.25 * squares * 1e-3)));
    CHECK(analysis.curve[3].total_seconds == Approx(2.0 + 8e-3));
    // Independent pixels: the mean spreads as the films say.
    CHECK(analysis.variance_of_mean / analysis.variance_of_mean_by_film == Approx(1.0).epsilon(0.8));
}

TEST_CASE("intervals of slopes hold -1 as often as they say", "[converge]")
{
    SyntheticOptions options;
    options.width = options.height = 8;
    options.seeds = 5;
    int missed = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) missed += !analysis_of(options, seed).slope_samples.contains(-1.0);
    // 5 % of 200 within four standard deviations.
    CHECK(missed <= 22);
}

TEST_CASE("times to targets lie where the law says", "[converge]")
{
    // relMSE = 0.25 / N and 1 ms per sample: 0.1 at 2.5 ms, 0.01 at 25 ms, 1e-3 at 250 ms, beyond 256 samples never.
    Study study = synthetic_study({}, 3);
    study.options.targets.push_back({"relmse", 1e-4});
    study.options.targets.push_back({"relmse", 10.0});
    const std::vector<TargetTime> targets = analyse(study).configurations[0].targets;
    REQUIRE(targets.size() == 5);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(targets[i].render.kind == Crossing::Kind::at);
        CHECK(targets[i].render.x == Approx(2.5e-3 * std::pow(10.0, double(i))).epsilon(0.05));
        CHECK(targets[i].total.x > 2.0);
        CHECK(targets[i].total.x < 2.5);
    }
    CHECK(targets[1].render_band.contains(25e-3));
    CHECK(targets[3].render.kind == Crossing::Kind::not_reached);
    CHECK(targets[4].render.kind == Crossing::Kind::before_first);
}

TEST_CASE("a configuration that takes twice the time is half as good", "[converge]")
{
    SyntheticOptions options;
    SyntheticScene scene(options, 3);
    Study study = synthetic_study(options, 4);
    options.seconds_per_sample *= 2;
    study.configurations.push_back(SyntheticScene(options, 5).run("slow", scene.reference()));
    const Analysis analysis = analyse(study);
    REQUIRE(analysis.ratios.size() == 2);
    CHECK(analysis.ratios[0][1].value.contains(2.0));
    CHECK(analysis.ratios[1][0].value.contains(0.5));
    CHECK(analysis.ratios[0][1].value.high - analysis.ratios[0][1].value.low < 0.5);
    CHECK_FALSE(analysis.ratios[0][1].target.has_value());
    CHECK(analysis.ratios[0][0].value.estimate == 1.0);
}

TEST_CASE("where slopes differ, times to a target are compared", "[converge]")
{
    SyntheticOptions options;
    SyntheticScene scene(options, 3);
    Study study = synthetic_study(options, 4);
    study.configurations.push_back(scene.run("steep", scene.reference()));
    for (Run& run : study.configurations[1].runs)
        for (ErrorRow& row : run.rows) {
            const double factor = std::pow(static_cast<double>(row.samples), -0.5);
            row.mse *= factor;
            row.relmse *= factor;
        }
    const Analysis analysis = analyse(study);
    REQUIRE(analysis.ratios[1][0].target);
    CHECK(analysis.ratios[1][0].target->value == 1e-3);
    // 0.25 N^-1.5 = 1e-3 at 39.7 samples, 0.25 / N at 250.
    CHECK(analysis.ratios[1][0].value.estimate == Approx(250 / 39.7).epsilon(0.1));
    CHECK(slopes_differ({-1.5, -1.6, -1.4}, {-1.0, -1.1, -0.9}));
    CHECK_FALSE(slopes_differ({-1.02, -1.03, -1.01}, {-1.0, -1.005, -0.995}));
}

TEST_CASE("errors too near to the reference's own are not used", "[converge]")
{
    // At N samples the measured MSE is v / N + v / 64: at least four times v / 64 up to N = 16 or so.
    SyntheticOptions options;
    options.reference_samples = 64.0;
    const ConfigurationAnalysis analysis = analysis_of(options, 3);
    CHECK(analysis.curve[3].usable);
    CHECK_FALSE(analysis.curve[5].usable);
    CHECK_FALSE(analysis.curve[8].usable);
    CHECK(analysis.slope_samples.contains(-1.0));
}

TEST_CASE("the film's estimate of its error is held against the true one", "[converge]")
{
    Study study = synthetic_study({}, 3);
    const std::vector<CalibrationRow> right = analyse(study).configurations[0].calibration;
    REQUIRE(right.size() == 8); // from 4 samples on, and all together
    CHECK(right.back().samples == 0.0);
    CHECK(right.back().calibration.count == 7 * 8);
    CHECK(right.back().calibration.median == Approx(1.0).epsilon(0.02));
    CHECK(right.back().calibration.too_confident < 0.05);
    for (Run& run : study.configurations[0].runs)
        for (ErrorRow& row : run.rows) row.film_error *= 0.5;
    const Calibration wrong = analyse(study).configurations[0].calibration.back().calibration;
    CHECK(wrong.median == Approx(0.5).epsilon(0.02));
    CHECK(wrong.too_confident == 1.0);
}

TEST_CASE("a study that was interrupted is analysed as far as it went", "[converge]")
{
    Study study = synthetic_study({}, 3);
    std::vector<Run>& runs = study.configurations[0].runs;
    runs.resize(3);
    runs[2].rows.resize(4);
    runs[2].measurement.complete = false;
    CHECK(analyse(study).configurations[0].curve.size() == 9);
    runs.erase(runs.begin(), runs.begin() + 2);
    CHECK(analyse(study).configurations[0].curve.size() == 4);
    runs.clear();
    CHECK(analyse(study).configurations[0].curve.empty());
}
