// What a person reads while the program works: warnings, remarks and one status line, all through one sink so that
// they never overwrite each other. The program's own goes to stderr; a test makes one on a string stream.
#pragma once

#include <functional>
#include <mutex>
#include <ostream>
#include <string>

namespace etendue
{
// quiet: warnings only. normal: remarks and progress too. verbose: details too.
enum class Verbosity { quiet, normal, verbose };

struct LogOutput {
    std::ostream& stream;
    bool is_terminal = false;                         // a line can be redrawn with \r
    std::function<int()> columns = [] { return 80; }; // of the terminal, asked before each redraw
};

// Thread-safe. Every text is one or more complete sentences without a newline at the end.
class Log
{
public:
    explicit Log(LogOutput output, Verbosity verbosity = Verbosity::normal);
    ~Log();
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;

    void set_verbosity(Verbosity verbosity);
    Verbosity verbosity() const;
    bool is_terminal() const { return output_.is_terminal; }
    int columns() const { return output_.columns(); }

    void warning(const std::string& text); // "warning: text", at every verbosity
    void info(const std::string& text);    // normal and verbose
    void detail(const std::string& text);  // verbose

    // Draw `line` in place of the status line there is; an empty one removes it. Messages appear above it. Does nothing
    // where the output is no terminal, or quiet.
    void set_status(const std::string& line);
    // Leave the status line as it is and continue below it.
    void keep_status();

private:
    void write_line(const std::string& text);

    LogOutput output_;
    mutable std::mutex mutex_;
    Verbosity verbosity_;
    std::string status_;
};

// The log of the process, on stderr.
Log& standard_log();
} // namespace etendue
