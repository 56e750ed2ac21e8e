// Channels of an image by name.
#include "image/image.h"
#include "util/error.h"

#include <catch2/catch.hpp>

using namespace etendue;

TEST_CASE("a channel is found by its name, and its values lie row by row")
{
    const Image image{2, 2, 0, 0, 2, 2, {"R", "depth.Z"}, {0, 1, 2, 3, 4, 5, 6, 7}, {}};
    CHECK(image.channel("R") == 0);
    CHECK(image.channel("depth.Z") == 1);
    CHECK(image.at(1, 0, 1) == 3.0f);
    CHECK(image.at(0, 1, 0) == 4.0f);
    CHECK_THROWS_WITH(image.channel("Z"), "The image has no channel \"Z\"; there are: R, depth.Z.");
}
