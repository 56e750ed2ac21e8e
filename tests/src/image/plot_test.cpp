// Plots: what stands where, that librsvg draws it, and that no name breaks it.
#include "image/plot.h"

#include "image/plot_axis.h"
#include "support/pattern.h"
#include "util/error.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

using namespace etendue;
using Catch::Contains;

namespace
{
using Points = std::vector<std::pair<double, double>>;

// The points of every element whose opening tag has this class and an attribute `points`.
std::vector<Points> points_of(const std::string& svg, const std::string& css_class)
{
    std::vector<Points> found;
    for (std::string text : matches(svg, "<\\w+ class=\"" + css_class + "[^>]*points=\"([^\"]*)\"", 1)) {
        Points points;
        for (char& c : text)
            if (c == ',') c = ' ';
        std::istringstream stream(text);
        for (double x = 0, y = 0; stream >> x >> y;) points.emplace_back(x, y);
        found.push_back(points);
    }
    return found;
}

double attribute(const std::string& svg, const std::string& css_class, const std::string& name)
{
    const auto values =
        matches(svg, "<\\w+ (?=[^>]*class=\"" + css_class + "\")[^>]*\\b" + name + "=\"([-0-9.]+)\"", 1);
    REQUIRE(!values.empty());
    return std::stod(values[0]);
}

std::size_t count(const std::string& text, const std::string& part)
{
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

PlotSeries power_law(const std::string& name, double factor, double slope)
{
    PlotSeries series{name, {}, {}, {}, {}};
    for (double x = 0.1; x < 60.0; x *= 2.0) {
        series.x.push_back(x);
        series.y.push_back(factor * std::pow(x, slope));
        series.low.push_back(0.8 * series.y.back());
        series.high.push_back(1.25 * series.y.back());
    }
    return series;
}

LogLogPlot example()
{
    LogLogPlot plot{"relMSE of scenes/course-box/simple.json", "seconds of rendering", "relMSE", {}, {}, 2e-5};
    plot.series = {power_law("balance", 1e-2, -1.0), power_law("power", 7e-3, -1.02), power_law("none", 9e-2, -0.97),
                   power_law("sobol", 4e-3, -1.3)};
    plot.guides = {{"slope -1", -1.0, 1.0, 3e-2}, {"floor", 0.0, 1.0, 1.2e-5}};
    return plot;
}
} // namespace

TEST_CASE("a power law is a straight line of its slope", "[image][plot]")
{
    LogLogPlot plot{"title", "x", "y", {power_law("a", 3.0, -1.0)}, {}, 0};
    const auto lines = points_of(plot_svg(plot), "plot-line");
    REQUIRE(lines.size() == 1);
    REQUIRE(lines[0].size() == plot.series[0].x.size());

    // Pixels per decade, from the outermost points of a line whose decades are known.
    const Points& points = lines[0];
    const double step_x = points[1].first - points[0].first, step_y = points[1].second - points[0].second;
    CHECK(step_x > 0);
    CHECK(step_y > 0); // SVG counts downwards
    for (std::size_t i = 1; i < points.size(); ++i) {
        CHECK(points[i].first - points[i - 1].first == Approx(step_x).margin(0.02));
        CHECK(points[i].second - points[i - 1].second == Approx(step_y).margin(0.02));
    }
}

TEST_CASE("data, bands, guides and the grey zone stay within the axes, and the legend outside", "[image][plot]")
{
    const std::string svg = plot_svg(example());
    const double left = attribute(svg, "plot-frame", "x"), top = attribute(svg, "plot-frame", "y");
    const double right = left + attribute(svg, "plot-frame", "width");
    const double bottom = top + attribute(svg, "plot-frame", "height");
    for (const char* const css_class : {"plot-line", "plot-band"}) {
        const auto all = points_of(svg, css_class);
        CHECK(all.size() == 4);
        for (const Points& points : all) {
            for (const auto& [x, y] : points) {
                CHECK((x >= left && x <= right));
                CHECK((y >= top && y <= bottom));
            }
        }
    }
    CHECK(attribute(svg, "plot-floor", "y") > top);
    CHECK(attribute(svg, "plot-floor", "y") + attribute(svg, "plot-floor", "height") == Approx(bottom));
    CHECK(attribute(svg, "plot-guide", "x1") >= left);
    CHECK(attribute(svg, "plot-guide", "y2") <= bottom);

    // Every entry of the legend is below the axes, and no wider than the picture.
    const std::string legend = svg.substr(svg.find("plot-legend"));
    CHECK(count(legend, "<text") == 7);
    const std::string place = "class=\"plot-name\" x=\"([0-9.]+)\" y=\"([0-9.]+)\"";
    const auto x = matches(legend, place, 1), y = matches(legend, place, 2);
    REQUIRE(x.size() == 7);
    for (std::size_t i = 0; i < x.size(); ++i) {
        CHECK(std::stod(y[i]) > bottom + 30);
        CHECK(std::stod(x[i]) < 700);
    }
}

TEST_CASE("a guide has the slope of a series of that slope", "[image][plot]")
{
    LogLogPlot plot{"title", "x", "y", {power_law("a", 3.0, -1.0)}, {}, 0};
    plot.guides = {{"slope -1", -1.0, plot.series[0].x[2], plot.series[0].y[2]}, {"away", 0.0, 1.0, 1e9}};
    const std::string svg = plot_svg(plot);
    const double x1 = attribute(svg, "plot-guide", "x1"), x2 = attribute(svg, "plot-guide", "x2");
    const double y1 = attribute(svg, "plot-guide", "y1"), y2 = attribute(svg, "plot-guide", "y2");
    const Points line = points_of(svg, "plot-line")[0];
    const double slope = (line.back().second - line[0].second) / (line.back().first - line[0].first);
    CHECK((y2 - y1) / (x2 - x1) == Approx(slope).epsilon(1e-3));
    CHECK(y1 + slope * (line[0].first - x1) == Approx(line[0].second).margin(0.1));
    CHECK_THAT(svg, Contains("away (outside)"));
}

TEST_CASE("points that have no place on the axes are counted, and break the line", "[image][plot]")
{
    LogLogPlot plot{"title", "x", "y", {{"a", {1, 2, 4, 8, 16}, {1, 0.5, 0.0, NAN, 0.1}, {}, {}}}, {}, 0};
    const std::string svg = plot_svg(plot);
    CHECK_THAT(svg, Contains("a (2 points not positive)"));
    const auto lines = points_of(svg, "plot-line");
    REQUIRE(lines.size() == 2);
    CHECK(lines[0].size() == 2);
    CHECK(lines[1].size() == 1);
    CHECK(!svg_png(svg, 1).empty());
}

TEST_CASE("any text is well-formed, and the picture has the size it should have", "[image][plot]")
{
    LogLogPlot plot = example();
    plot.title = "<script>\"&'\x01\x7f ünïcode " + std::string(200, 'x');
    plot.series[0].name = "a<b & \"c\" ]]> " + std::string(300, 'y');
    plot.x_label = plot.y_label = "&lt;";
    const std::string svg = plot_svg(plot);
    CHECK_THAT(svg, !Contains("<script"));
    const std::string png = svg_png(svg, 2.0);
    REQUIRE(png.substr(1, 3) == "PNG");
    const auto size_at = [&](std::size_t at) {
        return static_cast<unsigned char>(png[at + 2]) * 256 + static_cast<unsigned char>(png[at + 3]);
    };
    CHECK(size_at(16) == 1440);
    CHECK(size_at(20) > 960);
}

TEST_CASE("plots without data, with one point, and with more series than there are colours can be drawn",
          "[image][plot]")
{
    CHECK(!svg_png(plot_svg({}), 1).empty());
    CHECK(!svg_png(plot_svg({"one", "x", "y", {{"a", {1}, {1e-8}, {}, {}}}, {}, 0}), 1).empty());
    LogLogPlot many{"many", "x", "y", {}, {}, 0};
    for (int i = 0; i < 20; ++i) many.series.push_back(power_law("series " + std::to_string(i), i + 1, -1));
    CHECK(points_of(plot_svg(many), "plot-line").size() == 20);
    CHECK(!svg_png(plot_svg(many), 1).empty());
}

TEST_CASE("a drawing that is none is an error", "[image][plot]")
{
    CHECK_THROWS_AS(svg_png("<svg"), Error);
    CHECK_THROWS_AS(svg_png("text"), Error);
}

TEST_CASE("axes mark decades, and at least two numbers however short they are", "[image][plot]")
{
    const auto labels_of = [](const std::vector<double>& values) {
        std::vector<std::string> labels;
        for (const AxisTick& tick : LogAxis(values).ticks(8)) {
            const TickLabel label = tick_label(tick.value);
            if (tick.is_labelled) labels.push_back(label.text + (label.exponent.empty() ? "" : "^" + label.exponent));
        }
        return labels;
    };
    using Labels = std::vector<std::string>;
    CHECK(labels_of({1e-5, 10}) == Labels{"10^−5", "10^−4", "0.001", "0.01", "0.1", "1", "10"});
    CHECK(labels_of({1, 100}) == Labels{"1", "2", "5", "10", "20", "50", "100"});
    CHECK(labels_of({5.2, 9.5}) == Labels{"4", "5", "6", "7", "8", "9", "10"});
    for (double x = 1.0; x < 10.0; x *= 1.01) CHECK(labels_of({x, 1.04 * x}).size() >= 2);
    CHECK(labels_of({1e-30, 1e30}).size() >= 4);
    CHECK(labels_of({1e-30, 1e30}).size() <= 10);
    CHECK(labels_of({0, -1, NAN, INFINITY}) == labels_of({}));

    const LogAxis axis({0.01, 100});
    CHECK(axis.low() < 0.01);
    CHECK(axis.high() > 100);
    CHECK(axis.position(1.0) == Approx(0.5));
}

TEST_CASE("a plot for people to look at is left in the build folder", "[image][plot]")
{
    const std::string folder = ETENDUE_BINARY_DIR "/pictures";
    std::filesystem::create_directories(folder);
    write_file(folder + "/plot.svg", plot_svg(example()));
    write_file(folder + "/plot.png", svg_png(plot_svg(example())));
    CHECK(std::filesystem::file_size(folder + "/plot.png") > 1000);
}
