// Decades, and what is between them.
#include "image/plot_axis.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr double LEAST_SPAN = 3.0; // of the axis, high / low: wherever that is, it holds two numbers of one digit
constexpr double MARGIN = 0.04;    // of its length, beyond the values at either end

double power_of_ten(int exponent)
{
    return std::pow(10.0, exponent);
}
} // namespace

bool is_plottable(double value)
{
    return std::isfinite(value) && value > 0.0;
}

LogAxis::LogAxis(const std::vector<double>& values)
{
    double low = 0.0, high = 0.0;
    for (const double value : values) {
        if (!is_plottable(value)) continue;
        low = low == 0.0 ? value : std::min(low, value);
        high = std::max(high, value);
    }
    if (low == 0.0) return;
    double from = std::log10(low), to = std::log10(high);
    const double missing = std::log10(LEAST_SPAN) - (to - from);
    if (missing > 0.0) {
        from -= missing / 2;
        to += missing / 2;
    }
    const double margin = MARGIN * (to - from);
    low_ = std::pow(10.0, from - margin);
    high_ = std::pow(10.0, to + margin);
}

double LogAxis::position(double value) const
{
    return (std::log10(value) - std::log10(low_)) / (std::log10(high_) - std::log10(low_));
}

std::vector<AxisTick> LogAxis::ticks(std::size_t most_labels) const
{
    const int first = static_cast<int>(std::floor(std::log10(low_)));
    const int last = static_cast<int>(std::ceil(std::log10(high_)));
    const auto decades = static_cast<std::size_t>(last - first);
    const bool is_fine = decades <= 6;

    // Label every decade or every so many, and of few decades 2 and 5 as well.
    const auto step = static_cast<int>(std::max<std::size_t>(1, (decades + most_labels - 1) / most_labels));
    const bool labels_between = 3.0 * std::log10(high_ / low_) <= static_cast<double>(most_labels);
    std::vector<AxisTick> ticks;
    for (int exponent = first; exponent <= last; ++exponent) {
        for (int digit = 1; digit < 10; ++digit) {
            if (digit > 1 && !is_fine) break;
            const double value = digit * power_of_ten(exponent);
            if (value < low_ || value > high_) continue;
            const bool is_labelled = digit == 1 ? exponent % step == 0 : labels_between && (digit == 2 || digit == 5);
            ticks.push_back({value, digit == 1, is_labelled});
        }
    }
    // Within a decade, label everything.
    if (ticks.size() <= most_labels)
        for (AxisTick& tick : ticks) tick.is_labelled = true;
    return ticks;
}

TickLabel tick_label(double value)
{
    // Rounded, or the last bit of a power of ten decides.
    const int exponent = static_cast<int>(std::floor(std::log10(value) + 1e-9));
    const double digit = value / power_of_ten(exponent);
    if (exponent >= -3 && exponent <= 3) return {fmt::format("{:.12g}", value), ""};
    const std::string sign = exponent < 0 ? "−" : "";
    const std::string factor = std::abs(digit - 1.0) < 1e-9 ? "" : fmt::format("{:.12g}×", digit);
    return {factor + "10", sign + std::to_string(std::abs(exponent))};
}
} // namespace etendue
