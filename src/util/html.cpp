// Markup by hand: no scripts, no fonts, nothing from elsewhere.
#include "util/html.h"

#include "util/html_style.h"

#include <algorithm>
#include <cctype>
#include <cstdint>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr int LARGE_PICTURE = 480; // wider ones are shown smooth

struct MarkLook {
    const char* name; // of the class
    const char* icon;
};

MarkLook look_of(HtmlMark mark)
{
    switch (mark) {
    case HtmlMark::good:
        return {"good", "✓"};
    case HtmlMark::bad:
        return {"bad", "✗"};
    case HtmlMark::caution:
        return {"caution", "!"};
    case HtmlMark::none:
        break;
    }
    return {"none", ""};
}

std::string cell_markup(const HtmlCell& cell)
{
    if (cell.mark == HtmlMark::none) return html_escape(cell.text);
    const MarkLook look = look_of(cell.mark);
    return fmt::format("<span class=\"mark {}\"><span aria-hidden=\"true\">{}</span> {}</span>", look.name, look.icon,
                       html_escape(cell.text));
}

// A digit behind signs, or one of the texts that stand for a number.
bool is_number_like(const std::string& text)
{
    std::string_view rest = text;
    for (const char* const sign : {"-", "−", "+", "±", "<", ">", "≤", "≥", "≈", " "})
        while (rest.starts_with(sign)) rest.remove_prefix(std::string_view(sign).size());
    if (rest.empty() || rest == "–" || rest == "∞" || rest == "inf" || rest == "nan") return true;
    return std::isdigit(static_cast<unsigned char>(rest.front())) != 0;
}

bool is_number_column(const std::vector<std::vector<HtmlCell>>& rows, std::size_t column)
{
    return !rows.empty() && std::all_of(rows.begin(), rows.end(), [column](const std::vector<HtmlCell>& row) {
        return column >= row.size() || is_number_like(row[column].text);
    });
}
} // namespace

std::string html_escape(std::string_view text)
{
    std::string escaped;
    escaped.reserve(text.size());
    for (const char c : text) {
        if (c == '&')
            escaped += "&amp;";
        else if (c == '<')
            escaped += "&lt;";
        else if (c == '>')
            escaped += "&gt;";
        else if (c == '"')
            escaped += "&quot;";
        else if (c == '\'')
            escaped += "&#39;";
        else if ((static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7f)
            escaped += "\xef\xbf\xbd";
        else
            escaped += c;
    }
    return escaped;
}

std::string data_uri(const std::string& mime, std::string_view bytes)
{
    static const char* const DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string uri = "data:" + mime + ";base64,";
    uri.reserve(uri.size() + (bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        // Three bytes are four digits of six bits (RFC 4648, section 4).
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) uri += k <= count ? DIGITS[bits >> (18 - 6 * k) & 63] : '=';
    }
    return uri;
}

std::string html_page(const std::string& title, const std::string& body)
{
    return fmt::format("<!DOCTYPE html>\n"
                       "<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                       "<meta name=\"color-scheme\" content=\"light dark\">\n"
                       "<link rel=\"icon\" href=\"data:,\">\n"
                       "<title>{0}</title>\n<style>\n{1}</style>\n</head>\n<body>\n<main>\n{2}"
                       "</main>\n<footer>etendue {3}</footer>\n</body>\n</html>\n",
                       html_escape(title), HTML_STYLE, body, ETENDUE_VERSION);
}

std::string html_verdict(HtmlMark mark, const std::string& word, const std::string& meaning)
{
    const MarkLook look = look_of(mark);
    return fmt::format("<div class=\"verdict {}\" role=\"status\"><span class=\"icon\" aria-hidden=\"true\">{}</span>"
                       "<div><strong>{}</strong><p>{}</p></div></div>\n",
                       look.name, look.icon, html_escape(word), html_escape(meaning));
}

std::string html_section(const std::string& heading, const std::string& body)
{
    return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", html_escape(heading), body);
}

std::string html_paragraph(const std::string& text)
{
    return fmt::format("<p>{}</p>\n", html_escape(text));
}

std::string html_table(const std::string& caption, const std::vector<std::string>& head,
                       const std::vector<std::vector<HtmlCell>>& rows)
{
    std::vector<const char*> alignment;
    for (std::size_t i = 0; i < head.size(); ++i)
        alignment.push_back(is_number_column(rows, i) ? " class=\"number\"" : "");

    const std::string label = html_escape(caption);
    std::string html = fmt::format("<div class=\"scroll\" role=\"region\" aria-label=\"{}\" tabindex=\"0\"><table>\n",
                                   caption.empty() ? "Table" : label);
    if (!caption.empty()) html += fmt::format("<caption>{}</caption>\n", label);
    html += "<thead><tr>";
    for (std::size_t i = 0; i < head.size(); ++i)
        html += fmt::format("<th scope=\"col\"{}>{}</th>", alignment[i], html_escape(head[i]));
    html += "</tr></thead>\n<tbody>\n";
    for (const std::vector<HtmlCell>& row : rows) {
        html += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i)
            html += fmt::format("<td{}>{}</td>", i < alignment.size() ? alignment[i] : "", cell_markup(row[i]));
        html += "</tr>\n";
    }
    return html += "</tbody>\n</table></div>\n";
}

std::string html_definitions(const std::vector<HtmlDefinition>& definitions)
{
    std::string html = "<dl>\n";
    for (const HtmlDefinition& definition : definitions)
        html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", html_escape(definition.name),
                            cell_markup(definition.value));
    return html += "</dl>\n";
}

std::string html_code(const std::string& text)
{
    return fmt::format("<pre><code>{}</code></pre>\n", html_escape(text));
}

std::string html_figures(const std::vector<HtmlPicture>& pictures)
{
    std::string html = "<div class=\"figures\">\n";
    for (const HtmlPicture& picture : pictures)
        html += fmt::format("<figure><img src=\"{}\" alt=\"{}\" width=\"{}\" height=\"{}\"{}>"
                            "<figcaption>{}{}</figcaption></figure>\n",
                            data_uri(picture.mime, picture.bytes), html_escape(picture.description), picture.width,
                            picture.height, picture.width < LARGE_PICTURE ? " class=\"pixels\"" : "",
                            html_escape(picture.caption), picture.note);
    return html += "</div>\n";
}

std::string html_drawing(const std::string& caption, const std::string& svg)
{
    // What stands before the root element of a file has no place within a page.
    const std::size_t root = svg.find("<svg");
    return fmt::format("<figure class=\"drawing\"><div class=\"scroll\" role=\"region\" aria-label=\"{0}\" "
                       "tabindex=\"0\">{1}</div><figcaption>{0}</figcaption></figure>\n",
                       html_escape(caption), root == std::string::npos ? svg : svg.substr(root));
}

std::string html_scale(const std::vector<std::string>& colors, const std::string& left, const std::string& middle,
                       const std::string& right)
{
    return fmt::format("<span class=\"scale\"><span class=\"bar\" style=\"background:linear-gradient(to right,{})\">"
                       "</span><span class=\"ends\"><span>{}</span><span>{}</span><span>{}</span></span></span>",
                       html_escape(fmt::format("{}", fmt::join(colors, ","))), html_escape(left), html_escape(middle),
                       html_escape(right));
}
} // namespace etendue
