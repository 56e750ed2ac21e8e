// Fills in what image/plot.h draws.
#include "converge/converge_plots.h"

#include "image/plot.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace etendue
{
namespace
{
// The band of a mean on an axis of logarithms: as far below as above.
PlotSeries series_of(const ConfigurationAnalysis& configuration, const std::string& metric, TimeAxis axis)
{
    PlotSeries series;
    series.name = configuration.name;
    for (const CurvePoint& point : configuration.curve) {
        const Interval& error = point.shown.at(metric);
        const double x = axis == TimeAxis::render ? point.render_seconds : point.total_seconds;
        if (!(error.estimate > 0.0 && x > 0.0)) continue;
        series.x.push_back(x);
        series.y.push_back(error.estimate);
        const bool banded = std::isfinite(error.high);
        const double factor = banded ? error.high / error.estimate : 1.0;
        series.low.push_back(error.estimate / factor);
        series.high.push_back(error.estimate * factor);
    }
    return series;
}

std::string label_of(const std::string& metric)
{
    for (const MetricName& name : metric_names())
        if (metric == name.name) return name.label;
    return metric;
}

double floor_of(const Study& study, const std::string& metric)
{
    double floor = 0.0;
    for (const StudiedConfiguration& studied : study.configurations) {
        if (!studied.reference) continue;
        if (metric == "mse") floor = std::max(floor, studied.reference->floor);
        if (metric == "relmse")
            floor = std::max(floor, relative_floor(*studied.reference, study.options.metric_settings));
    }
    return floor;
}
} // namespace

std::string convergence_svg(const Study& study, const Analysis& analysis, const std::string& metric, TimeAxis axis)
{
    LogLogPlot plot;
    const std::string& scene = study.configurations.front().prepared.scene.file;
    const std::string name = label_of(metric);
    plot.title = fmt::format("{} of {}", name, std::filesystem::path(scene).filename().string());
    plot.x_label = axis == TimeAxis::render ? "seconds of rendering" : "seconds from a cold start";
    plot.y_label = name;
    for (const ConfigurationAnalysis& configuration : analysis.configurations) {
        PlotSeries series = series_of(configuration, metric, axis);
        if (!series.x.empty()) plot.series.push_back(std::move(series));
    }
    const bool is_square = metric == "mse" || metric == "relmse" || metric == "trimmed_relmse";
    if (!plot.series.empty() && axis == TimeAxis::render && is_square)
        plot.guides.push_back({"slope −1", -1.0, plot.series.front().x.front(), plot.series.front().y.front()});
    plot.grey_below = FLOOR_MULTIPLE * floor_of(study, metric);
    return plot_svg(plot);
}
} // namespace etendue
