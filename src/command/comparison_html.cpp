// The page of a comparison: the verdict first, then what it rests on.
#include "command/comparison_report.h"
#include "image/false_color.h"
#include "image/histogram.h"
#include "image/image_io.h"
#include "util/html.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr double DARKEST_MEAN = 0.02, BRIGHTEST_MEAN = 1.0; // means that are shown as they are
constexpr double GREY = 0.18;                               // the mean that others are brought to

std::string file_name(const std::string& path)
{
    return std::filesystem::path(path).filename().string();
}

std::string percent(double share)
{
    return std::isfinite(share) ? fmt::format("{:.2g} %", 100.0 * share) : "–";
}

// Stops that bring pictures of any brightness into what a display shows.
double exposure_of(double mean)
{
    if (!std::isfinite(mean) || mean <= 0.0 || (mean >= DARKEST_MEAN && mean <= BRIGHTEST_MEAN)) return 0.0;
    return std::round(std::log2(GREY / mean));
}

HtmlPicture figure_of(const Image& image, double exposure, const std::string& caption, const std::string& description)
{
    return {caption, description, "image/png", png_bytes(image, {ToneMap::srgb, exposure}), image.width, image.height};
}

std::string verdict_box(const ComparisonReport& report)
{
    const Comparison& c = report.comparison;
    std::string meaning;
    for (const std::string& sentence : c.failures) meaning += sentence + ' ';
    if (c.passed() && !c.identical)
        meaning =
            fmt::format("A difference of {} of the mean in the whole picture, or of {} of it within a tile of {}x{} "
                        "pixels, would have been seen with 99 % certainty.",
                        percent(c.detectable_bias()), percent(c.detectable_in_tile()), c.tiles.tile, c.tiles.tile);
    if (c.passed() && c.identical) meaning = "R, G and B of every pixel are the same numbers.";
    std::string html = html_verdict(c.passed() ? HtmlMark::good : HtmlMark::bad, verdict_text(report), meaning);
    for (const std::string& remark : c.remarks) html += html_paragraph("Note: " + remark);
    return html;
}

std::string pictures(const ComparisonReport& report)
{
    const Comparison& c = report.comparison;
    const double exposure = exposure_of(c.metrics.reference_mean), scale = error_scale(report.a.image, report.b.image);
    const std::string shown = exposure == 0.0 ? "" : fmt::format(", {:+g} stops", exposure);
    std::vector<HtmlPicture> figures{
        figure_of(report.a.image, exposure, fmt::format("A: {}{}", file_name(report.a.path), shown), "Picture A"),
        figure_of(report.b.image, exposure, fmt::format("B, the reference: {}{}", file_name(report.b.path), shown),
                  "Picture B, the reference"),
        figure_of(signed_error_image(report.a.image, report.b.image, scale), 0.0,
                  "Signed error A − B, of the channel that is off most",
                  "Signed error: blue where A is darker than B, red where it is brighter"),
        figure_of(p_value_image(c.tiles), 0.0, "p-values: the least of three channels in each tile",
                  "p-values of tiles: light where the difference is more than noise explains")};

    std::vector<std::string> error_colors, p_colors;
    for (int i = 0; i <= 16; ++i) {
        error_colors.push_back(css_color(signed_error_color(i / 8.0 - 1.0)));
        p_colors.push_back(css_color(p_value_color(std::pow(10.0, -6.0 * i / 16.0))));
    }
    figures[2].note = html_scale(error_colors, fmt::format("−{:g}", scale), "0", fmt::format("+{:g}", scale));
    figures[3].note = html_scale(p_colors, "p = 1", "0.001", "10⁻⁶ and less");
    return html_figures(figures);
}

std::string metrics_table(const ComparisonReport& report)
{
    const Metrics& m = report.comparison.metrics;
    std::vector<std::vector<HtmlCell>> rows;
    for (const MetricName& name : metric_names())
        if (std::count(report.metrics.begin(), report.metrics.end(), name.name) > 0)
            rows.push_back({name.label, fmt::format("{:.6g}", m.*name.value), name.definition});
    rows.push_back({"pixels not finite",
                    HtmlCell(std::to_string(m.non_finite), m.non_finite > 0 ? HtmlMark::bad : HtmlMark::none),
                    "in A or in B; left out of the numbers above"});
    rows.push_back({"pixels below 0",
                    HtmlCell(std::to_string(m.negative), m.negative > 0 ? HtmlMark::caution : HtmlMark::none), "in A"});
    return html_table("x is A, r is the reference B; means over pixels and channels, in double precision",
                      {"metric", "value", "definition"}, rows);
}

