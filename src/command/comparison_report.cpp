// Text and JSON of a comparison.
#include "command/comparison_report.h"

#include "util/revision.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <json/json.h>

namespace etendue
{
namespace
{
Json::Value number(std::size_t n)
{
    return Json::Value(static_cast<Json::UInt64>(n));
}

// JSON has no infinity: null says "not known".
Json::Value finite_or_null(double x)
{
    return std::isfinite(x) ? Json::Value(x) : Json::Value();
}

std::string picture_text(const char* name, const ComparedPicture& picture)
{
    return fmt::format("{}  {}, {}x{} pixels\n", name, picture.path, picture.image.width, picture.image.height);
}

std::string row(const std::string& label, const std::string& value)
{
    return fmt::format("  {:<24} {}\n", label, value);
}

std::string tests_text(const Comparison& c)
{
    std::string text = fmt::format("Welch's test: {}\n", c.variance_reason);
    text += row("tiles", fmt::format("{0} tests of {1}x{1} pixels and one channel, {2} without noise", c.tiles.tests,
                                     c.tiles.tile, c.tiles.exact));
    text += row("below the level", fmt::format("{} with p < {:.3g}", c.tiles.below_alpha, c.tiles.test_alpha));
    if (c.tiles.tests > 0)
        text += row("worst tile", fmt::format("z = {:.3g}, {}", c.tiles.worst_z, place_of_worst(c.tiles)));
    text += row("uniform p-values",
                fmt::format("p = {:.3g}; too many small ones p = {:.3g}", c.tiles.ks_p_value, c.tiles.excess_p_value));
    text += row("whole picture", fmt::format("z = {:.3g}, the worst of three channels", c.whole.worst_z));
    return text +
           row("could have seen", fmt::format("{:.2g} % of the mean in the whole picture, {:.2g} % of it in a tile",
                                              100.0 * c.detectable_bias(), 100.0 * c.detectable_in_tile()));
}

Json::Value picture_json(const ComparedPicture& picture)
{
    Json::Value json;
    json["file"] = picture.path;
    json["width"] = picture.image.width;
    json["height"] = picture.image.height;
    json["x"] = picture.image.x;
    json["y"] = picture.image.y;
    json["metadata"] = Json::Value(Json::objectValue);
    for (const auto& [name, value] : picture.image.metadata) json["metadata"][name] = value;
    return json;
}

Json::Value metrics_json(const Metrics& m)
{
    Json::Value json;
    for (const MetricName& name : metric_names()) {
        json[name.name] = finite_or_null(m.*name.value);
        json["definitions"][name.name] = name.definition;
    }
    json["reference_mean"] = finite_or_null(m.reference_mean);
    json["non_finite_pixels"] = number(m.non_finite);
    json["negative_pixels"] = number(m.negative);
    json["relative_epsilon"] = MetricSettings{}.relative_epsilon;
    json["trimmed_share"] = MetricSettings{}.trimmed_share;
    return json;
}

Json::Value tests_json(const WelchTiles& t)
{
    Json::Value json;
    json["tile"] = t.tile;
    json["columns"] = t.columns;
    json["rows"] = t.rows;
    json["tests"] = number(t.tests);
    json["without_noise"] = number(t.exact);
    json["untested"] = number(t.untested);
    json["test_alpha"] = t.test_alpha;
    json["below_alpha"] = number(t.below_alpha);
    json["worst_z"] = finite_or_null(t.worst_z);
    json["worst_place"] = place_of_worst(t);
    json["uniformity_p_value"] = finite_or_null(t.ks_p_value);
    json["excess_p_value"] = finite_or_null(t.excess_p_value);
    json["detectable_difference"] = finite_or_null(t.detectable_difference());
    json["p_values"] = Json::Value(Json::arrayValue);
    for (const double p : t.p_values) json["p_values"].append(finite_or_null(p));
    return json;
}

Json::Value sentences_json(const std::vector<std::string>& sentences)
{
    Json::Value json(Json::arrayValue);
    for (const std::string& sentence : sentences) json.append(sentence);
    return json;
}
} // namespace

std::string verdict_text(const ComparisonReport& report)
{
    const Comparison& c = report.comparison;
    if (c.metrics.non_finite > 0) return "Failed: values are not finite";
    if (!c.passed()) return fmt::format("The pictures differ beyond the level {:g}", report.settings.alpha);
    if (c.identical) return "The pictures are equal in every value";
    return fmt::format("No difference at the level {:g}", report.settings.alpha);
}

std::string comparison_text(const ComparisonReport& report)
{
    const Comparison& c = report.comparison;
    std::string text = picture_text("A", report.a) + picture_text("B", report.b) + "\nA against B\n";
    for (const MetricName& name : metric_names())
        if (std::count(report.metrics.begin(), report.metrics.end(), name.name) > 0)
            text += row(name.label, fmt::format("{:<12.6g} {}", c.metrics.*name.value, name.definition));
    text += row("pixels not finite", std::to_string(c.metrics.non_finite));
    text += row("pixels of A below 0", std::to_string(c.metrics.negative));
    text += '\n' + tests_text(c) + '\n' + verdict_text(report) + ".\n";
    for (const std::string& sentence : c.failures) text += "  " + sentence + '\n';
    for (const std::string& sentence : c.remarks) text += "  Note: " + sentence + '\n';
    return text;
}

std::string comparison_json(const ComparisonReport& report)
{
    const Comparison& c = report.comparison;
    Json::Value json;
    json["etendue"] = ETENDUE_VERSION;
    json["revision"] = REVISION;
    json["command"] = report.command;
    json["a"] = picture_json(report.a);
    json["b"] = picture_json(report.b);
    json["passed"] = c.passed();
    json["identical"] = c.identical;
    json["verdict"] = verdict_text(report);
    json["failures"] = sentences_json(c.failures);
    json["remarks"] = sentences_json(c.remarks);
    json["alpha"] = report.settings.alpha;
    json["metrics"] = metrics_json(c.metrics);
    json["variance"] = c.variance == VarianceSource::standard_errors ? "stderr" : "none";
    json["variance_reason"] = c.variance_reason;
    json["tiles"] = tests_json(c.tiles);
    json["whole"] = tests_json(c.whole);
    json["detectable_bias"] = finite_or_null(c.detectable_bias());
    json["detectable_bias_in_tile"] = finite_or_null(c.detectable_in_tile());
    Json::StreamWriterBuilder writer;
    writer["indentation"] = "  ";
    writer["precision"] = 17;
    return Json::writeString(writer, json) + "\n";
}
} // namespace etendue
