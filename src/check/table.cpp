// The columns of the table.
#include "check/table.h"

#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr const char* COLUMNS = "{:<13}{:<44} {:<6}{:>24} {:>24} {:>16} {:>8} {:>8}";

std::string number(double x)
{
    if (std::isnan(x)) return "";
    return x != 0.0 && (std::abs(x) < 0.01 || std::abs(x) >= 1e5) ? fmt::format("{:.1e}", x) : fmt::format("{:.4g}", x);
}

// "1.7 of 4.4 z"
std::string distance(const CheckResult& result)
{
    if (std::isnan(result.statistic)) return "";
    return fmt::format("{} of {} {}", number(result.statistic), number(result.critical), result.unit);
}

std::string bias(double detectable)
{
    return std::isnan(detectable) ? "" : fmt::format("{:.2g} %", 100.0 * detectable);
}

// A text of one line, cut where it is too long for its column.
std::string fitted(std::string text, std::size_t width)
{
    text = text.substr(0, text.find('\n'));
    return text.size() <= width ? text : text.substr(0, width - 3) + "...";
}
} // namespace

const char* verdict_name(Verdict verdict)
{
    static const char* const names[] = {"passed", "FAILED", "UNDERPOWERED", "not covered"};
    return names[static_cast<std::size_t>(verdict)];
}

const char* rule_name(Rule rule)
{
    static const char* const names[] = {"exact", "round", "bound", "count", "stat"};
    return names[static_cast<std::size_t>(rule)];
}

std::string table_header()
{
    return fmt::format(COLUMNS, "verdict", "case", "rule", "expected", "found", "off, of limit", "bias", "seconds");
}

std::string table_row(const CheckResult& result)
{
    if (result.verdict == Verdict::not_covered)
        return fmt::format("{:<13}{:<44} {}", verdict_name(result.verdict), result.name, result.note);
    std::string row = fmt::format(COLUMNS, verdict_name(result.verdict), result.name, rule_name(result.rule),
                                  fitted(result.expected, 24), fitted(result.found, 24), distance(result),
                                  bias(result.detectable_bias), fmt::format("{:.2f}", result.seconds));
    if (result.verdict != Verdict::passed && !result.note.empty()) row += "\n             " + result.note;
    return row;
}

std::string table_summary(const RunResult& run, const Family& family)
{
    std::string text = fmt::format("{} passed, {} failed, {} underpowered, {} not covered yet; {:.1f} s",
                                   run.count(Verdict::passed), run.count(Verdict::failed),
                                   run.count(Verdict::underpowered), run.count(Verdict::not_covered), run.seconds);
    if (!run.not_run.empty())
        text += fmt::format("; {} checks were not run {}, the first is {}", run.not_run.size(),
                            run.interrupted ? "because of the interrupt" : "for want of time", run.not_run.front());
    if (family.tests > 0)
        text += fmt::format("\n{} statistical tests are a family of level {:.2g}: each has |z| <= {:.2f} (p >= {:.1e})",
                            family.tests, family.alpha, family.critical_z, family.test_alpha);
    return text + ".";
}
} // namespace etendue
