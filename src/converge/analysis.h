// What the errors of a study say: curves with bands, slopes, times to a target, efficiency, verdicts.
#pragma once

#include "converge/fit.h"
#include "converge/interval.h"
#include "converge/study.h"
#include "converge/verdict.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace etendue
{
// A checkpoint over the seeds.
struct CurvePoint {
    double samples = 0.0;
    double render_seconds = 0.0; // mean
    double total_seconds = 0.0;  // with the cold start
    double kernel_seconds = 0.0;
    Interval mse, relmse;                  // means, the reference's variance subtracted
    std::map<std::string, Interval> shown; // of StudyOptions::metrics
    double mape = 0.0, max_relative = 0.0, top_share = 0.0;
    bool usable = false; // the measured MSE is at least FLOOR_MULTIPLE times the reference's variance
};
constexpr double FLOOR_MULTIPLE = 4.0;

// Seconds until the curve of a metric reaches a value.
struct TargetTime {
    Target target;
    Crossing render, total;
    Interval render_band, total_band; // 95 % over seeds; not known where not every draw reaches it
};

// The film's own estimate of its relative error over the error that there is: 1 is right, below 1 too confident.
struct Calibration {
    std::size_t count = 0;
    double median = 0.0, low = 0.0, high = 0.0; // quantiles .5, .05 and .95
    double too_confident = 0.0;                 // share of estimates below the true error by more than 10 %
};
// The same for one checkpoint's samples; the last is over all.
struct CalibrationRow {
    double samples = 0.0; // 0: all
    Calibration calibration;
};

struct ConfigurationAnalysis {
    std::string name;
    std::vector<CurvePoint> curve;
    Interval slope_samples, slope_seconds;
    FloorFit fit;
    Interval floor; // b of the fit; 95 %
    std::vector<TargetTime> targets;
    Interval efficiency; // 1 / (MSE * render seconds) at the last usable checkpoint
    double top_share = 0.0;
    double variance_of_mean = 0.0;         // of the picture's mean, between seeds
    double variance_of_mean_by_film = 0.0; // as the films estimate it: 1 where pixels are independent
    std::vector<CalibrationRow> calibration;
    BiasVerdict verdict;
};

// How much better the row's configuration is than the column's.
struct Ratio {
    Interval value;
    std::optional<Target> target; // set: times to it are compared, because the slopes differ
    bool known() const { return value.estimate == value.estimate; }
};

struct Analysis {
    std::vector<ConfigurationAnalysis> configurations;
    std::vector<std::vector<Ratio>> ratios;
    double test_alpha = 0.0; // of one test of a verdict
    bool bench_passed = false;

    // A configuration is biased or failed, or the bench is wrong.
    bool bad() const;
};

Analysis analyse(const Study& study);

// The runs that count: the complete ones, or what there is where none is.
std::vector<const Run*> counted_runs(const StudiedConfiguration& studied);
} // namespace etendue
