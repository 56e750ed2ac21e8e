// Lines and columns of a JSON text, and a scanner of its tokens.
#include "util/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace etendue::json
{
namespace
{
constexpr std::size_t LONGEST_EXCERPT = 120;
constexpr std::string_view BYTE_ORDER_MARK = "\xef\xbb\xbf";

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}
bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
bool inside_code_point(char c)
{
    return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u;
}

// Bytes of the UTF-8 sequence at the start of this text (RFC 3629 section 4); 0 where there is none.
std::size_t code_point_size(std::string_view s)
{
    const auto byte = [&](std::size_t i) { return i < s.size() ? static_cast<unsigned char>(s[i]) : 0u; };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80u) return 1;
    const std::size_t size = first < 0xC2u ? 0 : first < 0xE0u ? 2 : first < 0xF0u ? 3 : first < 0xF5u ? 4 : 0;
    for (std::size_t i = 1; i < size; ++i)
        if ((byte(i) & 0xC0u) != 0x80u) return 0;
    const bool too_long = (first == 0xE0u && second < 0xA0u) || (first == 0xF0u && second < 0x90u);
    const bool surrogate = first == 0xEDu && second >= 0xA0u;
    const bool too_large = first == 0xF4u && second >= 0x90u;
    return too_long || surrogate || too_large ? 0 : size;
}

// The number that \uXXXX at the start of this text stands for; -1 where it is no such escape.
int escaped_unit(std::string_view s)
{
    if (s.size() < 6 || s[0] != '\\' || s[1] != 'u') return -1;
    int unit = 0;
    const auto [end, error] = std::from_chars(s.data() + 2, s.data() + 6, unit, 16);
    return error == std::errc() && end == s.data() + 6 && unit >= 0 ? unit : -1;
}

// number = [-] (0 | 1-9 digits) [. digits] [e [+-] digits], RFC 8259 section 6.
bool is_number(std::string_view token)
{
    std::size_t i = 0;
    const auto skip_digits = [&] {
        const std::size_t first = i;
        while (i < token.size() && is_digit(token[i])) ++i;
        return i > first;
    };
    if (i < token.size() && token[i] == '-') ++i;
    if (i < token.size() && token[i] == '0')
        ++i;
    else if (!skip_digits())
        return false;
    if (i < token.size() && token[i] == '.' && (++i, !skip_digits())) return false;
    if (i < token.size() && (token[i] == 'e' || token[i] == 'E')) {
        ++i;
        if (i < token.size() && (token[i] == '+' || token[i] == '-')) ++i;
        if (!skip_digits()) return false;
    }
    return i == token.size();
}

// The token as a message shows it: short, and nothing but printable ASCII.
std::string printable(std::string_view token)
{
    std::string text(token.substr(0, 24));
    for (char& c : text)
        if (c < 0x20 || c > 0x7e) c = '?';
    return token.size() > 24 ? text + "..." : text;
}

class Scanner
{
public:
    explicit Scanner(const Text& text) : text_(text), s_(text.string()) {}

    void scan()
    {
        if (s_.starts_with(BYTE_ORDER_MARK)) i_ = BYTE_ORDER_MARK.size();
        while (i_ < s_.size()) {
            const char c = s_[i_];
            if (is_space(c))
                ++i_;
            else if (c == '/')
                skip_comment();
            else
                scan_token(c);
        }
        if (values_ == 0) fail(0, "the file holds no JSON; a scene is an object { ... }");
    }

private:
    [[noreturn]] void fail(std::size_t offset, const std::string& message) const
    {
        throw SceneError(text_.location(offset), message);
    }

    void scan_token(char c)
    {
        if (c == '"') {
            skip_string();
        } else if (c == '[' || c == '{') {
            if (++depth_ > MAX_DEPTH)
                fail(i_, fmt::format("lists and objects are nested more than {} deep", MAX_DEPTH));
            count_value();
            ++i_;
        } else if (c == ']' || c == '}') {
            if (depth_ > 0) --depth_;
            ++i_;
        } else if (c == ',' || c == ':') {
            ++i_;
        } else {
            check_word();
        }
    }

    void count_value()
    {
        if (++values_ > MAX_VALUES)
            fail(i_, fmt::format("more than {} values in one file; a large mesh belongs into a .ply or .obj file",
                                 MAX_VALUES));
    }

    void skip_comment()
    {
        const std::size_t start = i_;
        const std::string_view mark = s_.substr(i_, 2);
        if (mark == "//") {
            i_ = std::min(s_.find_first_of("\r\n", i_), s_.size());
        } else if (mark == "/*") {
            const std::size_t end = s_.find("*/", i_ + 2);
            if (end == std::string_view::npos) fail(start, "the comment that begins here does not end");
            i_ = end + 2;
        } else {
            fail(start, "\"/\" is not JSON; comments are // ... and /* ... */");
        }
    }

