// The report as JSON.
#include "render/report.h"

#include "scene/scene_tables.h"
#include "util/revision.h"

#include <json/json.h>

#include <cmath>
#include <sstream>

#include <fmt/format.h>

namespace etendue
{
namespace
{
Json::Value number(std::uint64_t n)
{
    return Json::Value(static_cast<Json::UInt64>(n));
}

// JSON has no infinity: null says "not known".
Json::Value finite_or_null(double x)
{
    return std::isfinite(x) ? Json::Value(x) : Json::Value();
}

Json::Value seconds_json(const Phases& phases)
{
    Json::Value json(Json::objectValue);
    for (const auto& [name, seconds] : phases) json[name] = json.get(name, 0.0).asDouble() + seconds;
    return json;
}

std::string sampler_name(const SamplerDescription& sampler)
{
    return sampler_table().variant_names().at(static_cast<std::size_t>(sampler.type));
}

Json::Value scene_json(const Scene& scene, const Geometry& geometry)
{
    Json::Value json;
    json["file"] = scene.file;
    json["sha256"] = scene.sha256;
    json["format"] = scene.course_format ? "course" : "native";
    json["triangles"] = geometry.triangle_count;
    json["spheres"] = geometry.sphere_count;
    json["disks"] = geometry.disk_count;
    json["lights"] = number(geometry.lights.size());
    json["materials"] = number(geometry.materials.size());
    json["mesh_bytes"] = number(geometry.statistics.mesh_bytes);
    json["dropped_triangles"] = number(geometry.statistics.dropped_triangles);
    json["normalisation"]["scale"] = geometry.normalisation.scale;
    for (int axis = 0; axis < 3; ++axis) json["normalisation"]["centre"].append(geometry.normalisation.centre[axis]);
    return json;
}

Json::Value bvh_json(const BvhStatistics& bvh)
{
    Json::Value json;
    json["primitives"] = bvh.primitive_count;
    json["nodes"] = bvh.node_count;
    json["leaves"] = bvh.leaf_count;
    json["depth"] = bvh.depth;
    json["sah_cost"] = finite_or_null(bvh.sah_cost);
    json["built_on"] = bvh.built_on_device ? "device" : "host";
    json["seconds"] = seconds_json(bvh.phases);
    return json;
}

Json::Value build_json(const BuildReport& build)
{
    Json::Value json;
    json["program"] = build.program;
    json["options"] = build.options;
    json["seconds"] = build.seconds;
    json["from_cache"] = build.from_cache;
    json["stored_in_cache"] = build.stored;
    json["source_bytes"] = number(build.source_bytes);
    json["binary_bytes"] = number(build.binary_bytes);
    if (!build.log.empty()) json["log"] = build.log;
    return json;
}

Json::Value features_json(const Specialization& s)
{
    Json::Value json(Json::objectValue);
    json["in"] = json["out"] = Json::Value(Json::arrayValue);
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(Feature::COUNT); ++i)
        json[s.has(static_cast<Feature>(i)) ? "in" : "out"].append(feature_descriptions()[i].name);
    return json;
}

Json::Value memory_json(const DeviceReport& device)
{
    Json::Value json;
    json["peak_bytes"] = number(device.memory.peak);
    json["global_bytes"] = number(device.info.global_memory);
    json["max_allocation_bytes"] = number(device.info.max_allocation);
    for (const auto& [name, bytes] : device.memory.buffers) {
        Json::Value buffer;
        buffer["name"] = name;
        buffer["bytes"] = number(bytes);
        json["buffers"].append(buffer);
    }
    return json;
}

Json::Value device_json(const DeviceReport& device)
{
    Json::Value json;
    json["name"] = device.info.name;
    json["platform"] = device.info.platform_name;
    json["platform_version"] = device.info.platform_version;
    json["driver_version"] = device.info.driver_version;
    json["device_version"] = device.info.device_version;
    json["type"] = device.info.type;
    json["compute_units"] = device.compute_units;
    json["lanes"] = device.specialization.lanes;
    json["stack_size"] = device.specialization.stack_size;
    json["features"] = features_json(device.specialization);
    json["samples"] = number(device.samples);
    json["launches"] = number(device.units);
    json["seconds"]["upload"] = device.upload_seconds;
    json["seconds"]["bvh"] = device.bvh_seconds;
    json["seconds"]["compile"] = device.compile_seconds;
    json["seconds"]["first_launch"] = device.first_launch_seconds;
    json["seconds"]["render"] = device.render_seconds;
    json["seconds"]["canary"] = device.canary.seconds;
    json["canary"] = canary_json(device.canary);
    json["seconds"]["kernel"] = device.kernel_seconds;
    for (const BuildReport& build : device.builds) json["builds"].append(build_json(build));
    json["bvh"] = bvh_json(device.bvh);
    json["memory"] = memory_json(device);
    return json;
}

Json::Value health_json(const RenderReport& report)
{
    Json::Value json(Json::objectValue);
    for (std::size_t kind = 0; kind < HEALTH_KINDS; ++kind) {
        const HealthRecord& record = report.health[kind];
        Json::Value entry;
        entry["count"] = number(record.count);
        if (record.first) {
            entry["first"]["pixel"].append(record.first->x);
            entry["first"]["pixel"].append(record.first->y);
            entry["first"]["sample"] = number(record.first->sample);
            entry["first"]["vertex"] = record.first->vertex;
            entry["replay"] = record.replay;
        }
        json[health_name(kind)] = entry;
    }
    return json;
}

Json::Value target_json(const ErrorTarget::Report& target)
{
    Json::Value json;
    json["wanted"] = target.wanted;
    json["reached"] = target.reached;
    json["looks"] = number(target.looks);
    json["confidence"] = target.confidence;
    json["relative_error"] = finite_or_null(target.error.relative_error);
    json["low"] = finite_or_null(target.error.low);
    json["high"] = finite_or_null(target.error.high);
    json["top_share"] = target.error.top_share;
    json["heavy_tail"] = target.error.heavy_tail();
    return json;
}

Json::Value rays_json(const RenderReport& report)
{
    Json::Value json;
    json["camera"] = number(report.counts[COUNT_CAMERA_RAYS]);
    json["indirect"] = number(report.counts[COUNT_INDIRECT_RAYS]);
    json["shadow"] = number(report.counts[COUNT_SHADOW_RAYS]);
    json["total"] = number(report.rays());
    json["per_second"] = report.rays_per_second();
    json["busy_lanes"] = report.busy_lanes();
    return json;
}
} // namespace

