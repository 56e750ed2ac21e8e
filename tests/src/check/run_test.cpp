#include "check/run.h"

#include "util/error.h"

#include <catch2/catch.hpp>

using namespace etendue;
using Catch::Contains;

namespace
{
Check check_of(const std::string& name, std::function<std::vector<CheckResult>()> run)
{
    Check check;
    check.group = "stiff";
    check.name = name;
    check.run = [run = std::move(run)](const CheckContext&) { return run(); };
    return check;
}

std::vector<CheckResult> result_of(Verdict verdict)
{
    CheckResult result;
    result.verdict = verdict;
    return {result};
}
} // namespace

TEST_CASE("a run has passed when nothing failed, was too weak or was left out", "[host]")
{
    const auto passed = [](std::vector<Verdict> verdicts) {
        std::vector<Check> checks;
        for (const Verdict verdict : verdicts)
            checks.push_back(check_of("x", [verdict] { return result_of(verdict); }));
        return run_checks(checks, {}, {}).passed();
    };
    CHECK(passed({Verdict::passed, Verdict::not_covered}));
    CHECK_FALSE(passed({Verdict::passed, Verdict::failed}));
    CHECK_FALSE(passed({Verdict::underpowered, Verdict::passed}));
}

TEST_CASE("a check that throws has failed, and the next one runs", "[host]")
{
    const std::vector<Check> checks{
        check_of("broken", []() -> std::vector<CheckResult> { throw SceneError("no such thing"); }),
        check_of("sound", [] { return result_of(Verdict::passed); })};
    const RunResult run = run_checks(checks, {}, {});
    REQUIRE(run.results.size() == 2);
    CHECK(run.results[0].verdict == Verdict::failed);
    CHECK(run.results[0].name == "broken");
    CHECK(run.results[0].group == "stiff");
    CHECK_THAT(run.results[0].note, Contains("no such thing"));
    CHECK(run.results[1].verdict == Verdict::passed);
}

TEST_CASE("when the time is up the rest is not run, and that is no pass", "[host]")
{
    RunOptions options;
    options.budget = 0.0;
    const RunResult run = run_checks({check_of("late", [] { return result_of(Verdict::passed); })}, {}, options);
    CHECK(run.results.empty());
    CHECK(run.not_run == std::vector<std::string>{"late"});
    CHECK_FALSE(run.passed());
    CHECK_FALSE(run.interrupted);
    options.budget = 1e9;
    CHECK(run_checks({check_of("in time", [] { return result_of(Verdict::passed); })}, {}, options).passed());
}

TEST_CASE("what a stopped check found is dropped", "[host]")
{
    bool stopped = false;
    RunOptions options;
    options.context.stop = [&] { return stopped; };
    std::vector<std::string> finished;
    options.finished = [&](const CheckResult& result) { finished.push_back(result.name); };
    const std::vector<Check> checks{check_of("first", [] { return result_of(Verdict::passed); }),
                                    check_of("second",
                                             [&] {
                                                 stopped = true;
                                                 return result_of(Verdict::failed);
                                             }),
                                    check_of("third", [] { return result_of(Verdict::passed); })};
    const RunResult run = run_checks(checks, {}, options);
    CHECK(run.interrupted);
    CHECK(run.results.size() == 1);
    CHECK(finished.size() == 1);
    CHECK(run.not_run == std::vector<std::string>{"second", "third"});
}

TEST_CASE("checks get the level of the family and are told of one by one", "[host]")
{
    Family family;
    family.test_alpha = 1e-5;
    double alpha = 0.0;
    Check check;
    check.name = "level";
    check.run = [&](const CheckContext& context) {
        alpha = context.test_alpha;
        return result_of(Verdict::passed);
    };
    std::vector<std::size_t> begun;
    RunOptions options;
    options.begun = [&](std::size_t index, const Check&) { begun.push_back(index); };
    run_checks({check, check}, family, options);
    CHECK(alpha == 1e-5);
    CHECK(begun == std::vector<std::size_t>{0, 1});
}
