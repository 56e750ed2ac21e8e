// Fills in what image/plot.h draws.
#include "converge/converge_plots.h"

#include "image/plot.h"

#include <algorithm>
#include <cmath>

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
        const Interval& error = metric == "mse" ? point.mse : point.relmse;
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

double floor_of(const Study& study, const std::string& metric)
{
    double floor = 0.0;
    for (const StudiedConfiguration& studied : study.configurations) {
        if (!studied.reference) continue;
        floor = std::max(floor, metric == "mse" ? studied.reference->floor
                                                : relative_floor(*studied.reference, study.options.metric_settings));
    }
    return floor;
}
} // namespace

std::string convergence_svg(const Study& study, const Analysis& analysis, const std::string& metric, TimeAxis axis)
{
    LogLogPlot plot;
    const std::string scene = study.configurations.front().prepared.scene.file;
    const std::string name = metric == "mse" ? "MSE" : "relMSE";
    plot.title = fmt::format("{} of {}", name, scene);
    plot.x_label = axis == TimeAxis::render ? "seconds of rendering" : "seconds from a cold start";
    plot.y_label = name;
    for (const ConfigurationAnalysis& configuration : analysis.configurations) {
        PlotSeries series = series_of(configuration, metric, axis);
        if (!series.x.empty()) plot.series.push_back(std::move(series));
    }
    if (!plot.series.empty() && axis == TimeAxis::render)
        plot.guides.push_back({"slope -1", -1.0, plot.series.front().x.front(), plot.series.front().y.front()});
    plot.grey_below = FLOOR_MULTIPLE * floor_of(study, metric);
    return plot_svg(plot);
}
} // namespace etendue
