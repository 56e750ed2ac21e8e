// Regular expressions, compiled in one file: <regex> is slow to compile.
#pragma once

#include <string>
#include <vector>

namespace etendue
{
// Every match of an ECMAScript regular expression in the text, from its beginning: what its group matched (0: all of
// it).
std::vector<std::string> matches(const std::string& text, const std::string& pattern, int group);
} // namespace etendue
