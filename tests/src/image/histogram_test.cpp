// Histograms of p-values: the heights of bars, and that they can be drawn.
#include "image/histogram.h"

#include "image/plot.h"
#include "support/pattern.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace etendue;

namespace
{
std::vector<double> bar_heights(const std::string& svg)
{
    std::vector<double> heights;
    for (const std::string& height : matches(svg, "plot-bar[^>]* height=\"([0-9.]+)\"", 1))
        heights.push_back(std::stod(height));
    return heights;
}
} // namespace

TEST_CASE("bars are as high as their shares, and NaNs have none", "[image][histogram]")
{
    // 4, 2, 0 and 1 of four quarters; 1 itself is in the last.
    const std::vector<double> values{0.0, 0.1, 0.2, 0.24, 0.3, 0.4, 1.0, NAN};
    const std::string svg = p_value_histogram_svg(values, 4);
    const std::vector<double> heights = bar_heights(svg);
    REQUIRE(heights.size() == 4);
    CHECK(heights[0] == Approx(2 * heights[1]).margin(0.02));
    CHECK(heights[0] == Approx(4 * heights[3]).margin(0.04));
    CHECK(heights[2] == 0.0);
    CHECK(!svg_png(svg, 1).empty());
}

TEST_CASE("uniform values stand within the band of chance, others do not", "[image][histogram]")
{
    const auto band_and_bars = [](const std::vector<double>& values) {
        const std::string svg = p_value_histogram_svg(values, 10);
        const auto bands = matches(svg, "plot-floor\"[^>]* y=\"([0-9.]+)\"", 1);
        const auto bars = matches(svg, "plot-bar[^>]* y=\"([0-9.]+)\"", 1);
        REQUIRE(!bands.empty());
        REQUIRE(!bars.empty());
        double highest = 1e9;
        for (const std::string& top : bars) highest = std::min(highest, std::stod(top));
        return std::pair(std::stod(bands[0]), highest);
    };
    std::vector<double> uniform, small;
    for (int i = 0; i < 1000; ++i) {
        uniform.push_back((i + 0.5) / 1000);
        small.push_back(uniform.back() * uniform.back());
    }
    const auto [band_top, bar_top] = band_and_bars(uniform);
    CHECK(bar_top > band_top);
    const auto [other_band_top, other_bar_top] = band_and_bars(small);
    CHECK(other_bar_top < other_band_top);
    CHECK(!svg_png(p_value_histogram_svg({}), 1).empty());
}
