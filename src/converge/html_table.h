// Tables and numbers of a page.
#pragma once

#include "converge/interval.h"

#include <string>
#include <vector>

namespace etendue
{
// Cells are HTML already.
class HtmlTable
{
public:
    explicit HtmlTable(std::vector<std::string> head) : head_(std::move(head)) {}
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    // Rows begin with a heading; the table scrolls within a narrow page.
    std::string html() const;

private:
    std::vector<std::string> head_;
    std::vector<std::vector<std::string>> rows_;
};

// Three significant digits; "?" for what is not finite.
std::string short_text(double x);
// "1.23 [1.1, 1.4]"; without the band where that is not known.
std::string interval_text(const Interval& interval);
std::string percent_text(double share);
std::string seconds_text(double seconds);
} // namespace etendue
