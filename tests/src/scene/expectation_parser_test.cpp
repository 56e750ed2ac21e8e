#include "scene/expectation_parser.h"

#include "scene/scene_loader.h"

#include <catch2/catch.hpp>

using namespace etendue;
using Catch::Contains;
using Catch::StartsWith;
using Rule = ExpectedFact::Rule;
using Subject = ExpectedFact::Subject;

namespace
{
Expectation parse(const std::string& expect)
{
    return parse_scene(R"({"environment": {"radiance": 1}, "expect": )" + expect + "}", "test.json")
        .scene.expectation.value();
}

ExpectedFact parse_fact(const std::string& fact)
{
    return parse(R"({"because": "so", "facts": [)" + fact + "]}").facts.front();
}

std::string error_of(const std::string& expect)
{
    try {
        parse(expect);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "no error";
}

std::string fact_error(const std::string& fact)
{
    return error_of(R"({"because": "so", "facts": [)" + fact + "]}");
}
} // namespace

TEST_CASE("a scene need not expect anything", "[host]")
{
    CHECK_FALSE(parse_scene(R"({"environment": {"radiance": 1}})", "test.json").scene.expectation.has_value());
}

TEST_CASE("an expectation has a group, a tier, a reason, names and facts", "[host]")
{
    const Expectation e = parse(R"json({"group": "analytic", "tier": "long", "because": "R + T = 1", "lenient": true,
        "where": {"b": 0.1, "a": "float(0.8)"}, "facts": [{"subject": "pixels", "value": 1}, {"subject": "mean", "value": "a"}]})json");
    CHECK(e.group == Expectation::Group::analytic);
    CHECK(e.is_long);
    CHECK(e.lenient);
    CHECK(e.because == "R + T = 1");
    REQUIRE(e.where.size() == 2);
    CHECK(e.where[0].first == "a");
    CHECK(e.where[0].second.text == "float(0.8)");
    CHECK(e.where[0].second.location.pointer == "/expect/where/a");
    CHECK(e.where[1].second.text == "0.1");
    REQUIRE(e.facts.size() == 2);
    CHECK(e.facts[1].value.front().location.pointer == "/expect/facts/1/value");

    const Expectation least = parse(R"({"because": "so", "facts": [{"subject": "pixels", "value": 1}]})");
    CHECK(least.group == Expectation::Group::stiff);
    CHECK_FALSE(least.is_long);
    CHECK_FALSE(least.lenient);
}

TEST_CASE("every subject has its usual rule", "[host]")
{
    CHECK(parse_fact(R"({"subject": "pixels", "value": 1})").rule == Rule::round);
    CHECK(parse_fact(R"({"subject": "mean", "value": 1})").rule == Rule::stat);
    CHECK(parse_fact(R"({"subject": "relative_variance", "value": 1})").rule == Rule::stat);
    CHECK(parse_fact(R"({"subject": "second_moment", "value": 1})").subject == Subject::second_moment);
    CHECK(parse_fact(R"({"subject": "rays", "value": 1})").rule == Rule::count);
    CHECK(parse_fact(R"({"subject": "same", "specialized": true})").rule == Rule::exact);
    CHECK(parse_fact(R"({"subject": "load_error", "text": "x"})").subject == Subject::load_error);
    CHECK(parse_fact(R"({"subject": "warning", "text": "x"})").subject == Subject::warning);
}

