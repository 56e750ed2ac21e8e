// The text of a JSON file: where its bytes are in lines and columns, and the checks that come before parsing.
#pragma once

#include "util/error.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace etendue::json
{
inline constexpr std::size_t MAX_DEPTH = 64;            // objects and lists in each other
inline constexpr std::size_t MAX_VALUES = 10'000'000;   // about 1 GB in memory
inline constexpr std::size_t MAX_FILE_SIZE = 256 << 20; // bytes

// Whether a text is UTF-8 (RFC 3629 section 4).
bool is_utf8(std::string_view text);

class Text
{
public:
    Text(std::string text, std::string file);

    const std::string& string() const { return text_; }
    const std::string& file() const { return file_; }

    // Line, column and excerpt of a byte; an offset beyond the end is the end.
    SourceLocation location(std::size_t offset) const;
    // The byte at line and column, both from 1.
    std::size_t offset(std::size_t line, std::size_t column) const;

    // What the library that parses lets pass or cannot say well: no JSON at all, nesting deeper than MAX_DEPTH, more
    // than MAX_VALUES values, unfinished strings and comments, control characters in strings, strings that are not
    // UTF-8, half surrogate pairs, numbers that are not JSON's or do not fit a double, NaN, Infinity and other bare
    // words. Comments are allowed. Throws SceneError.
    void check() const;

private:
    std::string text_;
    std::string file_;
    std::vector<std::size_t> line_starts_;
};
} // namespace etendue::json
