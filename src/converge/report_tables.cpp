// Numbers into cells.
#include "converge/report_tables.h"

#include "converge/html_table.h"
#include "util/html.h"

#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
std::string mark(bool passed)
{
    return passed ? "passed" : "<strong>not passed</strong>";
}

std::string note(const std::string& text)
{
    return "<p class=\"note\">" + html_escape(text) + "</p>\n";
}

std::string ratio_cell(const Ratio& ratio)
{
    if (!ratio.known()) return "no common target";
    if (!ratio.target) return interval_text(ratio.value);
    return fmt::format("{} (time to {} {:g})", interval_text(ratio.value), ratio.target->metric, ratio.target->value);
}

std::string crossing_cell(const Crossing& crossing, const Interval& band)
{
    switch (crossing.kind) {
    case Crossing::Kind::before_first:
        return "below " + seconds_text(crossing.x);
    case Crossing::Kind::not_reached:
        return "not reached";
    case Crossing::Kind::at:
        break;
    }
    if (!std::isfinite(band.low) || !std::isfinite(band.high)) return seconds_text(crossing.x);
    return fmt::format("{:.3g} s [{:.3g}, {:.3g}]", crossing.x, band.low, band.high);
}

std::vector<std::string> start_cells(const std::string& name, const StartSeconds& s)
{
    return {name,
            seconds_text(s.load),
            seconds_text(s.geometry),
            seconds_text(s.open),
            seconds_text(s.upload),
            seconds_text(s.bvh),
            seconds_text(s.compile),
            seconds_text(s.first_launch),
            seconds_text(s.total())};
}
} // namespace

std::string ratio_table(const Analysis& analysis)
{
    std::vector<std::string> head{""};
    for (const auto& configuration : analysis.configurations) head.push_back(html_escape(configuration.name));
    HtmlTable table(head);
    for (std::size_t i = 0; i < analysis.ratios.size(); ++i) {
        std::vector<std::string> row{head[i + 1]};
        for (std::size_t j = 0; j < analysis.ratios.size(); ++j)
            row.push_back(i == j ? "1" : ratio_cell(analysis.ratios[i][j]));
        table.add(row);
    }
    return table.html() + note("Efficiency is 1 / (MSE x seconds of rendering), with 95 % intervals by bootstrap over "
                               "the seeds; where slopes differ, times to a target are compared instead.");
}

std::string target_table(const Analysis& analysis)
{
    HtmlTable table({"configuration", "target", "seconds of rendering", "seconds from a cold start"});
    for (const auto& configuration : analysis.configurations)
        for (const TargetTime& time : configuration.targets)
            table.add({html_escape(configuration.name),
                       fmt::format("{} {:g}", html_escape(time.target.metric), time.target.value),
                       crossing_cell(time.render, time.render_band), crossing_cell(time.total, time.total_band)});
    return table.html();
}

std::string fit_table(const Analysis& analysis)
{
    HtmlTable table({"configuration", "slope on samples", "slope on seconds", "p", "b", "efficiency",
                     "MSE in the worst 0.1 % of pixels", "variance of the mean over the film's estimate"});
    for (const auto& c : analysis.configurations)
        table.add({html_escape(c.name), interval_text(c.slope_samples), interval_text(c.slope_seconds),
                   interval_text(c.exponent), interval_text(c.floor), interval_text(c.efficiency),
                   percent_text(c.top_share), short_text(c.variance_of_mean / c.variance_of_mean_by_film)});
    return table.html() +
           note("Slopes of log2 MSE, each seed by itself; independent samples must have -1 on samples, "
                "while seconds hold the launches' overhead too. p and b: MSE = a N^-p + b. All intervals "
                "are at 95 %.");
}

