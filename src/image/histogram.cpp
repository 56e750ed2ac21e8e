// Bars, and what chance allows them.
#include "image/histogram.h"

#include "image/plot_style.h"
#include "util/statistics.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr double WIDTH = 480, HEIGHT = 250, LEFT = 56, RIGHT = 16, TOP = 16, BOTTOM = 52;
constexpr double AXIS_WIDTH = WIDTH - LEFT - RIGHT, AXIS_HEIGHT = HEIGHT - TOP - BOTTOM;
constexpr double BAND_ALPHA = 1e-3;

double height_of(double share, double highest)
{
    return AXIS_HEIGHT * std::min(1.0, share / highest);
}

std::string tick(double value, double highest)
{
    return fmt::format("<text class=\"plot-tick\" x=\"{}\" y=\"{:.2f}\" text-anchor=\"end\">{:.3g} %</text>\n",
                       LEFT - 6, TOP + AXIS_HEIGHT - height_of(value, highest) + 4.5, 100.0 * value);
}
} // namespace

std::string p_value_histogram_svg(const std::vector<double>& p_values, std::size_t bins)
{
    std::vector<double> shares(bins, 0.0);
    double count = 0.0;
    for (const double p : p_values) {
        if (std::isnan(p)) continue;
        ++shares[std::min(bins - 1, static_cast<std::size_t>(p * static_cast<double>(bins)))];
        ++count;
    }
    for (double& share : shares) share /= std::max(1.0, count);

    // A bin of uniform values is binomial, here taken as normal.
    const double expected = 1.0 / static_cast<double>(bins);
    const double sigma = std::sqrt(expected * (1.0 - expected) / std::max(1.0, count));
    const double reach = -normal_quantile(sidak_alpha(BAND_ALPHA, bins) / 2) * sigma;
    const double low = std::max(0.0, expected - reach), high = std::min(1.0, expected + reach);
    const double highest = 1.08 * std::max(high, *std::max_element(shares.begin(), shares.end()));

    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot small\" role=\"img\" aria-label=\"Histogram of "
        "p-values\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n<style>{2}</style>\n"
        "<title>Histogram of p-values</title>\n<rect class=\"plot-paper\" width=\"100%\" height=\"100%\"/>\n",
        WIDTH, HEIGHT, PLOT_STYLE);
    const double base = TOP + AXIS_HEIGHT, step = AXIS_WIDTH / static_cast<double>(bins);
    svg += fmt::format("<rect class=\"plot-floor\" x=\"{}\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\"/>\n", LEFT,
                       base - height_of(high, highest), AXIS_WIDTH, height_of(high, highest) - height_of(low, highest));
    for (std::size_t i = 0; i < bins; ++i) {
        const double height = height_of(shares[i], highest);
        svg += fmt::format("<rect class=\"plot-bar plot-s0\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" "
                           "height=\"{:.2f}\"/>\n",
                           LEFT + step * (static_cast<double>(i) + 0.1), base - height, 0.8 * step, height);
    }
    const double middle = base - height_of(expected, highest);
    svg += fmt::format("<line class=\"plot-guide\" x1=\"{0}\" y1=\"{1:.2f}\" x2=\"{2}\" y2=\"{1:.2f}\" "
                       "stroke-dasharray=\"6 4\"/>\n",
                       LEFT, middle, LEFT + AXIS_WIDTH);
    svg += fmt::format("<line class=\"plot-guide\" x1=\"{0}\" y1=\"{1}\" x2=\"{2}\" y2=\"{1}\"/>\n", LEFT, base,
                       LEFT + AXIS_WIDTH);
    svg += tick(expected, highest) + tick(0.0, highest);
    if (highest > 2.5 * expected) svg += tick(highest / 1.08, highest);
    for (const double p : {0.0, 0.25, 0.5, 0.75, 1.0})
        svg += fmt::format("<text class=\"plot-tick\" x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{}</text>\n",
                           LEFT + AXIS_WIDTH * p, base + 19, p);
    return svg + fmt::format("<text class=\"plot-label\" x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">p-value"
                             "</text>\n</svg>\n",
                             LEFT + AXIS_WIDTH / 2, base + 42);
}
} // namespace etendue
