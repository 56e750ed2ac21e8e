// How far a render is, for a person: one line that is redrawn on a terminal, plain lines ever more seldom elsewhere.
#pragma once

#include "util/log.h"
#include "util/stopwatch.h"

#include <cstdint>
#include <string>

namespace etendue
{
struct ProgressState {
    double fraction = 0.0;           // of the work or of the time there is, 0..1
    std::uint64_t samples_done = 0;  // per pixel, all pixels have them
    std::uint64_t samples_total = 0; // 0: no limit
    double rays = 0.0;               // traced since the clock started
    double relative_error = 0.0;     // estimated; not finite: unknown
};

class Progress
{
public:
    // Time starts now. The clock gives seconds.
    explicit Progress(Log& log, Clock clock = steady_clock());
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // Whether show() would write something: ask before working out a state. At most ten times a second on a terminal;
    // elsewhere after 1, 2, 4, ... seconds and then every ten minutes; never when the log is quiet.
    bool due() const;
    // Write the state if it is due.
    void show(const ProgressState& state);
    // Write the state as it is in the end, and let it stand.
    void finish(const ProgressState& state);

private:
    void write(const ProgressState& state);

    Log& log_;
    Clock clock_;
    double start_;
    double next_;
};

// "[=====>     ]  45%  29/64 spp  12.3 Mrays/s  error 1.2%  0:12, 0:15 left", at most `columns` wide: a narrow line
// gives up the bar first and then its fields from the right. The remaining time is in proportion to the fraction.
std::string progress_line(const ProgressState& state, double elapsed_seconds, int columns);

// 0:07, 1:02:03; "?" for what is not finite.
std::string format_duration(double seconds);
} // namespace etendue
