// The page, section by section.
#include "converge/converge_report.h"

#include "converge/converge_plots.h"
#include "converge/number_text.h"
#include "converge/report_tables.h"
#include "converge/study_pictures.h"
#include "util/html.h"

#include <filesystem>

#include <fmt/format.h>

namespace etendue
{
namespace
{
HtmlMark mark_of(BiasResult result)
{
    switch (result) {
    case BiasResult::unbiased:
        return HtmlMark::good;
    case BiasResult::biased:
    case BiasResult::failed:
        return HtmlMark::bad;
    case BiasResult::underpowered:
    case BiasResult::unknown:
        break;
    }
    return HtmlMark::caution;
}

std::string verdict_of(const ConfigurationAnalysis& configuration)
{
    const BiasVerdict& verdict = configuration.verdict;
    std::string meaning;
    for (const std::string& reason : verdict.reasons) meaning += (meaning.empty() ? "" : " ") + reason;
    if (verdict.result == BiasResult::unbiased && !verdict.exact)
        meaning = fmt::format("No floor under the errors, tiles that differ as chance makes them, and no bias of the "
                              "mean: one of {} would have been seen with 99 % certainty.",
                              percent_text(verdict.detectable_bias));
    return html_verdict(mark_of(verdict.result),
                        fmt::format("{}: {}", configuration.name, bias_result_name(verdict.result)), meaning);
}

std::string verdicts(const Study& study, const Analysis& analysis)
{
    std::string text;
    if (study.interrupted)
        text += html_verdict(HtmlMark::caution, "Interrupted", "This is what the study had until then.");
    if (!analysis.bench_passed)
        text += html_verdict(HtmlMark::bad, "The bench is wrong",
                             "It does not measure the furnace's known error, so nothing here can be trusted.");
    for (const ConfigurationAnalysis& configuration : analysis.configurations) text += verdict_of(configuration);
    for (const std::string& warning : study.warnings) text += html_paragraph("Warning: " + warning);
    return text;
}

std::string plots(const Study& study, const Analysis& analysis)
{
    std::string text;
    for (const std::string& metric : study.options.metrics) {
        text += html_drawing("Against the time of rendering alone.",
                             convergence_svg(study, analysis, metric, TimeAxis::render));
        text +=
            html_drawing("Against the time since a cold start: loading, building the tree and compiling come first.",
                         convergence_svg(study, analysis, metric, TimeAxis::total));
    }
    return text + html_paragraph("Means over the seeds with their 95 % intervals. The reference's own variance is "
                                 "subtracted from MSE and relMSE; in the grey it is too near for any conclusion.");
}

std::string pictures(const Study& study)
{
    std::string text;
    for (const StudiedConfiguration& studied : study.configurations) {
        const std::vector<HtmlPicture> of_configuration = study_pictures(studied);
        if (of_configuration.empty()) continue;
        text += "<h3>" + html_escape(studied.prepared.configuration.name) + "</h3>\n" + html_figures(of_configuration);
    }
    return text;
}

std::string page_title(const Study& study)
{
    const std::string& file = study.configurations.front().prepared.scene.file;
    return "Error against run time: " + std::filesystem::path(file).filename().string();
}
} // namespace

std::string converge_report(const Study& study, const Analysis& analysis)
{
    std::string body = "<h1>" + html_escape(page_title(study)) + "</h1>\n";
    body += verdicts(study, analysis);
    body += html_section("Error against run time", plots(study, analysis));
    if (analysis.configurations.size() > 1) body += html_section("Which is better", ratio_table(analysis));
    body += html_section("Time to a target", target_table(analysis));
    body += html_section("Fits", fit_table(analysis));
    body += html_section("What the verdict rests on", verdict_table(analysis));
    body += html_section("Pictures", pictures(study));
    body += html_section("The film's own estimate of its error", calibration_table(analysis));
    body += html_section("Phases", phase_tables(study));
    body += html_section("The bench on a furnace of known error", self_check_table(study));
    body += html_section("How it was measured", setting_list(study) + html_code(study.options.command));
    return html_page(page_title(study), body);
}
} // namespace etendue
