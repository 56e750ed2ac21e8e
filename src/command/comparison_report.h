// A comparison as text, JSON and an HTML page.
#pragma once

#include "command/comparison.h"

#include <string>
#include <vector>

namespace etendue
{
struct ComparedPicture {
    std::string path;
    Image image;
};

struct ComparisonReport {
    ComparedPicture a, b;
    Comparison comparison;
    ComparisonSettings settings;
    std::vector<std::string> metrics; // names to show; all of them in the JSON
    std::string command;              // the command line
};

// One line: what is so.
std::string verdict_text(const ComparisonReport& report);

// For a terminal.
std::string comparison_text(const ComparisonReport& report);

// For programs. What is not finite is null.
std::string comparison_json(const ComparisonReport& report);

// For people: verdict, numbers, pictures and the p-values, in one file that needs no other.
std::string comparison_html(const ComparisonReport& report);

// The scale at which the signed error is in full colour: 1, 2 or 5 times a power of ten, above 99 % of the pixels.
double error_scale(const Image& a, const Image& b);
} // namespace etendue
