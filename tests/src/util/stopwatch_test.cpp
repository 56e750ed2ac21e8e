// Laps and totals; the only thing a test can say about real time is that it does not run backwards.
#include "util/stopwatch.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

using namespace etendue;

TEST_CASE("a stopwatch measures at least the time that is slept")
{
    Stopwatch watch;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    CHECK(watch.seconds() >= 0.005);
    const Clock clock = steady_clock();
    const double first = clock();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    CHECK(clock() - first >= 0.005);
}

TEST_CASE("restarting a stopwatch returns the lap and begins at zero")
{
    Stopwatch whole, laps;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const double lap = laps.restart();
    CHECK(lap >= 0.02);
    const double rest = laps.seconds();
    CHECK(rest >= 0.0);
    CHECK(lap + rest <= whole.seconds());
}
