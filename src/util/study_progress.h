// How far many renders are together, for a person: one line that is redrawn on a terminal, a plain line for each render
// elsewhere.
#pragma once

#include "util/log.h"
#include "util/stopwatch.h"

#include <string>

namespace etendue
{
class StudyProgress
{
public:
    // Time starts now. `total` is the work of all parts, in any unit.
    StudyProgress(Log& log, double total, Clock clock = steady_clock());
    ~StudyProgress();
    StudyProgress(const StudyProgress&) = delete;
    StudyProgress& operator=(const StudyProgress&) = delete;

    // A part of so much work begins: "run 3 of 16: path, seed 2".
    void begin(const std::string& what, double work);
    // So much of the part is done, 0..1.
    void show(double fraction);
    // All of it is done.
    void end();
    // What is done so far says nothing of how fast the rest will be.
    void forget_speed();
    // Everything is done or given up; the line goes away.
    void finish(bool is_complete);

private:
    void write(double done);
    double remaining(double done) const;

    Log& log_;
    Clock clock_;
    double start_, next_ = 0.0;
    double total_, done_ = 0.0, part_ = 0.0;
    double speed_start_, speed_done_ = 0.0; // from where on the speed counts
    std::string what_;
};

// "[====>     ]  45%  run 3 of 16: path, seed 2  1:10, 1:26 left", at most `columns` wide.
std::string study_line(double fraction, const std::string& what, double elapsed_seconds, double remaining_seconds,
                       int columns);
} // namespace etendue
