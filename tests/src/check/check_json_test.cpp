#include "check/check_json.h"

#include <catch2/catch.hpp>

#include <json/json.h>

#include <cmath>
#include <sstream>

using namespace etendue;

namespace
{
Json::Value parse(const std::string& text)
{
    Json::Value json;
    std::istringstream(text) >> json;
    return json;
}

RunResult run_of(Verdict verdict)
{
    RunResult run;
    run.device.name = "a device";
    run.seconds = 3.0;
    CheckResult result;
    result.group = "analytic";
    result.name = "F1";
    result.rule = Rule::round;
    result.expected = "4";
    result.found = "5";
    result.statistic = INFINITY;
    result.unit = "ulp";
    result.critical = 20;
    result.verdict = verdict;
    result.note = "a \"note\"";
    run.results.push_back(result);
    return run;
}
} // namespace

TEST_CASE("the JSON holds the family, each device and every result", "[host]")
{
    CheckContext context;
    context.seed = ~std::uint64_t{0};
    const Json::Value json = parse(check_json({run_of(Verdict::failed), run_of(Verdict::passed)},
                                              {1e-3, 500, 2e-6, 4.75}, context, "etendue check"));
    CHECK(json["command"] == "etendue check");
    CHECK(json["seed"].asUInt64() == ~std::uint64_t{0});
    CHECK(json["delta"] == 0.005);
    CHECK(json["family"]["tests"] == 500);
    CHECK(json["family"]["critical_z"] == 4.75);
    REQUIRE(json["runs"].size() == 2);
    const Json::Value& run = json["runs"][0];
    CHECK(run["device"]["name"] == "a device");
    CHECK(run["summary"]["failed"] == 1);
    CHECK(run["summary"]["passed"] == 0);
    const Json::Value& result = run["results"][0];
    CHECK(result["name"] == "F1");
    CHECK(result["group"] == "analytic");
    CHECK(result["rule"] == "round");
    CHECK(result["verdict"] == "failed");
    CHECK(result["expected"] == "4");
    CHECK(result["found"] == "5");
    CHECK(result["critical"] == 20.0);
    CHECK(result["note"] == "a \"note\"");
    // Neither infinite nor unknown numbers are JSON.
    CHECK(result["statistic"].isNull());
    CHECK(result["detectable_bias"].isNull());
}

TEST_CASE("a run that failed, was weak, was cut short or interrupted is no pass in JSON", "[host]")
{
    const auto passed = [](const std::vector<RunResult>& runs) {
        return parse(check_json(runs, {}, {}, ""))["passed"].asBool();
    };
    CHECK(passed({run_of(Verdict::passed), run_of(Verdict::not_covered)}));
    CHECK_FALSE(passed({run_of(Verdict::passed), run_of(Verdict::failed)}));
    CHECK_FALSE(passed({run_of(Verdict::underpowered)}));
    RunResult late = run_of(Verdict::passed), interrupted = late;
    late.not_run = {"F2"};
    interrupted.interrupted = true;
    CHECK_FALSE(passed({late}));
    CHECK_FALSE(passed({interrupted}));
}
