// Checkpoints from text, and which pass serves which.
#include "converge/checkpoints.h"

#include "util/error.h"

#include <catch2/catch.hpp>

using namespace etendue;
using Catch::Contains;

namespace
{
void check_refused(const std::string& text, const std::string& message)
{
    INFO(text);
    CHECK_THROWS_WITH(parse_checkpoints(text), Contains("--checkpoints must be spp:FIRST:LAST:xFACTOR") &&
                                                   Contains('"' + text + '"') && Contains(message));
}
} // namespace

TEST_CASE("checkpoints grow by their factor from the first to the last", "[converge]")
{
    CHECK(parse_checkpoints("spp:1:16:x2").values() == std::vector<double>{1, 2, 4, 8, 16});
    // The last is left out where the factor steps over it.
    CHECK(parse_checkpoints("spp:3:20:x2").values() == std::vector<double>{3, 6, 12});
    // Whole numbers, each once.
    CHECK(parse_checkpoints("spp:1:4:x1.3").values() == std::vector<double>{1, 2, 3, 4});
    const std::vector<double> times = parse_checkpoints("time:0.1:60:x10").values();
    REQUIRE(times.size() == 3);
    CHECK(times[0] == 0.1);
    CHECK(times[2] == Approx(10.0));
    // A last value that the factors reach only but for rounding.
    CHECK(parse_checkpoints("time:0.1:0.8:x1.41421356237309515").values().size() == 7);
    CHECK(parse_checkpoints("time:0.1:60:x1.414").text() == "time:0.1:60:x1.414");
}

TEST_CASE("checkpoints that cannot be are refused with what is wrong with them", "[converge]")
{
    check_refused("spp:1:16", "has 3 parts");
    check_refused("", "has 1 parts");
    check_refused("minutes:1:16:x2", "begins with \"minutes\"");
    check_refused("spp:one:16:x2", "has \"one\" where a number belongs");
    check_refused("spp:1:16x:x2", "has \"16x\" where a number belongs");
    check_refused("time:nan:1:x2", "has \"nan\" where a number belongs");
    check_refused("spp:1:16:2", "has no x before its factor");
    check_refused("spp:1:16:x1", "has a factor that is not above 1");
    check_refused("spp:0:16:x2", "whole numbers of at least 1");
    check_refused("spp:1.5:16:x2", "whole numbers of at least 1");
    check_refused("time:0:16:x2", "begins at a time that is not above 0");
    check_refused("spp:16:1:x2", "ends before it begins");
    check_refused("spp:1:1e16:x2", "ends too late");
    check_refused("time:1e-3:60:x1.0001", "has more than 200 checkpoints");
}

TEST_CASE("a checkpoint is taken at the first end of a pass at or after it", "[converge]")
{
    CheckpointClock samples(parse_checkpoints("spp:3:48:x2"));
    std::vector<std::uint64_t> taken;
    for (const std::uint64_t end : {1u, 2u, 4u, 8u, 16u, 32u, 64u, 128u})
        if (samples.due(end, 0.0)) taken.push_back(end);
    CHECK(taken == std::vector<std::uint64_t>{4, 8, 16, 32, 64});
    CHECK(samples.finished());

    // One end serves several.
    CheckpointClock times(parse_checkpoints("time:1:8:x2"));
    CHECK_FALSE(times.due(1, 0.5));
    CHECK(times.due(2, 2.5));
    CHECK_FALSE(times.due(4, 3.5));
    CHECK_FALSE(times.finished());
    CHECK(times.due(64, 100.0));
    CHECK(times.finished());
}
