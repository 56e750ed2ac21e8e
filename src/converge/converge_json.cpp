// Values by jsoncpp; what is not finite is null.
#include "converge/converge_json.h"

#include "converge/analysis_json.h"
#include "converge/errors_csv.h"
#include "render/report.h"
#include "util/revision.h"

#include <json/value.h>
#include <json/writer.h>

namespace etendue
{
namespace
{
Json::Value text(const std::string& x)
{
    return Json::Value(x);
}

Json::Value machine_json(const MachineState& state)
{
    Json::Value json;
    json["load_average"] = json_number(state.load_average);
    json["median_mhz"] = json_number(state.median_mhz);
    json["least_mhz"] = json_number(state.least_mhz);
    return json;
}

Json::Value reference_json(const Reference& reference)
{
    static const char* const kinds[] = {"none", "analytic", "file", "independent"};
    Json::Value json;
    json["kind"] = kinds[static_cast<int>(reference.kind)];
    json["description"] = reference.description;
    json["samples_per_pixel"] = json_number(reference.samples);
    json["wanted_samples_per_pixel"] = json_number(reference.wanted_samples);
    json["seconds"] = json_number(reference.seconds);
    json["from_cache"] = reference.from_cache;
    json["variance"] = json_number(reference.floor);
    json["variance_error"] = json_number(reference.floor_error);
    json["skewness"] = json_number(reference.skewness);
    json["variance_by_replicates_over_by_film"] = json_number(reference.replicate_ratio);
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
        entry["seed"] = json_number(run.seed);
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

Json::Value canaries_json(const StudiedConfiguration& studied)
{
    Json::Value json(Json::arrayValue);
    if (studied.runs.empty()) return json;
    for (const DeviceReport& device : studied.runs.back().measurement.report.devices)
        json.append(canary_json(device.canary));
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
    json["canaries"] = canaries_json(studied);
    if (studied.reference) json["reference"] = reference_json(*studied.reference);
    json["cold_start_seconds"] = start_json(studied.cold);
    json["runs"] = runs_json(studied);
    set_analysis(json, analysis);
    return json;
}

Json::Value self_check_json(const Study& study)
{
    Json::Value json(Json::arrayValue);
    for (const SelfCheckResult& result : study.self_check) {
        Json::Value entry;
        entry["name"] = result.name;
        entry["expected"] = result.expected;
        entry["found"] = json_number(result.found);
        entry["standard_error"] = json_number(result.standard_error);
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
    json["revision"] = REVISION;
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
    json["seeds"] = json_number(options.seeds);
    json["first_seed"] = json_number(options.first_seed);
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
