// Results as JSON.
#include "check/check_json.h"

#include "check/table.h"
#include "render/report.h"
#include "util/revision.h"

#include <json/json.h>

#include <cmath>

namespace etendue
{
namespace
{
Json::Value finite_or_null(double x)
{
    return std::isfinite(x) ? Json::Value(x) : Json::Value();
}

Json::Value count_json(std::size_t n)
{
    return Json::Value(static_cast<Json::UInt64>(n));
}

const char* verdict_key(Verdict verdict)
{
    static const char* const names[] = {"passed", "failed", "underpowered", "not_covered"};
    return names[static_cast<std::size_t>(verdict)];
}

Json::Value result_json(const CheckResult& result)
{
    Json::Value json;
    json["group"] = result.group;
    json["name"] = result.name;
    json["verdict"] = verdict_key(result.verdict);
    json["note"] = result.note;
    if (result.verdict == Verdict::not_covered) return json;
    json["rule"] = rule_name(result.rule);
    json["expected"] = result.expected;
    json["found"] = result.found;
    json["statistic"] = finite_or_null(result.statistic);
    json["unit"] = result.unit;
    json["critical"] = finite_or_null(result.critical);
    json["detectable_bias"] = finite_or_null(result.detectable_bias);
    json["largest_share"] = finite_or_null(result.largest_share);
    json["seconds"] = result.seconds;
    return json;
}

Json::Value run_json(const RunResult& run)
{
    Json::Value json;
    json["device"]["name"] = run.device.name;
    json["device"]["platform"] = run.device.platform_name;
    json["device"]["platform_version"] = run.device.platform_version;
    json["device"]["driver_version"] = run.device.driver_version;
    json["device"]["version"] = run.device.device_version;
    json["device"]["correctly_rounded_divide"] = run.device.correctly_rounded_divide;
    json["device"]["double"] = run.device.has_double;
    json["canary"] = run.canary ? canary_json(*run.canary) : Json::Value();
    json["seconds"] = run.seconds;
    json["interrupted"] = run.interrupted;
    json["results"] = Json::arrayValue;
    for (const CheckResult& result : run.results) json["results"].append(result_json(result));
    json["not_run"] = Json::arrayValue;
    for (const std::string& name : run.not_run) json["not_run"].append(name);
    Json::Value& summary = json["summary"];
    for (const Verdict v : {Verdict::passed, Verdict::failed, Verdict::underpowered, Verdict::not_covered})
        summary[verdict_key(v)] = count_json(run.count(v));
    summary["not_run"] = count_json(run.not_run.size());
    return json;
}
} // namespace

std::string check_json(const std::vector<RunResult>& runs, const Family& family, const CheckContext& context,
                       const std::string& command)
{
    Json::Value json;
    json["etendue"] = ETENDUE_VERSION;
    json["revision"] = REVISION;
    json["command"] = command;
    json["seed"] = static_cast<Json::UInt64>(context.seed);
    json["delta"] = context.delta;
    json["lanes"] = context.lanes == 0 ? Json::Value("as suits the device") : Json::Value(context.lanes);
    json["specialize"] = context.specialize;
    json["family"]["alpha"] = family.alpha;
    json["family"]["tests"] = count_json(family.tests);
    json["family"]["test_alpha"] = family.test_alpha;
    json["family"]["critical_z"] = finite_or_null(family.critical_z);
    bool passed = true;
    json["runs"] = Json::arrayValue;
    for (const RunResult& run : runs) {
        passed = passed && run.passed() && !run.interrupted;
        json["runs"].append(run_json(run));
    }
    json["passed"] = passed;
    Json::StreamWriterBuilder builder;
    builder["indentation"] = "  ";
    return Json::writeString(builder, json) + "\n";
}
} // namespace etendue
