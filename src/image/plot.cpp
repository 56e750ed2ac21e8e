// Axes, bands, lines, markers and a legend, from back to front.
#include "image/plot.h"

#include "image/plot_axis.h"
#include "image/plot_style.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr double LEFT = 84.0, RIGHT = 22.0, TOP = 46.0, BOTTOM = 62.0; // margins around the axes
constexpr double LEGEND_LINE = 24.0, LEGEND_SAMPLE = 46.0;             // height of an entry; width of its line
constexpr double CHARACTER = 7.4;                                      // width of one, at most, at the plot's font size
constexpr double BAND_REACH = 10.0; // bands wider than this factor do not make the axis longer

struct Point {
    double x = 0.0, y = 0.0;
};

// Places of numbers within the picture.
struct Frame {
    LogAxis x, y;
    double width = 0.0, height = 0.0; // of the axes

    Point at(double u, double v) const { return {LEFT + u * width, TOP + (1.0 - v) * height}; }
    Point place(double px, double py) const { return at(x.position(px), std::clamp(y.position(py), 0.0, 1.0)); }
};

// What a legend says of a line.
struct LegendEntry {
    std::string name;
    std::string sample; // SVG with its middle at 0, 0
};

// The values that the vertical axis reaches.
std::vector<double> vertical_values(const LogLogPlot& plot)
{
    std::vector<double> values;
    for (const PlotSeries& series : plot.series) {
        values.insert(values.end(), series.y.begin(), series.y.end());
        for (std::size_t i = 0; i < series.low.size(); ++i) {
            values.push_back(std::max(series.low[i], series.y[i] / BAND_REACH));
            values.push_back(std::min(series.high[i], series.y[i] * BAND_REACH));
        }
    }
    return values;
}

std::vector<double> horizontal_values(const LogLogPlot& plot)
{
    std::vector<double> values;
    for (const PlotSeries& series : plot.series) values.insert(values.end(), series.x.begin(), series.x.end());
    return values;
}

void check_sizes(const LogLogPlot& plot)
{
    for (const PlotSeries& series : plot.series) {
        const bool has_band = !series.low.empty() || !series.high.empty();
        if (series.x.size() != series.y.size() ||
            (has_band && (series.low.size() != series.y.size() || series.high.size() != series.y.size())))
            throw std::invalid_argument("a series has another number of x than of y");
    }
}

std::string line(const Point& a, const Point& b, const std::string& attributes)
{
    return fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" {}/>\n", a.x, a.y, b.x, b.y,
                       attributes);
}

std::string tick_text(const TickLabel& label)
{
    if (label.exponent.empty()) return plot_escape(label.text);
    return fmt::format("{}<tspan class=\"plot-exponent\" dy=\"-5\">{}</tspan>", plot_escape(label.text),
                       plot_escape(label.exponent));
}

std::string grid(const Frame& frame)
{
    std::string svg;
    const auto grade = [](const AxisTick& tick) { return tick.is_decade ? "plot-decade" : "plot-between"; };
    for (const AxisTick& tick : frame.x.ticks(8)) {
        const double u = frame.x.position(tick.value);
        svg += line(frame.at(u, 0), frame.at(u, 1), fmt::format("class=\"{}\"", grade(tick)));
        if (tick.is_labelled)
            svg += fmt::format("<text class=\"plot-tick\" x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{}</text>\n",
                               frame.at(u, 0).x, TOP + frame.height + 20, tick_text(tick_label(tick.value)));
    }
    for (const AxisTick& tick : frame.y.ticks(8)) {
        const double v = frame.y.position(tick.value);
        svg += line(frame.at(0, v), frame.at(1, v), fmt::format("class=\"{}\"", grade(tick)));
        if (tick.is_labelled)
            svg += fmt::format("<text class=\"plot-tick\" x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>\n",
                               LEFT - 8, frame.at(0, v).y + 4.5, tick_text(tick_label(tick.value)));
    }
    return svg;
}

std::string grey_zone(const Frame& frame, double below)
{
    if (!is_plottable(below)) return {};
    const double v = std::clamp(frame.y.position(below), 0.0, 1.0);
    if (v == 0.0) return {};
    return fmt::format("<rect class=\"plot-floor\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/>\n",
                       LEFT, frame.at(0, v).y, frame.width, v * frame.height);
}

