// Plots of positive numbers against positive numbers, both on logarithmic axes, as SVG written by hand.
#pragma once

#include <string>
#include <vector>

namespace etendue
{
// Points joined by a line; told apart by colour, dashes and markers. What is not positive and finite has no place on
// the axes: it is left out, and the legend says how many points that were.
struct PlotSeries {
    std::string name;
    std::vector<double> x, y;
    std::vector<double> low, high; // the band around y; may be empty
};

// A line of that slope through a point, which the axes do not grow to show.
struct PlotGuide {
    std::string name;
    double slope = 0.0; // 0: a floor
    double x = 1.0, y = 1.0;
};

struct LogLogPlot {
    std::string title, x_label, y_label;
    std::vector<PlotSeries> series;
    std::vector<PlotGuide> guides;
    double grey_below = 0.0; // y below it is shaded: too near to the reference's own error to mean anything
};

// A well-formed picture: text stays text, everything has a class, and within a page it follows light and dark. The
// legend stands below the axes and makes the picture higher than `height` where it needs more than a line.
std::string plot_svg(const LogLogPlot& plot, int width = 720, int height = 480);

// The bytes of a PNG of any SVG, `scale` pixels per unit (by librsvg). Throws Error where it is not well-formed.
std::string svg_png(const std::string& svg, double scale = 2.0);
} // namespace etendue
