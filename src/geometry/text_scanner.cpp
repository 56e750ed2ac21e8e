// Scanning of text without copies.
#include "geometry/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace etendue
{
namespace
{
bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

// from_chars knows no plus sign.
std::string_view without_plus(std::string_view word)
{
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    return plus ? word.substr(1) : word;
}

// Whether a number, written with digits and perhaps an exponent, is less than one but for its sign: by the power of ten
// of its first digit that is not zero.
bool is_below_one(std::string_view number)
{
    const std::size_t e = std::min(number.find_first_of("eE"), number.size());
    const std::string_view mantissa = number.substr(0, e);
    const auto point = static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
    const auto first = static_cast<std::int64_t>(mantissa.find_first_of("123456789"));
    const std::int64_t power = first < point ? point - first - 1 : point - first;
    if (e == number.size()) return power < 0;
    const auto exponent = parse_integer(number.substr(e + 1));
    return exponent ? *exponent < -power : number[e + 1] == '-';
}
} // namespace

bool TextScanner::next_line()
{
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
    ++line_number_;
    return true;
}

std::string_view TextScanner::next_word()
{
    std::size_t begin = 0;
    while (begin < line_.size() && is_space(line_[begin])) ++begin;
    std::size_t end = begin;
    while (end < line_.size() && !is_space(line_[end])) ++end;
    const std::string_view word = line_.substr(begin, end - begin);
    line_.remove_prefix(end);
    return word;
}

std::optional<double> parse_real(std::string_view word)
{
    const std::string_view digits = without_plus(word);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) return std::nullopt;
    if (error != std::errc::result_out_of_range) return value;
    const double magnitude = is_below_one(digits) ? 0.0 : std::numeric_limits<double>::infinity();
    return digits[0] == '-' ? -magnitude : magnitude;
}

std::optional<std::int64_t> parse_integer(std::string_view word)
{
    const std::string_view digits = without_plus(word);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    return value;
}

std::string quote(std::string_view word)
{
    constexpr std::size_t LONGEST = 40;
    std::string text = "\"";
    for (const char c : word.substr(0, LONGEST)) text += c >= ' ' && c <= '~' ? c : '?';
    return text + (word.size() > LONGEST ? "...\"" : "\"");
}
} // namespace etendue
