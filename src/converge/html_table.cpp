// Rows of cells.
#include "converge/html_table.h"

#include <cmath>

#include <fmt/format.h>

namespace etendue
{
std::string HtmlTable::html() const
{
    std::string text = "<div class=\"scroll\"><table><thead><tr>";
    for (const std::string& cell : head_) text += "<th scope=\"col\">" + cell + "</th>";
    text += "</tr></thead><tbody>";
    for (const auto& row : rows_) {
        text += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i)
            text += i == 0 ? "<th scope=\"row\">" + row[i] + "</th>" : "<td>" + row[i] + "</td>";
        text += "</tr>\n";
    }
    return text + "</tbody></table></div>\n";
}

std::string short_text(double x)
{
    return std::isfinite(x) ? fmt::format("{:.3g}", x) : "?";
}

std::string interval_text(const Interval& interval)
{
    if (!std::isfinite(interval.estimate)) return "?";
    if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return short_text(interval.estimate) + " [?]";
    return fmt::format("{:.3g} [{:.3g}, {:.3g}]", interval.estimate, interval.low, interval.high);
}

std::string percent_text(double share)
{
    return std::isfinite(share) ? fmt::format("{:.2g} %", 100 * share) : "?";
}

std::string seconds_text(double seconds)
{
    return std::isfinite(seconds) ? fmt::format("{:.3g} s", seconds) : "?";
}
} // namespace etendue
