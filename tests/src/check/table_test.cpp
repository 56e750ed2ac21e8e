#include "check/table.h"

#include <catch2/catch.hpp>

#include <sstream>

using namespace etendue;
using Catch::Contains;

namespace
{
CheckResult sample_result()
{
    CheckResult result;
    result.name = "F2-albedo-0.5";
    result.rule = Rule::stat;
    result.expected = "2";
    result.found = "2.000147";
    result.statistic = 0.25;
    result.unit = "z";
    result.critical = 4.75;
    result.detectable_bias = 0.0017;
    result.verdict = Verdict::passed;
    result.seconds = 1.234;
    return result;
}

std::vector<std::string> words(const std::string& text)
{
    std::istringstream stream(text);
    std::vector<std::string> list;
    for (std::string word; stream >> word;) list.push_back(word);
    return list;
}
} // namespace

TEST_CASE("a row says case, rule, expected, found, distance, detectable bias and seconds", "[host]")
{
    CHECK(words(table_row(sample_result())) == std::vector<std::string>{"passed", "F2-albedo-0.5", "stat", "2",
                                                                        "2.000147", "0.25", "of", "4.75", "z", "0.17",
                                                                        "%", "1.23"});
}

TEST_CASE("the columns of the header and of a row end at one place", "[host]")
{
    CHECK(table_header().size() == table_row(sample_result()).size());
    CHECK(table_header().find("rule") == table_row(sample_result()).find("stat"));
}

TEST_CASE("what is not passed says why on a line below", "[host]")
{
    CheckResult result = sample_result();
    result.note = "p = 1e-9";
    CHECK_THAT(table_row(result), !Contains("p = 1e-9"));
    result.verdict = Verdict::failed;
    CHECK_THAT(table_row(result), Contains("FAILED") && Contains("\n             p = 1e-9"));
    result.verdict = Verdict::underpowered;
    CHECK_THAT(table_row(result), Contains("UNDERPOWERED") && Contains("\n             p = 1e-9"));
    result.verdict = Verdict::not_covered;
    CHECK_THAT(table_row(result), Contains("not covered") && Contains("p = 1e-9") && !Contains("\n"));
}

TEST_CASE("what does not fit its column is cut, and lines do not break it", "[host]")
{
    CheckResult result = sample_result();
    result.found = "a message that is much longer than its column\nand has two lines";
    CHECK(table_row(result).size() == table_header().size());
    CHECK_THAT(table_row(result), Contains("a message that is muc...") && !Contains("two lines"));
}

TEST_CASE("numbers that are not known are left out", "[host]")
{
    CheckResult result = sample_result();
    result.statistic = result.critical = result.detectable_bias = UNKNOWN;
    CHECK_THAT(table_row(result), !Contains("nan") && !Contains("%"));
}

TEST_CASE("the summary counts, and says how strict the tests were", "[host]")
{
    RunResult run;
    run.seconds = 12.34;
    for (const Verdict verdict :
         {Verdict::passed, Verdict::passed, Verdict::failed, Verdict::underpowered, Verdict::not_covered}) {
        run.results.push_back(sample_result());
        run.results.back().verdict = verdict;
    }
    Family family{1e-3, 500, 2e-6, 4.75};
    CHECK_THAT(table_summary(run, family), Contains("2 passed, 1 failed, 1 underpowered, 1 not covered yet; 12.3 s") &&
                                               Contains("500 statistical tests") && Contains("|z| <= 4.75") &&
                                               !Contains("not run"));
    run.not_run = {"L1", "L2"};
    family.tests = 0;
    CHECK_THAT(table_summary(run, family),
               Contains("2 checks were not run for want of time, the first is L1") && !Contains("statistical"));
    run.interrupted = true;
    CHECK_THAT(table_summary(run, family), Contains("2 checks were not run because of the interrupt"));
}
