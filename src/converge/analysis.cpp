// From rows to conclusions.
#include "converge/analysis.h"

#include "converge/curve.h"
#include "converge/ratios.h"
#include "util/statistics.h"

#include <algorithm>
#include <cmath>

namespace etendue
{
namespace
{
// Estimates of the error from fewer samples are noise.
constexpr std::uint64_t LEAST_CALIBRATION_SAMPLES = 4;
constexpr double TOO_CONFIDENT = 1.0 / 1.1;

std::vector<CurvePoint> curve_of(const RunCurve& runs, double start_seconds, const std::vector<std::string>& metrics)
{
    std::vector<CurvePoint> curve;
    for (std::size_t k = 0; k < runs.points(); ++k) {
        CurvePoint point;
        const double n = static_cast<double>(runs.runs());
        for (std::size_t r = 0; r < runs.runs(); ++r) {
            const ErrorRow& row = runs.row(r, k);
            point.samples += static_cast<double>(row.samples) / n;
            point.render_seconds += row.render_seconds / n;
            point.kernel_seconds += row.kernel_seconds / n;
            point.mape += row.metrics.mape / n;
            point.max_relative = std::max(point.max_relative, row.metrics.max_relative);
            point.top_share += row.metrics.top_share / n;
        }
        point.total_seconds = start_seconds + point.render_seconds;
        point.mse = mean_interval(runs.values(k, "mse"));
        point.relmse = mean_interval(runs.values(k, "relmse"));
        for (const std::string& metric : metrics) point.shown[metric] = mean_interval(runs.values(k, metric));
        point.usable = runs.usable(k);
        curve.push_back(point);
    }
    return curve;
}

Interval crossing_band(const RunCurve& runs, const std::vector<Draw>& draws, const Target& target, double start)
{
    const auto time = [&](const Draw& draw) {
        std::vector<double> seconds = runs.mean_seconds(draw);
        for (double& t : seconds) t += start;
        const Crossing crossing = find_crossing(seconds, runs.mean(draw, target.metric), target.value);
        return crossing.kind == Crossing::Kind::not_reached ? std::numeric_limits<double>::quiet_NaN() : crossing.x;
    };
    return bootstrap_ratio_interval(time, draws);
}

// Where the last checkpoints say nothing, nor does a target that was not reached before.
Crossing known_crossing(Crossing crossing, const RunCurve& runs)
{
    const bool ends_early = runs.points() > 0 && !runs.usable(runs.points() - 1);
    if (crossing.kind == Crossing::Kind::not_reached && ends_early) crossing.kind = Crossing::Kind::unknown;
    return crossing;
}

TargetTime target_time(const RunCurve& runs, const std::vector<Draw>& draws, const Target& target, double start)
{
    TargetTime time;
    time.target = target;
    const Draw all = everyone(runs.runs());
    std::vector<double> seconds = runs.mean_seconds(all);
    const std::vector<double> errors = runs.mean(all, target.metric);
    time.render = known_crossing(find_crossing(seconds, errors, target.value), runs);
    time.render_band = crossing_band(runs, draws, target, 0.0);
    for (double& t : seconds) t += start;
    time.total = known_crossing(find_crossing(seconds, errors, target.value), runs);
    time.total_band = crossing_band(runs, draws, target, start);
    return time;
}

Calibration calibration_of(const std::vector<double>& ratios)
{
    Calibration calibration;
    calibration.count = ratios.size();
    calibration.median = quantile(ratios, 0.5);
    calibration.low = quantile(ratios, 0.05);
    calibration.high = quantile(ratios, 0.95);
    const auto below = std::count_if(ratios.begin(), ratios.end(), [](double r) { return r < TOO_CONFIDENT; });
    calibration.too_confident = static_cast<double>(below) / static_cast<double>(ratios.size());
    return calibration;
}

std::vector<CalibrationRow> calibrate(const RunCurve& runs)
{
    std::vector<CalibrationRow> rows;
    std::vector<double> all;
    for (std::size_t k = 0; k < runs.points(); ++k) {
        std::vector<double> ratios;
        for (std::size_t r = 0; r < runs.runs(); ++r) {
            const ErrorRow& row = runs.row(r, k);
            const double ratio = row.film_error / std::sqrt(row.relmse);
            if (runs.usable(k) && row.samples >= LEAST_CALIBRATION_SAMPLES && std::isfinite(ratio))
                ratios.push_back(ratio);
        }
        if (ratios.empty()) continue;
        rows.push_back({static_cast<double>(runs.row(0, k).samples), calibration_of(ratios)});
        all.insert(all.end(), ratios.begin(), ratios.end());
    }
    if (!all.empty()) rows.push_back({0.0, calibration_of(all)});
    return rows;
}

// The floor under the mean curve, and under those of drawn seeds.
struct DrawnFits {
    FloorFit all;
    std::vector<double> floors;
};

DrawnFits fit_draws(const RunCurve& runs, const std::vector<Draw>& draws)
{
    const auto fit = [&](const Draw& draw) { return fit_floor(runs.mean_samples(draw), runs.mean(draw, "mse")); };
    DrawnFits fits;
    fits.all = fit(everyone(runs.runs()));
    for (const Draw& draw : draws) fits.floors.push_back(fit(draw).b);
    return fits;
}

void set_variance_of_mean(ConfigurationAnalysis& analysis, const StudiedConfiguration& studied)
{
    RunningStatistics channels[3];
    double by_film = 0.0, count = 0.0;
    for (const Run& run : studied.runs) {
        if (!run.measurement.complete) continue;
        for (int c = 0; c < 3; ++c) channels[c].add(run.picture_mean[c]);
        by_film += run.rows.back().var_mean;
        count += 1.0;
    }
    analysis.variance_of_mean = (channels[0].variance() + channels[1].variance() + channels[2].variance()) / 3.0;
    analysis.variance_of_mean_by_film = by_film / count;
}

BiasEvidence evidence_of(const StudiedConfiguration& studied, const ConfigurationAnalysis& analysis)
{
    BiasEvidence evidence;
    evidence.reference = studied.reference.get();
    evidence.width = studied.prepared.scene.film.width;
    evidence.height = studied.prepared.scene.film.height;
    evidence.pool = &studied.pool;
    evidence.independent_samples = studied.prepared.scene.sampler.type == SamplerType::independent;
    for (const CurvePoint& point : analysis.curve)
        if (point.usable) evidence.last_mse = point.mse.estimate;
    for (const Run& run : studied.runs) {
        for (const ErrorRow& row : run.rows)
            evidence.largest_mse = std::isnan(row.metrics.mse) ? std::numeric_limits<double>::infinity()
                                                               : std::max(evidence.largest_mse, row.metrics.mse);
        if (run.measurement.complete) {
            evidence.picture_means.push_back(run.picture_mean);
            evidence.picture_variances.push_back(run.picture_variance);
        }
        evidence.accidents += run.rows.back().accidents;
        if (evidence.replay.empty()) evidence.replay = run.replay;
        const BadValues& bad = run.rows.back().bad;
        evidence.bad_values += bad.nan + bad.infinite + bad.negative;
    }
    return evidence;
}

ConfigurationAnalysis analyse_configuration(const StudiedConfiguration& studied, const RunCurve& runs,
                                            const StudyOptions& options, const VerdictLevels& levels)
{
    ConfigurationAnalysis analysis;
    analysis.name = studied.prepared.configuration.name;
    if (runs.points() == 0) {
        analysis.verdict.reasons.emplace_back("No run reached a checkpoint.");
        return analysis;
    }
    const std::vector<Draw> draws = bootstrap_draws(runs.runs(), options.draws);
    const DrawnFits fits = fit_draws(runs, draws);
    const double floor_error = studied.reference->floor_error;
    analysis.curve = curve_of(runs, studied.cold.total(), options.metrics);
    analysis.slope_samples = mean_interval(runs.slopes(false));
    analysis.slope_seconds = mean_interval(runs.slopes(true));
    analysis.fit = fits.all;
    analysis.floor = bootstrap_t_interval(fits.all.b, fits.floors, runs.runs(), 0.95, floor_error);
    analysis.efficiency = bootstrap_ratio_interval([&](const Draw& draw) { return runs.efficiency(draw); }, draws);
    for (const Target& target : options.targets)
        analysis.targets.push_back(target_time(runs, draws, target, studied.cold.total()));
    analysis.top_share = analysis.curve.back().top_share;
    analysis.calibration = calibrate(runs);
    set_variance_of_mean(analysis, studied);
    BiasEvidence evidence = evidence_of(studied, analysis);
    evidence.floor = bootstrap_t_interval(fits.all.b, fits.floors, runs.runs(), 1.0 - levels.test_alpha, floor_error);
    evidence.slope = mean_interval(runs.slopes(false), 1.0 - levels.test_alpha);
    analysis.verdict = judge_bias(evidence, levels);
    return analysis;
}
} // namespace

std::vector<const Run*> counted_runs(const StudiedConfiguration& studied)
{
    std::vector<const Run*> runs;
    for (const Run& run : studied.runs)
        if (run.measurement.complete) runs.push_back(&run);
    if (runs.empty())
        for (const Run& run : studied.runs) runs.push_back(&run);
    return runs;
}

Analysis analyse(const Study& study)
{
    Analysis analysis;
    analysis.bench_passed = passed(study.self_check);
    analysis.test_alpha = sidak_alpha(study.options.family_alpha,
                                      TESTS_OF_VERDICT * std::max<std::size_t>(study.configurations.size(), 1));
    std::vector<RunCurve> curves;
    for (const StudiedConfiguration& studied : study.configurations) {
        curves.emplace_back(counted_runs(studied), studied.reference ? studied.reference->floor : 0.0);
        analysis.configurations.push_back(
            analyse_configuration(studied, curves.back(), study.options, {analysis.test_alpha, study.options.delta}));
    }
    analysis.ratios = ratio_matrix(analysis.configurations, curves, study.options);
    return analysis;
}

bool Analysis::bad() const
{
    return !bench_passed ||
           std::any_of(configurations.begin(), configurations.end(), [](const ConfigurationAnalysis& configuration) {
               const BiasResult result = configuration.verdict.result;
               return result == BiasResult::biased || result == BiasResult::failed;
           });
}
} // namespace etendue
