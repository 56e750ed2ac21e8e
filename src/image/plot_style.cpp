// Colours, dashes, markers and texts of plots.
#include "image/plot_style.h"

#include "util/html.h"

#include <array>
#include <cstddef>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr std::size_t COLORS = 7;
constexpr std::array DASHES{"", "9 4", "2 3.5", "11 3 2 3", "5 3", "14 4", "8 3 2 3 2 3"};
constexpr std::array GUIDE_DASHES{"3 4", "10 5 3 5", "1 4", "16 5"};

// Outlines around 0, 0 of about the same weight.
constexpr std::array MARKERS{
    "M-4 0A4 4 0 1 0 4 0A4 4 0 1 0 -4 0Z",                                                         // disk
    "M-3.6 -3.6H3.6V3.6H-3.6Z",                                                                    // square
    "M0 -4.8L4.6 3.4H-4.6Z",                                                                       // triangle
    "M0 -5.2L5.2 0L0 5.2L-5.2 0Z",                                                                 // diamond
    "M0 4.8L4.6 -3.4H-4.6Z",                                                                       // triangle downwards
    "M-1.4 -4.8H1.4V-1.4H4.8V1.4H1.4V4.8H-1.4V1.4H-4.8V-1.4H-1.4Z",                                // plus
    "M-4.6 -2.6L-2.6 -4.6L0 -2L2.6 -4.6L4.6 -2.6L2 0L4.6 2.6L2.6 4.6L0 2L-2.6 4.6L-4.6 2.6L-2 0Z", // cross
    "M0 -5.2L1.5 -1.7L5 -1.6L2.2 0.7L3.2 4.3L0 2.2L-3.2 4.3L-2.2 0.7L-5 -1.6L-1.5 -1.7Z"};         // star
} // namespace

const char* const PLOT_STYLE = R"(
.plot text { font: 14px system-ui, "Segoe UI", "Helvetica Neue", "DejaVu Sans", Arial, sans-serif; fill: #1c1e21; }
.plot .plot-title { font-size: 16px; font-weight: 600; }
.plot .plot-tick { font-size: 13px; fill: #44484f; }
.plot .plot-exponent { font-size: 12px; }
.plot-paper { fill: #fdfdfc; }
.plot-floor { fill: #b9bdc4; fill-opacity: .5; }
.plot-decade { stroke: #c9ccd2; stroke-width: 1; }
.plot-between { stroke: #e7e9ec; stroke-width: 1; }
.plot-frame { fill: none; stroke: #5b6068; stroke-width: 1.2; }
.plot-guide { stroke: #5b6068; stroke-width: 1.3; fill: none; }
.plot-line { fill: none; stroke-width: 2; stroke-linejoin: round; }
.plot-band { fill-opacity: .16; stroke: none; }
.plot-marker { stroke: none; }
.plot-s0 { stroke: #0072b2; fill: #0072b2; }
.plot-s1 { stroke: #c24e00; fill: #c24e00; }
.plot-s2 { stroke: #00845f; fill: #00845f; }
.plot-s3 { stroke: #b3558b; fill: #b3558b; }
.plot-s4 { stroke: #2d93cf; fill: #2d93cf; }
.plot-s5 { stroke: #b77d00; fill: #b77d00; }
.plot-s6 { stroke: #303338; fill: #303338; }
.plot .plot-line { fill: none; }
.plot .plot-band, .plot .plot-marker { stroke: none; }
@media (prefers-color-scheme: dark) {
  .plot text { fill: #e6e7e9; }
  .plot .plot-tick { fill: #b9bec7; }
  .plot-paper { fill: #15171a; }
  .plot-floor { fill: #6a7079; }
  .plot-decade { stroke: #41464e; }
  .plot-between { stroke: #282b30; }
  .plot-frame, .plot-guide { stroke: #a3a9b3; }
  .plot-s0 { stroke: #5ab4f0; fill: #5ab4f0; }
  .plot-s1 { stroke: #ff8f47; fill: #ff8f47; }
  .plot-s2 { stroke: #35cba0; fill: #35cba0; }
  .plot-s3 { stroke: #e79cc7; fill: #e79cc7; }
  .plot-s4 { stroke: #9bd6f7; fill: #9bd6f7; }
  .plot-s5 { stroke: #f2be4a; fill: #f2be4a; }
  .plot-s6 { stroke: #dcdde0; fill: #dcdde0; }
}
)";

std::size_t plot_color_number(std::size_t series)
{
    return series % COLORS;
}

std::string plot_dashes(std::size_t series)
{
    const std::string dashes = DASHES[series % DASHES.size()];
    return dashes.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dashes);
}

std::string plot_guide_dashes(std::size_t guide)
{
    return GUIDE_DASHES[guide % GUIDE_DASHES.size()];
}

std::string plot_marker(std::size_t series, double x, double y)
{
    return fmt::format("<path class=\"plot-marker plot-s{}\" transform=\"translate({:.2f} {:.2f})\" d=\"{}\"/>\n",
                       plot_color_number(series), x, y, MARKERS[series % MARKERS.size()]);
}

std::string plot_escape(const std::string& text)
{
    // What is right within HTML is right within XML: the five named characters are the same.
    return html_escape(text);
}

std::size_t plot_length(const std::string& text)
{
    std::size_t length = 0;
    for (const char c : text) length += (static_cast<unsigned char>(c) & 0xc0) != 0x80 ? 1 : 0;
    return length;
}

std::string plot_shorten(const std::string& text, std::size_t most)
{
    if (plot_length(text) <= most) return text;
    std::size_t end = 0;
    for (std::size_t length = 0; end < text.size(); ++end) {
        const bool begins = (static_cast<unsigned char>(text[end]) & 0xc0) != 0x80;
        if (begins && ++length == most) break;
    }
    return text.substr(0, end) + "…";
}
} // namespace etendue