std::string tests_table(const ComparisonReport& report)
{
    const Comparison& c = report.comparison;
    const auto word = [](bool failed) {
        return HtmlCell(failed ? "differs" : "no difference", failed ? HtmlMark::bad : HtmlMark::good);
    };
    const std::string worst =
        c.tiles.tests > 0 ? fmt::format("worst z = {:.3g}, {}", c.tiles.worst_z, place_of_worst(c.tiles)) : "–";
    std::vector<std::vector<HtmlCell>> rows;
    rows.push_back({"some tile", word(c.tiles.below_alpha > 0),
                    fmt::format("{} of {} tests with p < {:.2g}; {}", c.tiles.below_alpha, c.tiles.tests,
                                c.tiles.test_alpha, worst)});
    rows.push_back(
        {"all tiles together",
         std::isnan(c.tiles.ks_p_value) ? HtmlCell("not tested", HtmlMark::caution)
                                        : word(c.tiles.excess_p_value < c.test_alpha),
         fmt::format("p = {:.3g} that so many p-values are small by chance; p = {:.3g} that they are uniform",
                     c.tiles.excess_p_value, c.tiles.ks_p_value)});
    rows.push_back({"the whole picture", word(c.whole.below_alpha > 0),
                    fmt::format("worst z of the three channels' means = {:.3g}", c.whole.worst_z)});
    return html_table(fmt::format("Each of the three tests has the level {:.2g}: together at most {:g}", c.test_alpha,
                                  report.settings.alpha),
                      {"test", "finding", "what was found"}, rows);
}

std::string files_list(const ComparisonReport& report)
{
    std::vector<HtmlDefinition> definitions;
    const auto add = [&](const std::string& name, const ComparedPicture& picture) {
        const Image& image = picture.image;
        definitions.push_back({name, picture.path});
        definitions.push_back({name + ": size", fmt::format("{}x{} pixels", image.width, image.height)});
        for (const auto& [key, value] : image.metadata)
            if (key.starts_with("etendue:")) definitions.push_back({name + ": " + key.substr(8), value});
    };
    add("A", report.a);
    add("B", report.b);
    return html_definitions(definitions);
}
} // namespace

double error_scale(const Image& a, const Image& b)
{
    const std::vector<Vec3> picture = rgb_values(a), reference = rgb_values(b);
    std::vector<double> errors;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const Vec3 error = glm::abs(picture[i] - reference[i]);
        const double largest = std::max({error.x, error.y, error.z});
        if (std::isfinite(largest)) errors.push_back(largest);
    }
    if (errors.empty()) return 1.0;
    std::sort(errors.begin(), errors.end());
    double wanted = errors[(errors.size() - 1) * 99 / 100];
    if (wanted == 0.0) wanted = errors.back();
    if (wanted == 0.0) return 1.0;
    const double power = std::pow(10.0, std::floor(std::log10(wanted)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (wanted <= digit * power) return digit * power;
    return 10.0 * power;
}

std::string comparison_html(const ComparisonReport& report)
{
    const std::string title = fmt::format("{} against {}", file_name(report.a.path), file_name(report.b.path));
    std::string body = "<h1>" + html_escape(title) + "</h1>\n" + verdict_box(report);
    body += html_section("Pictures", pictures(report));
    body += html_section("How far apart", metrics_table(report));
    body += html_section(
        "More than noise?",
        html_paragraph(report.comparison.variance_reason) + tests_table(report) +
            html_drawing("p-values of the tiles that have noise. Between equal pictures they are uniform: bars at the "
                         "dashed line, within the grey for independent tests.",
                         p_value_histogram_svg(report.comparison.tiles.noisy_p_values())));
    body += html_section("Files", files_list(report));
    body += html_section("Command", html_code(report.command));
    return html_page(title, body);
}
} // namespace etendue
