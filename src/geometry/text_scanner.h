// Lines and words of a text in memory, and numbers that mean the same in every locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace etendue
{
class TextScanner
{
public:
    explicit TextScanner(std::string_view text, std::size_t lines_before = 0) : rest_(text), line_number_(lines_before)
    {
    }

    // Go to the next line, which ends in \n or \r\n; false at the end of the text.
    bool next_line();
    // The next word of this line; empty where it ends.
    std::string_view next_word();
    // From 1.
    std::size_t line_number() const { return line_number_; }
    // All that follows this line.
    std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
    std::string_view line_;
    std::size_t line_number_;
};

// The nearest double of a decimal number, "nan" or "inf" (what exceeds every double is infinite, too); empty where the
// word is anything else or goes on after the number.
std::optional<double> parse_real(std::string_view word);
// A decimal integer that is the whole word.
std::optional<std::int64_t> parse_integer(std::string_view word);

// A word for a message: in quotes, printable and short.
std::string quote(std::string_view word);
} // namespace etendue
