// The table and the JSON of a study whose truth is known.
#include "converge/errors_csv.h"

#include "converge/converge_json.h"
#include "synthetic_study.h"

#include <catch2/catch.hpp>

#include <memory>
#include <sstream>

#include <json/json.h>

using namespace etendue;
using Catch::StartsWith;

namespace
{
Json::Value parsed(const std::string& text)
{
    Json::Value value;
    std::istringstream stream(text);
    Json::CharReaderBuilder builder;
    Json::CharReaderBuilder::strictMode(&builder.settings_);
    std::string errors;
    REQUIRE(Json::parseFromStream(builder, stream, &value, &errors));
    return value;
}
} // namespace

TEST_CASE("errors.csv has the promised columns and a row for every checkpoint", "[converge]")
{
    SyntheticOptions options;
    options.seeds = 2;
    options.checkpoints = 3;
    const std::string csv = errors_csv(synthetic_study(options, 3));
    CHECK_THAT(csv,
               StartsWith("scene,config,device,seed,spp,t_render,t_kernel,t_total,rays,mse,mse_corrected,relmse,mape,"
                          "maxrel,bias,ref_var,nan,inf,neg,max_share,var_mean"));
    std::istringstream lines(csv);
    std::vector<std::string> rows;
    for (std::string line; std::getline(lines, line);) rows.push_back(line);
    REQUIRE(rows.size() == 1 + 2 * 3);
    CHECK_THAT(rows[3], StartsWith("synthetic.json,default,\"Device, \"\"quoted\"\"\",1,4,0.004,0.004,2.004,3072,"));
    const std::string numbers = rows[3].substr(rows[3].find("\",1,") + 1);
    CHECK(static_cast<std::size_t>(std::count(numbers.begin(), numbers.end(), ',')) == csv_columns().size() - 3);
}

TEST_CASE("converge.json holds the whole study, and null for what is not known", "[converge]")
{
    Study study = synthetic_study({}, 3);
    study.options.command = "etendue converge \"x\"";
    study.warnings = {"Careful."};
    study.self_check = {{"known", 0.5, 0.6, 0.1, true}};
    const Json::Value json = parsed(converge_json(study, analyse(study)));
    CHECK(json["command"].asString() == "etendue converge \"x\"");
    CHECK(json["bench_passed"].asBool());
    CHECK(json["bench_self_check"][0]["found"].asDouble() == 0.6);
    CHECK(json["metrics"]["relative_epsilon"].asDouble() == 0.01);
    CHECK(json["warnings"][0].asString() == "Careful.");
    CHECK(json["columns"].size() == csv_columns().size());
    const Json::Value& configuration = json["configurations"][0];
    CHECK(configuration["name"].asString() == "default");
    CHECK(configuration["verdict"]["result"].asString() == "UNBIASED");
    CHECK(configuration["slope"]["on_spp"]["estimate"].asDouble() == Approx(-1.0).epsilon(0.05));
    CHECK(configuration["cold_start_seconds"]["compile"].asDouble() == 2.0);
    CHECK(configuration["curve"].size() == 9);
    CHECK(configuration["targets"].size() == 3);
    CHECK(configuration["reference"]["kind"].asString() == "analytic");
    // A number of replicates of an analytic reference.
    CHECK(configuration["reference"]["variance_by_replicates_over_by_film"].isNull());
    CHECK(json["ratios"].empty());
}

TEST_CASE("the JSON of a single seed has no intervals, and is still JSON", "[converge]")
{
    SyntheticOptions options;
    options.seeds = 1;
    const Study study = synthetic_study(options, 3);
    const Json::Value json = parsed(converge_json(study, analyse(study)));
    CHECK(json["configurations"][0]["slope"]["on_spp"]["low"].isNull());
    CHECK(json["configurations"][0]["verdict"]["result"].asString() == "UNDERPOWERED");
}
