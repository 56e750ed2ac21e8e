// How the lines of plots look: each series has a colour, dashes and a marker of its own, so that it is told apart
// without colours too.
#pragma once

#include <string>

namespace etendue
{
// The style sheet within a plot. The colours are Okabe and Ito's, which the colour-blind tell apart, darker on light
// and lighter on dark.
extern const char* const PLOT_STYLE;

// Of the class of a series: "plot-s" and this number.
std::size_t plot_color_number(std::size_t series);
// " stroke-dasharray=..." or nothing, of a series; the value alone, of a guide.
std::string plot_dashes(std::size_t series);
std::string plot_guide_dashes(std::size_t guide);
// A marker with its middle at x, y.
std::string plot_marker(std::size_t series, double x, double y);

// Text as XML has it; what XML has no place for becomes U+FFFD.
std::string plot_escape(const std::string& text);
// Characters (of UTF-8), and no more than so many of them, the last an ellipsis where some are missing.
std::size_t plot_length(const std::string& text);
std::string plot_shorten(const std::string& text, std::size_t most);
} // namespace etendue