std::string labels(const Frame& frame, const LogLogPlot& plot, int width)
{
    const auto title_length = static_cast<std::size_t>((width - LEFT - RIGHT) / (1.22 * CHARACTER));
    const double middle = TOP + frame.height / 2;
    return fmt::format(
        "<rect class=\"plot-frame\" x=\"{}\" y=\"{}\" width=\"{:.2f}\" height=\"{:.2f}\"/>\n"
        "<text class=\"plot-title\" x=\"{}\" y=\"28\">{}</text>\n"
        "<text class=\"plot-label\" x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{}</text>\n"
        "<text class=\"plot-label\" x=\"20\" y=\"{:.2f}\" text-anchor=\"middle\" transform=\"rotate(-90 20 {:.2f})\">"
        "{}</text>\n",
        LEFT, TOP, frame.width, frame.height, LEFT, plot_escape(plot_shorten(plot.title, title_length)),
        LEFT + frame.width / 2, TOP + frame.height + 44, plot_escape(plot.x_label), middle, middle,
        plot_escape(plot.y_label));
}

// The part of a guide within the axes (Liang and Barsky 1984).
std::optional<std::array<Point, 2>> clipped_guide(const Frame& frame, const PlotGuide& guide)
{
    if (!is_plottable(guide.x) || !is_plottable(guide.y)) return {};
    const double u0 = frame.x.position(guide.x), v0 = frame.y.position(guide.y);
    const double steepness =
        guide.slope * std::log10(frame.x.high() / frame.x.low()) / std::log10(frame.y.high() / frame.y.low());
    double from = 0.0, to = 1.0;
    if (steepness == 0.0) {
        if (v0 < 0.0 || v0 > 1.0) return {};
    } else {
        const double at_bottom = u0 - v0 / steepness, at_top = u0 + (1.0 - v0) / steepness;
        from = std::max(from, std::min(at_bottom, at_top));
        to = std::min(to, std::max(at_bottom, at_top));
        if (from >= to) return {};
    }
    return std::array{frame.at(from, v0 + steepness * (from - u0)), frame.at(to, v0 + steepness * (to - u0))};
}

std::string guides(const Frame& frame, const LogLogPlot& plot, std::vector<LegendEntry>& legend)
{
    std::string svg;
    for (std::size_t i = 0; i < plot.guides.size(); ++i) {
        const PlotGuide& guide = plot.guides[i];
        const std::string look = fmt::format("class=\"plot-guide\" stroke-dasharray=\"{}\"", plot_guide_dashes(i));
        const auto ends = clipped_guide(frame, guide);
        if (ends) svg += line((*ends)[0], (*ends)[1], look);
        legend.push_back({guide.name + (ends ? "" : " (outside)"), line({-18, 0}, {18, 0}, look)});
    }
    return svg;
}

// Runs of points that can be placed, one after the other.
std::vector<std::vector<std::size_t>> runs_of(const PlotSeries& series)
{
    std::vector<std::vector<std::size_t>> runs(1);
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        if (is_plottable(series.x[i]) && is_plottable(series.y[i]))
            runs.back().push_back(i);
        else if (!runs.back().empty())
            runs.emplace_back();
    }
    if (runs.back().empty()) runs.pop_back();
    return runs;
}

std::string points_text(const std::vector<Point>& points)
{
    std::string text;
    for (const Point& point : points) text += fmt::format("{}{:.2f},{:.2f}", text.empty() ? "" : " ", point.x, point.y);
    return text;
}

// Around the points of a run; what reaches below or above the axes ends at them.
std::string band(const Frame& frame, const PlotSeries& series, const std::vector<std::size_t>& run, std::size_t number)
{
    std::vector<Point> outline;
    const auto edge = [&](std::size_t i, double value, double otherwise) {
        return frame.place(series.x[i], is_plottable(value) ? value : otherwise);
    };
    for (const std::size_t i : run)
        outline.push_back(edge(i, series.high[i], std::isnan(series.high[i]) ? series.y[i] : frame.y.high()));
    for (auto i = run.rbegin(); i != run.rend(); ++i)
        outline.push_back(edge(*i, series.low[*i], std::isnan(series.low[*i]) ? series.y[*i] : frame.y.low()));
    return fmt::format("<polygon class=\"plot-band plot-s{}\" points=\"{}\"/>\n", plot_color_number(number),
                       points_text(outline));
}

std::string series_line(const Frame& frame, const PlotSeries& series, std::size_t number, LegendEntry& entry)
{
    std::string svg, markers;
    const std::string look =
        fmt::format("class=\"plot-line plot-s{}\"{}", plot_color_number(number), plot_dashes(number));
    std::size_t shown = 0;
    for (const std::vector<std::size_t>& run : runs_of(series)) {
        std::vector<Point> points;
        for (const std::size_t i : run) points.push_back(frame.place(series.x[i], series.y[i]));
        svg += fmt::format("<polyline {} points=\"{}\"/>\n", look, points_text(points));
        for (const Point& point : points) markers += plot_marker(number, point.x, point.y);
        shown += points.size();
    }
    const std::size_t missing = series.x.size() - shown;
    entry.name = series.name;
    if (missing > 0) entry.name += fmt::format(" ({} point{} not positive)", missing, missing == 1 ? "" : "s");
    entry.sample = line({-18, 0}, {18, 0}, look) + plot_marker(number, 0, 0);
    return svg + markers;
}

