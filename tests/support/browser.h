// Looks at an HTML page as a person's browser does (headless Chromium).
#pragma once

#include <string>
#include <vector>

namespace etendue
{
// What became of a page in a window of that width.
struct PageView {
    int width = 0;
    int scroll_width = 0;              // more than width: the page scrolls sideways
    std::vector<std::string> errors;   // of scripts and the console, and resources that could not be loaded
    std::vector<std::string> requests; // what was loaded from outside of the page
    int images = 0, broken_images = 0;
    int figures_without_text = 0;      // images without alt, drawings without a label
    double smallest_text = 0.0;        // in pixels of the window, drawings included
    std::string smallest_words;        // which text that is
    double least_contrast = 0.0;       // of text against what is behind it, the page's own colours (WCAG 2.1)
    std::string least_contrast_words;
};

// Load the file at every width. Throws std::runtime_error where there is no Chromium or it says nothing.
std::vector<PageView> view_page(const std::string& path, const std::vector<int>& widths, bool is_dark = false);

// CHECK that a page is complete, readable and does not scroll sideways at 1280 and 400 pixels, light and dark.
void check_page(const std::string& path);

// A picture of the top of the page, for people.
void photograph_page(const std::string& path, int width, int height, const std::string& png, bool is_dark = false);
} // namespace etendue
