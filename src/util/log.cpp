// One sink for messages and the status line; the terminal is asked for its width where the system can tell.
#include "util/log.h"

#include "util/error.h"

#include <cstdlib>
#include <iostream>

#if __has_include(<sys/ioctl.h>) && __has_include(<unistd.h>)
#include <sys/ioctl.h>
#include <unistd.h>
#define HAS_TERMINAL_CALLS 1
#else
#define HAS_TERMINAL_CALLS 0
#endif

namespace etendue
{
namespace
{
constexpr const char* erase_line = "\r\x1b[K";

bool stderr_is_terminal()
{
#if HAS_TERMINAL_CALLS
    const char* type = std::getenv("TERM");
    return isatty(STDERR_FILENO) == 1 && !(type && std::string(type) == "dumb");
#else
    return false;
#endif
}

int stderr_columns()
{
#if HAS_TERMINAL_CALLS
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
#endif
    return 80;
}
} // namespace

Log::Log(LogOutput output, Verbosity verbosity) : output_(std::move(output)), verbosity_(verbosity) {}

Log::~Log()
{
    keep_status();
}

void Log::set_verbosity(Verbosity verbosity)
{
    const std::lock_guard lock(mutex_);
    verbosity_ = verbosity;
}

Verbosity Log::verbosity() const
{
    const std::lock_guard lock(mutex_);
    return verbosity_;
}

void Log::warning(const std::string& text)
{
    const std::lock_guard lock(mutex_);
    write_line("warning: " + text);
}

void Log::info(const std::string& text)
{
    const std::lock_guard lock(mutex_);
    if (verbosity_ != Verbosity::quiet) write_line(text);
}

void Log::detail(const std::string& text)
{
    const std::lock_guard lock(mutex_);
    if (verbosity_ == Verbosity::verbose) write_line(text);
}

void Log::set_status(const std::string& line)
{
    const std::lock_guard lock(mutex_);
    if (!output_.is_terminal || verbosity_ == Verbosity::quiet || line == status_) return;
    output_.stream << erase_line << line << std::flush;
    status_ = line;
}

void Log::keep_status()
{
    const std::lock_guard lock(mutex_);
    if (status_.empty()) return;
    output_.stream << '\n' << std::flush;
    status_.clear();
}

void Log::write_line(const std::string& text)
{
    if (!status_.empty()) output_.stream << erase_line;
    output_.stream << without_control_characters(text) << '\n' << status_ << std::flush;
}

Log& standard_log()
{
    static Log log({std::cerr, stderr_is_terminal(), stderr_columns});
    return log;
}
} // namespace etendue
