// What the errors came to, in cells.
#include "converge/report_tables.h"

#include "converge/number_text.h"
#include "util/html.h"

#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
using Rows = std::vector<std::vector<HtmlCell>>;

HtmlCell judged(const std::string& text, bool passed)
{
    return {text, passed ? HtmlMark::good : HtmlMark::bad};
}

std::string ratio_cell(const Ratio& ratio)
{
    if (ratio.target && ratio.known())
        return fmt::format("{} to {} {:g}", interval_text(ratio.value), ratio.target->metric, ratio.target->value);
    return ratio.known() ? interval_text(ratio.value) : "no common target";
}

std::string crossing_cell(const Crossing& crossing, const Interval& band)
{
    switch (crossing.kind) {
    case Crossing::Kind::before_first:
        return "< " + seconds_text(crossing.x);
    case Crossing::Kind::not_reached:
        return "not reached";
    case Crossing::Kind::unknown:
        return "unknown: in the grey";
    case Crossing::Kind::at:
        break;
    }
    if (!std::isfinite(band.low) || !std::isfinite(band.high)) return seconds_text(crossing.x);
    return fmt::format("{:.3g} s [{:.3g}, {:.3g}]", crossing.x, band.low, band.high);
}
} // namespace

std::string ratio_table(const Analysis& analysis)
{
    std::vector<std::string> head{""};
    for (const auto& configuration : analysis.configurations) head.push_back("than " + configuration.name);
    Rows rows;
    for (std::size_t i = 0; i < analysis.ratios.size(); ++i) {
        std::vector<HtmlCell> row{analysis.configurations[i].name};
        for (std::size_t j = 0; j < analysis.ratios.size(); ++j)
            row.emplace_back(i == j ? "1" : ratio_cell(analysis.ratios[i][j]));
        rows.push_back(row);
    }
    return html_paragraph("By 1 / (MSE × seconds of rendering) at the last usable checkpoint, with 95 % intervals by "
                          "bootstrap over the seeds. Where slopes differ, by the time to a target.") +
           html_table("How many times better the row is", head, rows);
}

std::string target_table(const Analysis& analysis)
{
    Rows rows;
    for (const auto& configuration : analysis.configurations)
        for (const TargetTime& time : configuration.targets)
            rows.push_back({configuration.name, fmt::format("{} {:g}", time.target.metric, time.target.value),
                            crossing_cell(time.render, time.render_band), crossing_cell(time.total, time.total_band)});
    return html_table("Between checkpoints straight in log-log; 95 % intervals by bootstrap over the seeds.",
                      {"configuration", "target", "rendering", "from a cold start"}, rows);
}

std::string fit_table(const Analysis& analysis)
{
    Rows rows;
    for (const auto& c : analysis.configurations)
        rows.push_back({c.name, interval_text(c.slope_samples), interval_text(c.slope_seconds), interval_text(c.floor),
                        interval_text(c.efficiency), percent_text(c.top_share),
                        short_text(c.variance_of_mean / c.variance_of_mean_by_film)});
    return html_paragraph("Slopes of log₂ MSE, each seed by itself: −1 on samples where they are independent; seconds "
                          "hold the overhead of short launches too. b: MSE = a / N + b over the last samples, above 0 "
                          "where a floor is. Efficiency: 1 / (MSE × "
                          "seconds). Fireflies: share of the MSE in the worst 0.1 % of the pixels. Spread of the mean: "
                          "its variance between seeds over the films' estimate, 1 where pixels are independent.") +
           html_table("95 % intervals over the seeds",
                      {"configuration", "slope on samples", "slope on seconds", "b", "efficiency", "fireflies",
                       "spread of the mean"},
                      rows);
}

std::string verdict_table(const Analysis& analysis)
{
    Rows rows;
    for (const auto& c : analysis.configurations) {
        const BiasVerdict& v = c.verdict;
        rows.push_back({c.name, judged(interval_text(v.floor), v.floor_passed),
                        judged(short_text(v.tile_p_value), v.tiles_passed), short_text(v.uniform_p_value),
                        short_text(v.worst_tile_z), judged(fmt::format("{:+.2g} %", 100 * v.mean_error), v.mean_passed),
                        short_text(v.z), short_text(v.critical), percent_text(v.detectable_bias)});
    }
    return html_paragraph(
               fmt::format("Each test is at the level {:.2g}, b and the slope too, so that all together are wrong "
                           "once in a thousand studies. Tiles: whether Welch's p-values have too many small ones, and "
                           "whether they are uniform at all; no tile may be too far off by itself either. z: of the "
                           "picture's mean, the worst channel.",
                           analysis.test_alpha)) +
           html_table("Three parts, all of which must pass",
                      {"configuration", "floor b", "tiles, p", "uniform, p", "worst tile z", "mean", "z", "allowed",
                       "detectable bias"},
                      rows);
}

std::string calibration_table(const Analysis& analysis)
{
    Rows rows;
    for (const auto& configuration : analysis.configurations)
        for (const auto& [samples, c] : configuration.calibration)
            rows.push_back({configuration.name, samples > 0.0 ? fmt::format("{:g}", samples) : "all",
                            std::to_string(c.count), short_text(c.median), short_text(c.low), short_text(c.high),
                            percent_text(c.too_confident)});
    return html_paragraph("The relative error that the film estimates without a reference, over the one that there is: "
                          "1 is right, and below 1 a render that stops at an error stops too early.") +
           html_table("Estimated over true relative error",
                      {"configuration", "samples", "estimates", "median", "5 %", "95 %", "more than 10 % too small"},
                      rows);
}
} // namespace etendue
