#include "check/family.h"

#include "util/statistics.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace etendue;
using Catch::Contains;

namespace
{
// A check that finds these verdicts, one after the other each time it runs, and remembers how it was run.
struct Trial {
    std::vector<Verdict> verdicts;
    Rule rule = Rule::stat;
    std::vector<CheckContext> contexts = {};

    Check check()
    {
        Check check;
        check.name = "trial";
        check.statistical_tests = 1;
        check.run = [this](const CheckContext& context) {
            CheckResult result;
            result.name = "trial";
            result.rule = rule;
            result.verdict = verdicts.at(contexts.size());
            contexts.push_back(context);
            return std::vector<CheckResult>{result};
        };
        return check;
    }
};
} // namespace

TEST_CASE("the level of a test makes the family's level that of the run", "[host]")
{
    Check five, none;
    five.statistical_tests = 5;
    const Family family = make_family({five, none, five}, 1e-3, 50);
    CHECK(family.tests == 500);
    CHECK(family.test_alpha == Approx(1.0 - std::pow(1.0 - 1e-3, 1.0 / 500)).epsilon(1e-9));
    // What the catalogue says of 500 tests.
    CHECK(family.critical_z == Approx(4.75).margin(0.015));
    CHECK(std::pow(1.0 - family.test_alpha, 500) == Approx(1.0 - 1e-3).epsilon(1e-12));
    CHECK(make_family({none}, 1e-3).test_alpha == Approx(1e-3));
}

TEST_CASE("with fixed seeds a failure is a failure", "[host]")
{
    Trial trial{{Verdict::failed, Verdict::passed}};
    CHECK(run_check(trial.check(), {}, false).front().verdict == Verdict::failed);
    CHECK(trial.contexts.size() == 1);
}

TEST_CASE("with fresh seeds a failure is tried again with 16 times the samples at 1e-6", "[host]")
{
    CheckContext context;
    context.seed = 7;
    Trial trial{{Verdict::failed, Verdict::passed}};
    const CheckResult result = run_check(trial.check(), context, true).front();
    CHECK(result.verdict == Verdict::passed);
    CHECK_THAT(result.note, Contains("tried again"));
    REQUIRE(trial.contexts.size() == 2);
    CHECK(trial.contexts[1].effort == 16.0);
    CHECK(trial.contexts[1].test_alpha == 1e-6);
    CHECK(trial.contexts[1].seed != 7);

    Trial twice{{Verdict::failed, Verdict::failed}};
    CHECK(run_check(twice.check(), context, true).front().verdict == Verdict::failed);
}

TEST_CASE("only statistical failures are tried again", "[host]")
{
    Trial exact{{Verdict::failed, Verdict::passed}, Rule::exact};
    CHECK(run_check(exact.check(), {}, true).front().verdict == Verdict::failed);
    Trial passed{{Verdict::passed, Verdict::failed}};
    CHECK(run_check(passed.check(), {}, true).front().verdict == Verdict::passed);
    Trial weak{{Verdict::underpowered, Verdict::passed}};
    CHECK(run_check(weak.check(), {}, true).front().verdict == Verdict::underpowered);
}