    void skip_string()
    {
        const std::size_t start = i_++;
        count_value();
        for (; i_ < s_.size() && s_[i_] != '"'; ++i_) {
            if (static_cast<unsigned char>(s_[i_]) < 0x20u)
                fail(start,
                     "the string that begins here holds a line break or control character; write \\n, \\t or \\u00XX");
            if (s_[i_] == '\\')
                skip_escape();
            else if (const std::size_t size = code_point_size(s_.substr(i_)); size > 0)
                i_ += size - 1;
            else
                fail(i_, "this byte is not UTF-8; save the file in that encoding");
        }
        if (i_ >= s_.size()) fail(start, "the string that begins here does not end");
        ++i_;
    }

    // Up to the last byte of an escape. The library checks all of it but that surrogates are in pairs.
    void skip_escape()
    {
        const auto is_surrogate = [](int unit, int first) { return unit >= first && unit < first + 0x400; };
        const int unit = escaped_unit(s_.substr(i_));
        if (is_surrogate(unit, 0xDC00) ||
            (is_surrogate(unit, 0xD800) && !is_surrogate(escaped_unit(s_.substr(i_ + 6)), 0xDC00)))
            fail(i_, "this half of a surrogate pair lacks the other half");
        i_ += is_surrogate(unit, 0xD800) ? 11 : 1;
    }

    // A number, true, false or null: everything up to the next separator.
    void check_word()
    {
        const std::size_t start = i_;
        count_value();
        i_ = std::min(s_.find_first_of(" \t\r\n,:[]{}\"/", i_), s_.size());
        const std::string_view word = s_.substr(start, i_ - start);
        if (word == "true" || word == "false" || word == "null") return;
        if (is_number(word)) {
            if (std::isfinite(std::strtod(std::string(word).c_str(), nullptr))) return;
            fail(start, fmt::format("the number {} is too large for double precision", printable(word)));
        }
        const std::string_view sign_free = word.substr(word.find_first_not_of("+-") == 1 ? 1 : 0);
        if (sign_free == "NaN" || sign_free == "nan" || sign_free == "Infinity" || sign_free == "inf")
            fail(start, fmt::format("{} is not a number of JSON; every number must be finite", printable(word)));
        if (is_digit(word[0]) || word[0] == '-' || word[0] == '+' || word[0] == '.')
            fail(start, fmt::format("{} is not a number of JSON", printable(word)));
        fail(start, fmt::format("{} is not JSON; names and keys are in double quotes", printable(word)));
    }

    const Text& text_;
    std::string_view s_;
    std::size_t i_ = 0, depth_ = 0, values_ = 0;
};
} // namespace

bool is_utf8(std::string_view text)
{
    std::size_t size = 1;
    for (std::size_t i = 0; i < text.size() && size > 0; i += size) size = code_point_size(text.substr(i));
    return size > 0;
}

Text::Text(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)), line_starts_{0}
{
    for (std::size_t i = 0; i < text_.size(); ++i) {
        if (text_[i] == '\r' && i + 1 < text_.size() && text_[i + 1] == '\n') continue;
        if (text_[i] == '\n' || text_[i] == '\r') line_starts_.push_back(i + 1);
    }
}

std::size_t Text::offset(std::size_t line, std::size_t column) const
{
    const std::size_t start = line_starts_[std::clamp<std::size_t>(line, 1, line_starts_.size()) - 1];
    return std::min(start + std::max<std::size_t>(column, 1) - 1, text_.size());
}

SourceLocation Text::location(std::size_t offset) const
{
    offset = std::min(offset, text_.size());
    const auto next_line = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
    const std::size_t start = *(next_line - 1);
    std::size_t end = next_line == line_starts_.end() ? text_.size() : *next_line;
    while (end > start && (text_[end - 1] == '\n' || text_[end - 1] == '\r')) --end;

    // Keep of a long line what stands around the column, cut between code points.
    std::size_t first = start, last = end;
    if (end - start > LONGEST_EXCERPT) {
        if (offset - start > LONGEST_EXCERPT / 2) first = offset - LONGEST_EXCERPT / 2;
        last = std::min(first + LONGEST_EXCERPT, end);
        while (first < offset && inside_code_point(text_[first])) ++first;
        while (last > offset && last < end && inside_code_point(text_[last])) --last;
    }
    const std::string before = first > start ? "..." : "";
    const std::string after = last < end ? "..." : "";

    SourceLocation where;
    where.file = file_;
    where.line = static_cast<int>(next_line - line_starts_.begin());
    where.column = static_cast<int>(offset - start) + 1;
    where.excerpt = before + text_.substr(first, last - first) + after;
    where.excerpt_column = static_cast<int>(first - start) + 1 - static_cast<int>(before.size());
    return where;
}

void Text::check() const
{
    Scanner(*this).scan();
}
} // namespace etendue::json
