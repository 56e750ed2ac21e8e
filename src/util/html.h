// Pages that stand alone in one file: a style sheet, and the parts that reports are made of. Every text argument is
// escaped here; only what is called markup is taken as it is.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace etendue
{
// Text as it must stand between tags and within quotes. Control characters, which HTML has no place for, become U+FFFD.
std::string html_escape(std::string_view text);

// "data:image/png;base64,...".
std::string data_uri(const std::string& mime, std::string_view bytes);

// A whole page; `title` is the window's, `body` is markup and begins with its <h1>. Readable from 400 pixels of width
// on, on light and dark.
std::string html_page(const std::string& title, const std::string& body);

// What a word says at a glance: by its colour, and by an icon too.
enum class HtmlMark { none, good, bad, caution };

// Text of a table's cell or of a definition.
struct HtmlCell {
    HtmlCell(std::string words, HtmlMark meaning = HtmlMark::none) : text(std::move(words)), mark(meaning) {}
    HtmlCell(const char* words) : text(words) {}

    std::string text;
    HtmlMark mark = HtmlMark::none;
};

// The box at the top of a report: one word and what it means.
std::string html_verdict(HtmlMark mark, const std::string& word, const std::string& meaning);

// A part of the page under a heading of the second rank; `body` is markup.
std::string html_section(const std::string& heading, const std::string& body);

std::string html_paragraph(const std::string& text);

// Columns of which every cell begins like a number are set to the right. A table that is too wide scrolls by itself,
// with a bar and a shadow that say so.
std::string html_table(const std::string& caption, const std::vector<std::string>& head,
                       const std::vector<std::vector<HtmlCell>>& rows);

// Names and what they stand for, side by side.
struct HtmlDefinition {
    std::string name;
    HtmlCell value;
};
std::string html_definitions(const std::vector<HtmlDefinition>& definitions);

// A command or file, in a block whose long lines wrap.
std::string html_code(const std::string& text);

struct HtmlPicture {
    std::string caption;
    std::string description; // for those who cannot see it
    std::string mime, bytes;
    int width = 0, height = 0; // in pixels; small pictures are shown larger, their pixels as squares
    std::string note = {};     // markup below the caption, e.g. a scale
};
// Figures side by side, as many as fit.
std::string html_figures(const std::vector<HtmlPicture>& pictures);

// A drawing as it is, scrolling by itself where it would become too small to read.
std::string html_drawing(const std::string& caption, const std::string& svg);

// A bar of colours (CSS) from left to right, and the texts below its ends and middle.
std::string html_scale(const std::vector<std::string>& colors, const std::string& left, const std::string& middle,
                       const std::string& right);
} // namespace etendue