Json::Value canary_json(const CanaryReport& canary)
{
    Json::Value json;
    json["passed"] = canary.passed;
    json["from_cache"] = canary.from_cache;
    json["seconds"] = canary.seconds;
    json["findings"] = Json::Value(Json::arrayValue);
    for (const CanaryFinding& finding : canary.findings) {
        Json::Value entry;
        entry["name"] = finding.name;
        entry["passed"] = finding.passed;
        entry["detail"] = finding.detail;
        json["findings"].append(entry);
    }
    return json;
}

std::string report_json(const Scene& scene, const Geometry& geometry, const RenderReport& report, const Phases& phases,
                        double relative_error, const std::string& command,
                        const std::optional<ErrorTarget::Report>& target)
{
    Json::Value json;
    json["etendue"] = ETENDUE_VERSION;
    json["revision"] = REVISION;
    json["command"] = command;
    json["scene"] = scene_json(scene, geometry);
    json["sampler"] = sampler_name(scene.sampler);
    json["seed"] = number(scene.sampler.seed);
    json["samples_per_pixel"] = number(report.samples_per_pixel);
    json["interrupted"] = report.interrupted;
    json["relative_error"] = finite_or_null(relative_error);
    json["error_estimate"] = name_of(report.error_estimate);
    if (target) json["error_target"] = target_json(*target);
    json["accelerator"] = report.accelerator == ACCELERATOR_LBVH ? "lbvh" : "none";
    json["precision"] = precision_name(report.precision);
    json["fast_math"] = report.fast_math;
    json["seconds"] = seconds_json(phases);
    json["rays"] = rays_json(report);
    json["health"] = health_json(report);
    for (const DeviceReport& device : report.devices) json["devices"].append(device_json(device));
    json["warnings"] = Json::Value(Json::arrayValue);
    for (const std::string& warning : report.warnings) json["warnings"].append(warning);
    for (const std::string& warning : geometry.warnings) json["warnings"].append(warning);
    Json::StreamWriterBuilder writer;
    writer["indentation"] = "  ";
    writer["precision"] = 17;
    return Json::writeString(writer, json) + "\n";
}

std::map<std::string, std::string> image_metadata(const Scene& scene, const RenderReport& report, const Phases& phases)
{
    std::map<std::string, std::string> metadata;
    metadata["etendue:version"] = ETENDUE_VERSION;
    metadata["etendue:revision"] = REVISION;
    metadata["etendue:scene"] = scene.file;
    metadata["etendue:scene_sha256"] = scene.sha256;
    metadata["etendue:sampler"] = sampler_name(scene.sampler);
    metadata["etendue:error_estimate"] = name_of(report.error_estimate);
    metadata["etendue:seed"] = std::to_string(scene.sampler.seed);
    metadata["etendue:spp"] = std::to_string(report.samples_per_pixel);
    metadata["etendue:interrupted"] = report.interrupted ? "yes" : "no";
    metadata["etendue:precision"] = precision_name(report.precision);
    std::string devices, drivers, seconds;
    for (const DeviceReport& device : report.devices) {
        devices += (devices.empty() ? "" : ", ") + device.info.name;
        drivers += (drivers.empty() ? "" : ", ") + device.info.platform_version + " / " + device.info.driver_version;
    }
    for (const auto& [name, time] : phases)
        seconds += fmt::format("{}{} {:.6f}", seconds.empty() ? "" : ", ", name, time);
    metadata["etendue:device"] = devices;
    metadata["etendue:driver"] = drivers;
    metadata["etendue:seconds"] = seconds;
    if (report.fast_math) metadata["etendue:fast_math"] = "yes: relaxed floating point, the picture may be wrong";
    metadata["etendue:accidents"] = std::to_string(report.accidents());
    return metadata;
}
} // namespace etendue
