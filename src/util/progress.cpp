// Decides when a line is due, and fits it into the width there is.
#include "util/progress.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <vector>

namespace etendue
{
namespace
{
constexpr double redraw_seconds = 0.1;
constexpr double first_line_seconds = 1.0;
constexpr double longest_silence_seconds = 600.0;
constexpr int plain_columns = 120;
constexpr int narrowest_bar = 12, widest_bar = 42; // with the brackets

std::string bar(double fraction, int width)
{
    const int inside = width - 2;
    const int filled = static_cast<int>(std::floor(fraction * inside));
    std::string text(static_cast<std::size_t>(inside), ' ');
    std::fill_n(text.begin(), filled, '=');
    if (filled < inside) text[static_cast<std::size_t>(filled)] = '>';
    return "[" + text + "]";
}

// So many significant digits, and every digit before the point.
std::string short_number(double value, int digits)
{
    return value < std::pow(10.0, digits) ? fmt::format("{:.{}g}", value, digits) : fmt::format("{:.0f}", value);
}

std::vector<std::string> fields(const ProgressState& state, double fraction, double elapsed)
{
    std::vector<std::string> texts;
    texts.push_back(fmt::format("{:3.0f}%", std::floor(fraction * 100)));
    texts.push_back(state.samples_total == 0 ? fmt::format("{} spp", state.samples_done)
                                             : fmt::format("{}/{} spp", state.samples_done, state.samples_total));
    texts.push_back(short_number(elapsed > 0.0 ? state.rays / elapsed * 1e-6 : 0.0, 3) + " Mrays/s");
    texts.push_back(std::isfinite(state.relative_error) ? "error " + short_number(state.relative_error * 100, 2) + "%"
                                                        : "error ?");
    const double remaining =
        fraction > 0.0 ? elapsed * (1.0 - fraction) / fraction : std::numeric_limits<double>::infinity();
    texts.push_back(fmt::format("{}, {} left", format_duration(elapsed), format_duration(remaining)));
    return texts;
}
} // namespace

std::string format_duration(double seconds)
{
    if (!std::isfinite(seconds)) return "?";
    const auto whole = static_cast<std::int64_t>(std::llround(std::clamp(seconds, 0.0, 1e15)));
    const auto hours = whole / 3600, minutes = whole / 60 % 60;
    return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                     : fmt::format("{}:{:02}", minutes, whole % 60);
}

std::string progress_line(const ProgressState& state, double elapsed_seconds, int columns)
{
    const double fraction = std::isnan(state.fraction) ? 0.0 : std::clamp(state.fraction, 0.0, 1.0);
    // Take the fields that fit, from the left.
    std::string line;
    for (const std::string& field : fields(state, fraction, elapsed_seconds)) {
        const std::string longer = line.empty() ? field : line + "  " + field;
        if (static_cast<int>(longer.size()) > columns) break;
        line = longer;
    }
    // Give the bar what is left.
    const int room = std::min(widest_bar, columns - static_cast<int>(line.size()) - 1);
    return room >= narrowest_bar ? bar(fraction, room) + " " + line : line;
}

Progress::Progress(Log& log, Clock clock) : log_(log), clock_(std::move(clock)), start_(clock_())
{
    next_ = start_ + (log_.is_terminal() ? 0.0 : first_line_seconds);
}

Progress::~Progress()
{
    log_.keep_status();
}

bool Progress::due() const
{
    return log_.verbosity() != Verbosity::quiet && clock_() >= next_;
}

void Progress::show(const ProgressState& state)
{
    if (!due()) return;
    write(state);
    // The plain line after one at t seconds comes at 2 t.
    const double now = clock_();
    next_ = now + (log_.is_terminal() ? redraw_seconds : std::min(now - start_, longest_silence_seconds));
}

void Progress::finish(const ProgressState& state)
{
    if (log_.verbosity() == Verbosity::quiet) return;
    write(state);
    log_.keep_status();
    next_ = std::numeric_limits<double>::infinity();
}

void Progress::write(const ProgressState& state)
{
    const double elapsed = clock_() - start_;
    // Stay off the last column, where some terminals wrap.
    if (log_.is_terminal())
        log_.set_status(progress_line(state, elapsed, log_.columns() - 1));
    else
        log_.info(progress_line(state, elapsed, plain_columns));
}
} // namespace etendue
