// The progress line with a clock that the test turns.
#include "util/progress.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <sstream>

using namespace etendue;

namespace
{
const ProgressState half{0.5, 32, 64, 24e6, 0.0123};

std::size_t count_of(const std::string& text, const std::string& part)
{
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}
} // namespace

TEST_CASE("the progress line shows bar, fraction, samples, speed, error and times")
{
    CHECK(progress_line(half, 2.0, 85) ==
          "[=============>            ]  50%  32/64 spp  12 Mrays/s  error 1.2%  0:02, 0:02 left");
    // Above 100 % the error has no decimals; without room the bar goes first, then the last fields.
    CHECK(progress_line({1.0, 64, 64, 2e9, 2.5}, 4000.0, 45) == "100%  64/64 spp  0.5 Mrays/s  error 250%");
}

TEST_CASE("what is not known yet is shown as a question mark")
{
    const double unknown = std::numeric_limits<double>::infinity();
    CHECK(progress_line({0.0, 0, 0, 0.0, unknown}, 0.0, 60) ==
          "[>           ]   0%  0 spp  0 Mrays/s  error ?  0:00, ? left");
}

TEST_CASE("the progress line never exceeds the width")
{
    for (int columns = 0; columns <= 200; ++columns) {
        const std::string line = progress_line(half, 12345.0, columns);
        CHECK(static_cast<int>(line.size()) <= columns);
        if (columns >= 4) CHECK(line.find("50%") != std::string::npos);
        if (columns >= 90) CHECK(line.find("[=") == 0);
    }
}

TEST_CASE("durations read like a clock")
{
    CHECK(format_duration(7.4) == "0:07");
    CHECK(format_duration(59.6) == "1:00");
    CHECK(format_duration(3723.0) == "1:02:03");
    CHECK(format_duration(-1.0) == "0:00");
    CHECK(format_duration(std::numeric_limits<double>::quiet_NaN()) == "?");
}

TEST_CASE("a terminal's line is redrawn at most ten times a second")
{
    std::ostringstream stream;
    Log log({stream, true});
    double now = 0.0;
    Progress progress(log, [&now] { return now; });
    for (int step = 0; step < 2000; ++step, now += 0.001) {
        const ProgressState state{step / 2000.0, static_cast<std::uint64_t>(step), 2000, step * 1e4, 0.1};
        progress.show(state);
    }
    const std::size_t redraws = count_of(stream.str(), "\r");
    CHECK(redraws >= 18);
    CHECK(redraws <= 20);
    CHECK(count_of(stream.str(), "\n") == 0);
    progress.finish({1.0, 2000, 2000, 2e7, 0.1});
    CHECK(count_of(stream.str(), "\n") == 1);
    CHECK_FALSE(progress.due());
}

TEST_CASE("the line follows the terminal's width")
{
    std::ostringstream stream;
    int columns = 100;
    Log log({stream, true, [&columns] { return columns; }});
    double now = 0.0;
    Progress progress(log, [&now] { return now; });
    progress.show(half);
    const std::size_t wide = stream.str().size();
    columns = 30;
    now = 1.0;
    progress.show(half);
    const std::string narrow = stream.str().substr(wide);
    CHECK(narrow.size() - std::string("\r\x1b[K").size() < 30);
    CHECK(narrow.find("50%") != std::string::npos);
}

TEST_CASE("elsewhere plain lines come at increasing intervals")
{
    std::ostringstream stream;
    Log log({stream, false});
    double now = 100.0;
    std::vector<double> moments;
    Progress progress(log, [&now] { return now; });
    for (; now <= 100.0 + 3000.0; now += 0.25) {
        if (!progress.due()) continue;
        moments.push_back(now - 100.0);
        progress.show(half);
    }
    const std::vector<double> expected{1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 1624, 2224, 2824};
    CHECK(moments == expected);
    progress.finish(half);
    CHECK(count_of(stream.str(), "\n") == expected.size() + 1);
    CHECK(count_of(stream.str(), "\r") == 0);
}

TEST_CASE("a quiet log shows no progress")
{
    std::ostringstream stream;
    Log log({stream, true}, Verbosity::quiet);
    double now = 0.0;
    Progress progress(log, [&now] { return now; });
    now = 10.0;
    CHECK_FALSE(progress.due());
    progress.show(half);
    progress.finish(half);
    CHECK(stream.str().empty());
}
