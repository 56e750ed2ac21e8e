// The progress line of many renders, with a clock that the test turns.
#include "util/study_progress.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace etendue;
using Catch::Contains;

TEST_CASE("the study's line shows bar, share, part and times")
{
    CHECK(study_line(0.5, "run 1 of 2: path, seed 1", 60.0, 60.0, 80) ==
          "[===============>              ]  50%  run 1 of 2: path, seed 1  1:00, 1:00 left");
    CHECK(study_line(0.0, "reference", 0.0, INFINITY, 40) == "  0%  reference  0:00, ? left");
    for (int columns = 0; columns < 100; ++columns)
        CHECK(static_cast<int>(study_line(0.3, "run", 1.0, 2.0, columns).size()) <= columns);
}

TEST_CASE("a study's parts add up to its whole")
{
    std::ostringstream stream;
    double now = 0.0;
    Log log({stream, true});
    StudyProgress progress(log, 7.0, [&] { return now; });
    progress.begin("one", 1.0);
    now = 10.0;
    progress.end();
    progress.begin("two", 3.0);
    CHECK_THAT(stream.str(), Contains(" 14%  two  0:10, 1:00 left"));
    now = 20.0;
    progress.show(1.0 / 3.0);
    CHECK_THAT(stream.str(), Contains(" 28%  two  0:20, 0:50 left"));
    // From here on the rest goes ten times as fast.
    progress.end();
    progress.forget_speed();
    progress.begin("three", 3.0);
    now = 21.0;
    progress.show(1.0 / 3.0);
    CHECK_THAT(stream.str(), Contains("three  0:21, 0:02 left"));
}

TEST_CASE("without a terminal each part has one line")
{
    std::ostringstream stream;
    Log log({stream, false});
    StudyProgress progress(log, 3.0); // the third part turned out to be there already
    progress.begin("one", 1.0);
    progress.show(0.5);
    progress.show(0.9);
    progress.end();
    progress.begin("two", 1.0);
    progress.end();
    progress.finish(true);
    const std::string text = stream.str();
    CHECK(std::count(text.begin(), text.end(), '\n') == 3);
    CHECK_THAT(text, Contains("100%  done"));
    progress.finish(false);
    CHECK_THAT(stream.str(), Contains("66%  stopped"));
}
