// Adds up parts and draws the line.
#include "util/study_progress.h"

#include "util/progress.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr double REDRAW_SECONDS = 0.1;
constexpr int PLAIN_COLUMNS = 120;
constexpr int NARROWEST_BAR = 12, WIDEST_BAR = 42; // with the brackets
} // namespace

std::string study_line(double fraction, const std::string& what, double elapsed_seconds, double remaining_seconds,
                       int columns)
{
    const double part = std::isnan(fraction) ? 0.0 : std::clamp(fraction, 0.0, 1.0);
    const std::string line = fmt::format("{:3.0f}%  {}  {}, {} left", std::floor(part * 100), what,
                                         format_duration(elapsed_seconds), format_duration(remaining_seconds));
    const int room = std::min(WIDEST_BAR, columns - static_cast<int>(line.size()) - 1);
    if (room < NARROWEST_BAR) return line.substr(0, static_cast<std::size_t>(std::max(columns, 0)));
    std::string bar(static_cast<std::size_t>(room - 2), ' ');
    const auto filled = static_cast<std::size_t>(part * (room - 2));
    std::fill_n(bar.begin(), filled, '=');
    if (filled < bar.size()) bar[filled] = '>';
    return "[" + bar + "] " + line;
}

StudyProgress::StudyProgress(Log& log, double total, Clock clock)
    : log_(log), clock_(std::move(clock)), start_(clock_()), total_(total), speed_start_(start_)
{
}

StudyProgress::~StudyProgress()
{
    log_.set_status("");
}

void StudyProgress::begin(const std::string& what, double work)
{
    what_ = what;
    part_ = work;
    next_ = 0.0;
    if (!log_.is_terminal())
        log_.info(study_line(done_ / total_, what_, clock_() - start_, remaining(done_), PLAIN_COLUMNS));
    show(0.0);
}

void StudyProgress::show(double fraction)
{
    if (log_.is_terminal() && clock_() >= next_) write(done_ + part_ * std::clamp(fraction, 0.0, 1.0));
}

void StudyProgress::end()
{
    done_ += part_;
    part_ = 0.0;
}

void StudyProgress::forget_speed()
{
    speed_start_ = clock_();
    speed_done_ = done_;
}

// In proportion to the work since the speed counts.
double StudyProgress::remaining(double done) const
{
    if (done <= speed_done_) return std::numeric_limits<double>::infinity();
    return (clock_() - speed_start_) * (total_ - done) / (done - speed_done_);
}

void StudyProgress::finish(bool is_complete)
{
    log_.set_status("");
    if (!log_.is_terminal())
        log_.info(study_line(is_complete ? 1.0 : done_ / total_, is_complete ? "done" : "stopped", clock_() - start_,
                             0.0, PLAIN_COLUMNS));
}

void StudyProgress::write(double done)
{
    const double now = clock_();
    // Stay off the last column, where some terminals wrap.
    log_.set_status(study_line(done / total_, what_, now - start_, remaining(done), log_.columns() - 1));
    next_ = now + REDRAW_SECONDS;
}
} // namespace etendue
