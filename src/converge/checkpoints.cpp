// Geometric rows of checkpoints.
#include "converge/checkpoints.h"

#include "util/error.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
// More would be a mistake in the factor.
constexpr std::size_t MOST_CHECKPOINTS = 200;
// The last value counts even when the factors' rounding carries it a little beyond.
constexpr double SLACK = 1e-9;
constexpr double MOST_SAMPLES = 1e15, MOST_SECONDS = 1e7;

[[noreturn]] void fail(const std::string& text, const std::string& message)
{
    throw UsageError(fmt::format("--checkpoints must be spp:FIRST:LAST:xFACTOR or time:FIRST:LAST:xFACTOR, for example "
                                 "spp:1:4096:x2 or time:0.1:60:x1.414; \"{}\" {}.",
                                 text, message));
}

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts{""};
    for (const char c : text)
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

double number(const std::string& whole, const std::string& part)
{
    double value = 0.0;
    const char* const end = part.data() + part.size();
    const auto [stop, error] = std::from_chars(part.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value))
        fail(whole, fmt::format("has \"{}\" where a number belongs", part));
    return value;
}
} // namespace

std::vector<double> Checkpoints::values() const
{
    std::vector<double> values;
    for (std::size_t i = 0; i < MOST_CHECKPOINTS; ++i) {
        double value = first * std::pow(factor, static_cast<double>(i));
        if (value > last * (1.0 + SLACK)) break;
        if (axis == Axis::samples) value = std::round(value);
        if (values.empty() || value > values.back()) values.push_back(value);
    }
    return values;
}

std::string Checkpoints::text() const
{
    return fmt::format("{}:{:g}:{:g}:x{:g}", axis == Axis::samples ? "spp" : "time", first, last, factor);
}

Checkpoints parse_checkpoints(const std::string& text)
{
    const std::vector<std::string> parts = split(text, ':');
    if (parts.size() != 4) fail(text, fmt::format("has {} parts between colons", parts.size()));
    Checkpoints checkpoints;
    if (parts[0] == "time")
        checkpoints.axis = Checkpoints::Axis::seconds;
    else if (parts[0] != "spp")
        fail(text, fmt::format("begins with \"{}\"", parts[0]));
    const bool is_samples = checkpoints.axis == Checkpoints::Axis::samples;
    checkpoints.first = number(text, parts[1]);
    checkpoints.last = number(text, parts[2]);
    if (parts[3].empty() || parts[3][0] != 'x') fail(text, "has no x before its factor");
    checkpoints.factor = number(text, parts[3].substr(1));

    if (is_samples && (checkpoints.first < 1.0 || checkpoints.first != std::floor(checkpoints.first) ||
                       checkpoints.last != std::floor(checkpoints.last)))
        fail(text, "has samples that are not whole numbers of at least 1");
    if (!is_samples && checkpoints.first <= 0.0) fail(text, "begins at a time that is not above 0");
    if (checkpoints.last < checkpoints.first) fail(text, "ends before it begins");
    if (checkpoints.last > (is_samples ? MOST_SAMPLES : MOST_SECONDS)) fail(text, "ends too late");
    if (checkpoints.factor <= 1.0) fail(text, "has a factor that is not above 1");
    const double steps = std::log(checkpoints.last / checkpoints.first) / std::log(checkpoints.factor);
    if (steps >= static_cast<double>(MOST_CHECKPOINTS))
        fail(text, fmt::format("has more than {} checkpoints", MOST_CHECKPOINTS));
    return checkpoints;
}

bool CheckpointClock::due(std::uint64_t samples, double seconds)
{
    const double now = axis_ == Checkpoints::Axis::samples ? static_cast<double>(samples) : seconds;
    const std::size_t before = next_;
    while (next_ < values_.size() && values_[next_] <= now) ++next_;
    return next_ > before;
}
} // namespace etendue