TEST_CASE("a fact holds what its subject needs", "[host]")
{
    const ExpectedFact pixels = parse_fact(
        R"({"subject": "pixels", "rule": "bound", "value": [1, "a", 2.5], "tolerance": "2*D+4", "or": 0, "or_share": [0.1, 0.5]})");
    CHECK(pixels.rule == Rule::bound);
    REQUIRE(pixels.value.size() == 3);
    CHECK(pixels.value[1].text == "a");
    CHECK(pixels.value[2].text == "2.5");
    CHECK(pixels.tolerance->text == "2*D+4");
    CHECK(pixels.other_value->text == "0");
    CHECK(pixels.other_share == Vec2(0.1, 0.5));
    CHECK_FALSE(parse_fact(R"({"subject": "pixels", "value": 1})").other_value.has_value());

    const ExpectedFact mean = parse_fact(R"({"subject": "mean", "value": 1, "delta": 0.02})");
    CHECK(mean.delta->text == "0.02");
    CHECK(mean.tolerance->text == "16");

    const ExpectedFact same =
        parse_fact(R"({"subject": "same", "rule": "count", "scene": "b.json", "overrides": ["film.size=[1,1]"],
        "specialized": true, "tolerance": 1e-4, "share": 0.999})");
    CHECK(same.rule == Rule::count);
    CHECK(same.scene == "b.json");
    CHECK(same.overrides == std::vector<std::string>{"film.size=[1,1]"});
    CHECK(same.specialized);
    CHECK(same.share == 0.999);

    const ExpectedFact error = parse_fact(R"({"subject": "load_error", "text": "no", "overrides": ["a=1", "b=2"]})");
    CHECK(error.text == "no");
    CHECK(error.overrides.size() == 2);
}

TEST_CASE("what a fact cannot be is an error at its place", "[host]")
{
    CHECK_THAT(fact_error(R"({"value": 1})"), StartsWith("test.json:1:") && Contains("needs the key \"subject\""));
    CHECK_THAT(fact_error(R"({"subject": "pixel", "value": 1})"),
               Contains("/expect/facts/0/subject") && Contains("did you mean \"pixels\""));
    CHECK_THAT(fact_error(R"({"subject": "pixels"})"), Contains("this fact of subject pixels needs the key \"value\""));
    CHECK_THAT(fact_error(R"({"subject": "pixels", "value": true})"),
               Contains("must be a number, a formula in quotes, or a list of 3"));
    CHECK_THAT(fact_error(R"({"subject": "pixels", "value": [1, 2]})"),
               Contains("/value: must be") && Contains("a list of 2 values"));
    CHECK_THAT(fact_error(R"({"subject": "pixels", "value": [1, 2, null]})"),
               Contains("/value/2: must be a number or a formula in quotes"));
    CHECK_THAT(fact_error(R"({"subject": "pixels", "value": 1, "rule": "stat"})"), Contains("unknown rule \"stat\""));
    CHECK_THAT(fact_error(R"({"subject": "mean", "value": 1, "or": 0})"), Contains("unknown fact key \"or\""));
    CHECK_THAT(fact_error(R"({"subject": "same", "overrides": "x=1"})"), Contains("must be a list of strings"));
    // It could not fail.
    CHECK_THAT(fact_error(R"({"subject": "same", "rule": "stat"})"), Contains("the same as itself"));
    CHECK_THAT(fact_error(R"({"subject": "same", "overrides": [1]})"),
               Contains("/overrides/0: must be a string, is 1"));
    CHECK_THAT(fact_error(R"({"subject": "same", "share": 2})"), Contains("must be between 0 and 1"));
}

TEST_CASE("what an expectation cannot be is an error at its place", "[host]")
{
    CHECK_THAT(error_of(R"({"facts": [{"subject": "pixels", "value": 1}]})"), Contains("needs the key \"because\""));
    CHECK_THAT(error_of(R"({"because": "so"})"), Contains("needs the key \"facts\""));
    CHECK_THAT(error_of(R"({"because": "so", "facts": []})"), Contains("at least one fact"));
    CHECK_THAT(error_of(R"({"because": "so", "facts": {}})"), Contains("must be a list of objects"));
    CHECK_THAT(error_of(R"({"because": "so", "where": [], "facts": []})"),
               Contains("an object of numbers and formulas"));
    CHECK_THAT(error_of(R"({"because": "so", "where": {"a": []}, "facts": []})"),
               Contains("/expect/where/a: must be a number"));
    CHECK_THAT(error_of(R"({"because": "so", "group": "stif", "facts": []})"), Contains("did you mean \"stiff\""));
}
