// Conclusions by jsoncpp.
#include "converge/analysis_json.h"

#include <cmath>

namespace etendue
{
namespace
{
Json::Value interval_json(const Interval& interval)
{
    Json::Value json;
    json["estimate"] = json_number(interval.estimate);
    json["low"] = json_number(interval.low);
    json["high"] = json_number(interval.high);
    return json;
}

Json::Value crossing_json(const Crossing& crossing, const Interval& band)
{
    static const char* const kinds[] = {"before the first checkpoint", "reached", "not reached",
                                        "unknown: too near to the reference's own error"};
    Json::Value json;
    json["state"] = kinds[static_cast<int>(crossing.kind)];
    json["seconds"] = crossing.kind == Crossing::Kind::at || crossing.kind == Crossing::Kind::before_first
                          ? json_number(crossing.x)
                          : Json::Value();
    json["low"] = json_number(band.low);
    json["high"] = json_number(band.high);
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
        entry["mape"] = json_number(point.mape);
        entry["max_share"] = json_number(point.top_share);
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
        entry["count"] = json_number(std::uint64_t{calibration.count});
        entry["median"] = json_number(calibration.median);
        entry["low"] = json_number(calibration.low);
        entry["high"] = json_number(calibration.high);
        entry["too_confident"] = json_number(calibration.too_confident);
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
    json["tiles"]["p_value"] = json_number(verdict.tile_p_value);
    json["tiles"]["uniform_p_value"] = json_number(verdict.uniform_p_value);
    json["tiles"]["worst_z"] = json_number(verdict.worst_tile_z);
    json["tiles"]["passed"] = verdict.tiles_passed;
    json["mean"]["relative_error"] = json_number(verdict.mean_error);
    json["mean"]["z"] = json_number(verdict.z);
    json["mean"]["critical"] = json_number(verdict.critical);
    json["mean"]["detectable_bias"] = json_number(verdict.detectable_bias);
    json["mean"]["passed"] = verdict.mean_passed;
    return json;
}

} // namespace

Json::Value json_number(std::uint64_t x)
{
    return Json::Value(static_cast<Json::UInt64>(x));
}

Json::Value json_number(double x)
{
    return std::isfinite(x) ? Json::Value(x) : Json::Value();
}

void set_analysis(Json::Value& json, const ConfigurationAnalysis& analysis)
{
    json["curve"] = curve_json(analysis.curve);
    json["slope"]["on_spp"] = interval_json(analysis.slope_samples);
    json["slope"]["on_render_seconds"] = interval_json(analysis.slope_seconds);
    json["fit"]["a"] = json_number(analysis.fit.a);
    json["fit"]["b"] = interval_json(analysis.floor);
    json["targets"] = targets_json(analysis.targets);
    json["efficiency"] = interval_json(analysis.efficiency);
    json["max_share"] = json_number(analysis.top_share);
    json["variance_of_mean"]["between_seeds"] = json_number(analysis.variance_of_mean);
    json["variance_of_mean"]["by_film"] = json_number(analysis.variance_of_mean_by_film);
    json["film_error_over_true_error"] = calibration_json(analysis.calibration);
    json["verdict"] = verdict_json(analysis.verdict);
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

} // namespace etendue
