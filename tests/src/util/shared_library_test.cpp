// Loading shared libraries.
#include "util/shared_library.h"

#include <catch2/catch.hpp>

TEST_CASE("a library that is there can be loaded and one that is not says why")
{
    CHECK(etendue::load_failure("libOpenCL.so.1") == "");
    CHECK_THAT(etendue::load_failure("/nowhere/libdead.so"), Catch::Contains("/nowhere/libdead.so"));
    CHECK(etendue::load_failure("/etc/passwd") != "");
}
