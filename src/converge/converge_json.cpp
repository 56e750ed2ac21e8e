// Values by jsoncpp; what is not finite is null.
#include "converge/converge_json.h"

#include "converge/errors_csv.h"

#include <cmath>

#include <json/value.h>
#include <json/writer.h>

namespace etendue
{
namespace
{
Json::Value number(std::uint64_t x)
{
    return Json::Value(static_cast<Json::UInt64>(x));
}

Json::Value number(double x)
{
    return std::isfinite(x) ? Json::Value(x) : Json::Value();
}

Json::Value text(const std::string& x)
{
    return Json::Value(x);
}

Json::Value interval_json(const Interval& interval)
{
    Json::Value json;
    json["estimate"] = number(interval.estimate);
    json["low"] = number(interval.low);
    json["high"] = number(interval.high);
    return json;
}

Json::Value machine_json(const MachineState& state)
{
    Json::Value json;
    json["load_average"] = number(state.load_average);
    json["median_mhz"] = number(state.median_mhz);
    json["least_mhz"] = number(state.least_mhz);
    return json;
}

Json::Value reference_json(const Reference& reference)
{
    static const char* const kinds[] = {"none", "analytic", "file", "independent"};
    Json::Value json;
    json["kind"] = kinds[static_cast<int>(reference.kind)];
    json["description"] = reference.description;
    json["samples_per_pixel"] = number(reference.samples);
    json["wanted_samples_per_pixel"] = number(reference.wanted_samples);
    json["seconds"] = number(reference.seconds);
    json["from_cache"] = reference.from_cache;
    json["variance"] = number(reference.floor);
    json["variance_error"] = number(reference.floor_error);
    json["variance_by_replicates_over_by_film"] = number(reference.replicate_ratio);
    return json;
}

Json::Value start_json(const StartSeconds& start)
{
    Json::Value json;
    json["load"] = start.load;
    json["geometry"] = start.geometry;
    json["open"] = start.open;
    json["upload"] = start.upload;
    json["bvh"] = start.bvh;
    json["compile"] = start.compile;
    json["first_launch"] = start.first_launch;
    json["total"] = start.total();
    return json;
}

Json::Value crossing_json(const Crossing& crossing, const Interval& band)
{
    static const char* const kinds[] = {"before the first checkpoint", "reached", "not reached"};
    Json::Value json;
    json["state"] = kinds[static_cast<int>(crossing.kind)];
    json["seconds"] = crossing.kind == Crossing::Kind::not_reached ? Json::Value() : number(crossing.x);
    json["low"] = number(band.low);
    json["high"] = number(band.high);
    return json;
}

Json::Value targets_json(const std::vector<TargetTime>& targets)
{
    Json::Value json(Json::arrayValue);
    for (const TargetTime& time : targets) {
        Json::Value entry;
        entry["metric"] = time.target.metric;
        entry["value"] = time.target.value;
        entry["render"] = crossing_json(time.render, time.render_band);
        entry["total"] = crossing_json(time.total, time.total_band);
        json.append(entry);
    }
    return json;
}

Json::Value curve_json(const std::vector<CurvePoint>& curve)
{
    Json::Value json(Json::arrayValue);
    for (const CurvePoint& point : curve) {
        Json::Value entry;
        entry["spp"] = point.samples;
        entry["t_render"] = point.render_seconds;
        entry["t_total"] = point.total_seconds;
        entry["t_kernel"] = point.kernel_seconds;
        entry["mse"] = interval_json(point.mse);
        entry["relmse"] = interval_json(point.relmse);
        entry["mape"] = number(point.mape);
        entry["max_share"] = number(point.top_share);
        entry["usable"] = point.usable;
        json.append(entry);
    }
    return json;
}

Json::Value calibration_json(const std::vector<CalibrationRow>& rows)
{
    Json::Value json(Json::arrayValue);
    for (const auto& [samples, calibration] : rows) {
        Json::Value entry;
        entry["spp"] = samples > 0.0 ? Json::Value(samples) : Json::Value("all");
        entry["count"] = number(std::uint64_t{calibration.count});
        entry["median"] = number(calibration.median);
        entry["low"] = number(calibration.low);
        entry["high"] = number(calibration.high);
        entry["too_confident"] = number(calibration.too_confident);
        json.append(entry);
    }
    return json;
}

Json::Value verdict_json(const BiasVerdict& verdict)
{
    Json::Value json;
    json["result"] = bias_result_name(verdict.result);
    json["reasons"] = Json::Value(Json::arrayValue);
    for (const std::string& reason : verdict.reasons) json["reasons"].append(reason);
    json["exact"] = verdict.exact;
    json["floor"] = interval_json(verdict.floor);
    json["floor"]["passed"] = verdict.floor_passed;
    json["tiles"]["edge"] = verdict.tile;
    json["tiles"]["p_value"] = number(verdict.tile_p_value);
    json["tiles"]["uniform_p_value"] = number(verdict.uniform_p_value);
    json["tiles"]["worst_z"] = number(verdict.worst_tile_z);
    json["tiles"]["passed"] = verdict.tiles_passed;
    json["mean"]["relative_error"] = number(verdict.mean_error);
    json["mean"]["z"] = number(verdict.z);
    json["mean"]["critical"] = number(verdict.critical);
    json["mean"]["detectable_bias"] = number(verdict.detectable_bias);
    json["mean"]["passed"] = verdict.mean_passed;
    return json;
}

Json::Value devices_json(const StudiedConfiguration& studied)
{
    Json::Value json(Json::arrayValue);
    for (const DeviceInfo& device : studied.prepared.options.devices) {
        Json::Value entry;
        entry["name"] = device.name;
        entry["platform"] = device.platform_version;
        entry["driver"] = device.driver_version;
        entry["version"] = device.device_version;
        entry["compute_units"] = device.compute_units;
        json.append(entry);
    }
    return json;
}

Json::Value runs_json(const StudiedConfiguration& studied)
{
    Json::Value json(Json::arrayValue);
    for (const Run& run : studied.runs) {
        Json::Value entry;
        entry["seed"] = number(run.seed);
        entry["complete"] = run.measurement.complete;
        entry["seconds"] = start_json(run.measurement.start);
        entry["seconds"]["render"] = run.measurement.render_seconds;
        entry["seconds"]["looking"] = run.measurement.look_seconds;
        json.append(entry);
    }
    return json;
}

Json::Value build_options_json(const StudiedConfiguration& studied)
{
    Json::Value json(Json::objectValue);
    for (const Run& run : studied.runs)
        for (const DeviceReport& device : run.measurement.report.devices)
            for (const BuildReport& build : device.builds) json[build.program] = build.options;
    return json;
}

Json::Value configuration_json(const StudiedConfiguration& studied, const ConfigurationAnalysis& analysis)
{
    Json::Value json;
    json["name"] = analysis.name;
    json["definition"] = studied.prepared.configuration.text();
    json["scene_sha256"] = studied.prepared.scene.sha256;
    json["picture_key"] = picture_key(studied.prepared);
    json["devices"] = devices_json(studied);
    json["build_options"] = build_options_json(studied);
    if (studied.reference) json["reference"] = reference_json(*studied.reference);
    json["cold_start_seconds"] = start_json(studied.cold);
    json["runs"] = runs_json(studied);
    json["curve"] = curve_json(analysis.curve);
    json["slope"]["on_spp"] = interval_json(analysis.slope_samples);
    json["slope"]["on_render_seconds"] = interval_json(analysis.slope_seconds);
    json["fit"]["a"] = number(analysis.fit.a);
    json["fit"]["p"] = interval_json(analysis.exponent);
    json["fit"]["b"] = interval_json(analysis.floor);
    json["targets"] = targets_json(analysis.targets);
    json["efficiency"] = interval_json(analysis.efficiency);
    json["max_share"] = number(analysis.top_share);
    json["variance_of_mean"]["between_seeds"] = number(analysis.variance_of_mean);
    json["variance_of_mean"]["by_film"] = number(analysis.variance_of_mean_by_film);
    json["film_error_over_true_error"] = calibration_json(analysis.calibration);
    json["verdict"] = verdict_json(analysis.verdict);
    return json;
}

Json::Value ratios_json(const Analysis& analysis)
{
    Json::Value json(Json::arrayValue);
    for (std::size_t i = 0; i < analysis.ratios.size(); ++i)
        for (std::size_t j = 0; j < analysis.ratios.size(); ++j) {
            if (i == j) continue;
            const Ratio& ratio = analysis.ratios[i][j];
            Json::Value entry = interval_json(ratio.value);
            entry["better"] = analysis.configurations[i].name;
            entry["than"] = analysis.configurations[j].name;
            entry["of"] = ratio.target ? "time to target" : "efficiency";
            if (ratio.target) entry["target"][ratio.target->metric] = ratio.target->value;
            json.append(entry);
        }
    return json;
}

Json::Value self_check_json(const Study& study)
{
    Json::Value json(Json::arrayValue);
    for (const SelfCheckResult& result : study.self_check) {
        Json::Value entry;
        entry["name"] = result.name;
        entry["expected"] = result.expected;
        entry["found"] = number(result.found);
        entry["standard_error"] = number(result.standard_error);
        entry["passed"] = result.passed;
        json.append(entry);
    }
    return json;
}
} // namespace

std::string converge_json(const Study& study, const Analysis& analysis)
{
    const StudyOptions& options = study.options;
    Json::Value json;
    json["etendue"] = ETENDUE_VERSION;
    json["command"] = options.command;
    json["interrupted"] = study.interrupted;
    json["seconds"] = study.seconds;
    json["host"]["processor"] = text(study.before.processor);
    json["host"]["before"] = machine_json(study.before);
    json["host"]["after"] = machine_json(study.after);
    if (!study.configurations.empty()) {
        const Scene& scene = study.configurations.front().prepared.scene;
        json["scene"]["file"] = scene.file;
        json["scene"]["sha256"] = scene.sha256;
        json["scene"]["size"].append(scene.film.width);
        json["scene"]["size"].append(scene.film.height);
    }
    json["checkpoints"] = options.checkpoints.text();
    json["seeds"] = number(options.seeds);
    json["first_seed"] = number(options.first_seed);
    json["metrics"]["relative_epsilon"] = options.metric_settings.relative_epsilon;
    json["metrics"]["share_of_worst_pixels"] = options.metric_settings.trimmed_share;
    for (const auto& [name, meaning] : csv_columns()) json["columns"][name] = meaning;
    json["verdict_levels"]["family_alpha"] = options.family_alpha;
    json["verdict_levels"]["test_alpha"] = analysis.test_alpha;
    json["verdict_levels"]["delta"] = options.delta;
    json["bench_self_check"] = self_check_json(study);
    json["bench_passed"] = analysis.bench_passed;
    json["configurations"] = Json::Value(Json::arrayValue);
    for (std::size_t i = 0; i < study.configurations.size(); ++i)
        json["configurations"].append(configuration_json(study.configurations[i], analysis.configurations[i]));
    json["ratios"] = ratios_json(analysis);
    json["warnings"] = Json::Value(Json::arrayValue);
    for (const std::string& warning : study.warnings) json["warnings"].append(warning);
    Json::StreamWriterBuilder writer;
    writer["indentation"] = "  ";
    writer["precision"] = 17;
    return Json::writeString(writer, json) + "\n";
}
} // namespace etendue
