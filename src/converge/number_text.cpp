// Few digits, units where there are any.
#include "converge/number_text.h"

#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
const char* const UNKNOWN_TEXT = "–";
}

std::string short_text(double x)
{
    return std::isfinite(x) ? fmt::format("{:.3g}", x) : UNKNOWN_TEXT;
}

std::string interval_text(const Interval& interval)
{
    if (!std::isfinite(interval.estimate)) return UNKNOWN_TEXT;
    if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return short_text(interval.estimate) + " [?]";
    return fmt::format("{:.3g} [{:.3g}, {:.3g}]", interval.estimate, interval.low, interval.high);
}

std::string percent_text(double share)
{
    return std::isfinite(share) ? fmt::format("{:.3g} %", 100 * share) : UNKNOWN_TEXT;
}

std::string seconds_text(double seconds)
{
    return std::isfinite(seconds) ? fmt::format("{:.3g} s", seconds) : UNKNOWN_TEXT;
}
} // namespace etendue