std::string verdict_table(const Analysis& analysis)
{
    HtmlTable table({"configuration", "floor b", "tiles, p of uniformity", "worst tile", "mean", "z", "allowed z",
                     "detectable bias"});
    for (const auto& c : analysis.configurations) {
        const BiasVerdict& v = c.verdict;
        table.add({html_escape(c.name), interval_text(v.floor) + ", " + mark(v.floor_passed),
                   short_text(v.tile_p_value) + ", " + mark(v.tiles_passed), short_text(v.worst_tile_z),
                   percent_text(v.mean_error) + ", " + mark(v.mean_passed), short_text(v.z), short_text(v.critical),
                   percent_text(v.detectable_bias)});
    }
    return table.html() +
           note(fmt::format("Each test at the level {:.2g}, so that all together cry wolf once in a thousand studies; "
                            "the interval of b is at that level too.",
                            analysis.test_alpha));
}

std::string calibration_table(const Analysis& analysis)
{
    HtmlTable table({"configuration", "samples", "estimates", "median", "5 %", "95 %", "more than 10 % too small"});
    for (const auto& configuration : analysis.configurations)
        for (const auto& [samples, c] : configuration.calibration)
            table.add({html_escape(configuration.name), samples > 0.0 ? fmt::format("{:g}", samples) : "all",
                       std::to_string(c.count), short_text(c.median), short_text(c.low), short_text(c.high),
                       percent_text(c.too_confident)});
    return table.html() + note("The relative error that the film estimates without a reference, over the one that "
                               "there is. 1 is right; "
                               "below 1 a render that stops at an error stops too early.");
}

std::string phase_table(const Study& study)
{
    HtmlTable table({"configuration", "load", "geometry", "open device", "upload", "BVH", "compile", "first launch",
                     "all before the first sample"});
    HtmlTable rendering(
        {"configuration and seed", "render", "kernels, device's clock", "looking, not counted", "rays/s"});
    for (const StudiedConfiguration& studied : study.configurations) {
        const std::string name = html_escape(studied.prepared.configuration.name);
        table.add(start_cells(name + ", cold", studied.cold));
        if (!studied.runs.empty())
            table.add(start_cells(name + ", kernels kept", studied.runs.back().measurement.start));
        for (const Run& run : studied.runs) {
            const ErrorRow& last = run.rows.back();
            rendering.add({fmt::format("{}, {}", name, run.seed), seconds_text(last.render_seconds),
                           seconds_text(last.kernel_seconds), seconds_text(run.measurement.look_seconds),
                           short_text(static_cast<double>(last.rays) / last.render_seconds)});
        }
    }
    return table.html() + rendering.html();
}

std::string self_check_table(const Study& study)
{
    HtmlTable table({"known number", "expected", "found", "standard error", ""});
    for (const SelfCheckResult& r : study.self_check)
        table.add({html_escape(r.name), fmt::format("{:.6g}", r.expected), fmt::format("{:.6g}", r.found),
                   short_text(r.standard_error), mark(r.passed)});
    return table.html();
}

std::string setting_table(const Study& study)
{
    HtmlTable table({"setting", ""});
    const Scene& scene = study.configurations.front().prepared.scene;
    table.add({"picture", fmt::format("{} x {} pixels", scene.film.width, scene.film.height)});
    table.add({"checkpoints", study.options.checkpoints.text()});
    table.add({"seeds", fmt::format("{} from {}", study.options.seeds, study.options.first_seed)});
    table.add({"scene SHA-256", "<code>" + scene.sha256 + "</code>"});
    table.add({"epsilon of relMSE",
               fmt::format("{:g} of the reference's mean", study.options.metric_settings.relative_epsilon)});
    for (const StudiedConfiguration& studied : study.configurations) {
        std::string devices;
        for (const DeviceInfo& device : studied.prepared.options.devices)
            devices += (devices.empty() ? "" : " + ") + device.name + ", " + device.driver_version;
        table.add({"configuration", html_escape(studied.prepared.configuration.text() + " on " + devices)});
    }
    return table.html();
}
} // namespace etendue
