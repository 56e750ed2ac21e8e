// The page, section by section.
#include "converge/converge_report.h"

#include "converge/converge_plots.h"
#include "converge/html_table.h"
#include "converge/report_tables.h"
#include "util/file.h"
#include "util/html.h"

#include <filesystem>

#include <fmt/format.h>

namespace etendue
{
namespace
{
// What the page adds to the style sheet that all pages share.
const char* const STYLE = "<style>.scroll{overflow-x:auto}.plots,.pictures{display:flex;flex-wrap:wrap;gap:1rem}"
                          ".plots>*{flex:1 1 22rem;min-width:0}.plots svg{width:100%;height:auto}"
                          ".pictures figure{margin:0;flex:1 1 9rem;max-width:16rem}"
                          ".pictures img{width:100%;height:auto;image-rendering:pixelated}"
                          ".verdict{padding:.6rem 1rem;margin:.6rem 0;border-left:.5rem solid #888}"
                          ".verdict.UNBIASED{border-color:#2a8a3e}.verdict.BIASED,.verdict.FAILED{border-color:#c22f2f}"
                          ".verdict.UNDERPOWERED{border-color:#c98a00}</style>\n";

std::string section(const std::string& title, const std::string& content)
{
    return "<section><h2>" + title + "</h2>\n" + content + "</section>\n";
}

std::string paragraph(const std::string& text)
{
    return "<p>" + html_escape(text) + "</p>\n";
}

std::string verdicts(const Study& study, const Analysis& analysis)
{
    std::string text;
    if (study.interrupted) text += paragraph("The study was interrupted: this is what it had until then.");
    for (const ConfigurationAnalysis& configuration : analysis.configurations) {
        const BiasVerdict& verdict = configuration.verdict;
        const char* const name = bias_result_name(verdict.result);
        text += fmt::format("<div class=\"verdict {}\"><strong>{}: {}</strong>", name, html_escape(configuration.name),
                            name);
        if (verdict.result == BiasResult::unbiased && !verdict.exact)
            text += fmt::format("<br>No floor under the errors, tiles as they should be, and the mean within {} of the "
                                "reference's or a larger bias would have been seen.",
                                percent_text(verdict.detectable_bias));
        for (const std::string& reason : verdict.reasons) text += "<br>" + html_escape(reason);
        text += "</div>\n";
    }
    text += analysis.bench_passed
                ? paragraph("The bench measures the furnace's known error: passed.")
                : "<div class=\"verdict FAILED\"><strong>The bench does not measure the furnace's known error: nothing "
                  "here can be trusted.</strong></div>\n";
    for (const std::string& warning : study.warnings) text += paragraph("Warning: " + warning);
    return text;
}

std::string plots(const Study& study, const Analysis& analysis)
{
    std::string text;
    for (const std::string& metric : study.options.metrics)
        text += "<div class=\"plots\"><div>" + convergence_svg(study, analysis, metric, TimeAxis::render) +
                "</div><div>" + convergence_svg(study, analysis, metric, TimeAxis::total) + "</div></div>\n";
    return text +
           paragraph("Means over the seeds with their 95 % intervals; the reference's variance is subtracted, and "
                     "errors in the grey are too near to it for any conclusion.");
}

std::string pictures_of(const std::vector<StudyPicture>& pictures, const std::string& name, const std::string& folder)
{
    std::string text = "<h3>" + html_escape(name) + "</h3><div class=\"pictures\">";
    for (const StudyPicture& picture : pictures) {
        const std::string bytes = read_file((std::filesystem::path(folder) / picture.file).string());
        text += fmt::format("<figure><img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\"><figcaption>{}</figcaption>"
                            "</figure>",
                            data_uri("image/png", bytes), picture.width, picture.height, html_escape(picture.caption),
                            html_escape(picture.caption));
    }
    return text + "</div>\n";
}

std::string all_pictures(const Analysis& analysis, const std::vector<std::vector<StudyPicture>>& pictures,
                         const std::string& folder)
{
    std::string text;
    for (std::size_t i = 0; i < pictures.size(); ++i)
        if (!pictures[i].empty()) text += pictures_of(pictures[i], analysis.configurations[i].name, folder);
    return text;
}

std::string references(const Study& study)
{
    std::string text, last;
    for (const StudiedConfiguration& studied : study.configurations) {
        if (!studied.reference || studied.reference->description == last) continue;
        const Reference& reference = *studied.reference;
        last = reference.description;
        text += paragraph(fmt::format("Reference: {}{}. Its variance is {}, known to {}.", last,
                                      reference.from_cache ? " (kept from an earlier study)" : "",
                                      short_text(reference.floor), short_text(reference.floor_error)));
    }
    return text;
}

std::string machine(const Study& study)
{
    const MachineState &before = study.before, &after = study.after;
    return paragraph(fmt::format("{}; load {:.2f} before and {:.2f} after; median clock {:.0f} and {:.0f} MHz, least "
                                 "{:.0f} and {:.0f} MHz. The study took {:.0f} s.",
                                 before.processor.empty() ? "Unknown processor" : before.processor, before.load_average,
                                 after.load_average, before.median_mhz, after.median_mhz, before.least_mhz,
                                 after.least_mhz, study.seconds));
}
} // namespace

std::string converge_report(const Study& study, const Analysis& analysis,
                            const std::vector<std::vector<StudyPicture>>& pictures, const std::string& folder)
{
    const Scene& scene = study.configurations.front().prepared.scene;
    std::string body = STYLE;
    body += "<h1>Error against run time: " + html_escape(scene.file) + "</h1>\n";
    body += section("Verdict", verdicts(study, analysis));
    body += section("Error against run time", plots(study, analysis));
    if (analysis.configurations.size() > 1)
        body += section("How many times better the row is than the column", ratio_table(analysis));
    body += section("Time to a target", target_table(analysis));
    body += section("Fits", fit_table(analysis));
    body += section("The three parts of the verdict", verdict_table(analysis));
    body += section("Pictures", all_pictures(analysis, pictures, folder));
    body += section("How far the film's own estimate of its error is off", calibration_table(analysis));
    body += section("Phases", phase_table(study));
    body += section("The bench on a furnace of known error", self_check_table(study));
    body += section("How it was measured", references(study) + setting_table(study) + machine(study) + "<pre><code>" +
                                               html_escape(study.options.command) + "</code></pre>\n");
    return html_page("Error against run time: " + scene.file, body);
}
} // namespace etendue
