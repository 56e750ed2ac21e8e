// Elapsed wall time, from a clock that never jumps.
#pragma once

#include <chrono>
#include <functional>

namespace etendue
{
// Seconds since some fixed moment. What shows times takes one, so that a test can pass its own.
using Clock = std::function<double()>;

class Stopwatch
{
public:
    // Seconds since construction or the last restart.
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

    // Seconds since the last restart, then start again: the laps add up to the whole.
    double restart()
    {
        const auto now = std::chrono::steady_clock::now();
        const double lap = std::chrono::duration<double>(now - start_).count();
        start_ = now;
        return lap;
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// The clock of a program that runs: seconds since this call.
inline Clock steady_clock()
{
    return [watch = Stopwatch()] { return watch.seconds(); };
}
} // namespace etendue