std::string all_series(const Frame& frame, const LogLogPlot& plot, std::vector<LegendEntry>& legend)
{
    std::string bands, lines;
    for (std::size_t number = 0; number < plot.series.size(); ++number) {
        const PlotSeries& series = plot.series[number];
        if (!series.low.empty())
            for (const auto& run : runs_of(series)) bands += band(frame, series, run, number);
        legend.emplace_back();
        lines += series_line(frame, series, number, legend.back());
    }
    return bands + lines;
}

// How the entries of a legend are spread below the axes.
struct LegendLayout {
    std::size_t columns = 1, rows = 0;
    std::size_t longest = 0; // characters that fit into a column
    double column_width = 0.0;
};

LegendLayout legend_layout(const std::vector<LegendEntry>& entries, double width)
{
    LegendLayout layout;
    std::size_t longest = 1;
    for (const LegendEntry& entry : entries) longest = std::max(longest, plot_length(entry.name));
    const double wanted = LEGEND_SAMPLE + CHARACTER * static_cast<double>(longest) + 18;
    layout.columns =
        std::clamp<std::size_t>(static_cast<std::size_t>(width / wanted), 1, std::max<std::size_t>(entries.size(), 1));
    layout.rows = (entries.size() + layout.columns - 1) / layout.columns;
    layout.column_width = std::min(wanted, width);
    layout.longest = static_cast<std::size_t>((layout.column_width - LEGEND_SAMPLE) / CHARACTER);
    return layout;
}

std::string legend_svg(const std::vector<LegendEntry>& entries, const LegendLayout& layout, double top)
{
    std::string svg = "<g class=\"plot-legend\">\n";
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const double x = LEFT + static_cast<double>(i % layout.columns) * layout.column_width;
        const double y = top + LEGEND_LINE * (static_cast<double>(i / layout.columns) + 0.5);
        svg += fmt::format("<g transform=\"translate({:.2f} {:.2f})\">{}</g>"
                           "<text class=\"plot-name\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n",
                           x + 18, y, entries[i].sample, x + LEGEND_SAMPLE, y + 4.5,
                           plot_escape(plot_shorten(entries[i].name, layout.longest)));
    }
    return svg + "</g>\n";
}
} // namespace

std::string plot_svg(const LogLogPlot& plot, int width, int height)
{
    check_sizes(plot);
    Frame frame{LogAxis(horizontal_values(plot)), LogAxis(vertical_values(plot)), width - LEFT - RIGHT,
                height - TOP - BOTTOM - LEGEND_LINE};

    // Draw from back to front.
    std::vector<LegendEntry> legend;
    const std::string below = grey_zone(frame, plot.grey_below);
    if (!below.empty())
        legend.push_back({"too near to the floor", "<rect class=\"plot-floor\" x=\"-18\" y=\"-7\" width=\"36\" "
                                                   "height=\"14\"/>"});
    std::string drawing = below + grid(frame);
    std::vector<LegendEntry> guide_entries, series_entries;
    drawing += guides(frame, plot, guide_entries);
    drawing += all_series(frame, plot, series_entries);
    drawing += labels(frame, plot, width);
    legend.insert(legend.begin(), guide_entries.begin(), guide_entries.end());
    legend.insert(legend.begin(), series_entries.begin(), series_entries.end());

    // The legend takes the space it needs.
    const LegendLayout layout = legend_layout(legend, frame.width);
    const double top = TOP + frame.height + BOTTOM - 6;
    const double total = top + LEGEND_LINE * static_cast<double>(std::max<std::size_t>(layout.rows, 1)) + 6;
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" role=\"img\" aria-label=\"{0}\" "
                       "width=\"{1}\" height=\"{2:.0f}\" viewBox=\"0 0 {1} {2:.0f}\">\n"
                       "<style>{3}</style>\n<title>{0}</title>\n"
                       "<rect class=\"plot-paper\" width=\"100%\" height=\"100%\"/>\n{4}{5}</svg>\n",
                       plot_escape(plot.title), width, total, PLOT_STYLE, drawing, legend_svg(legend, layout, top));
}
} // namespace etendue
