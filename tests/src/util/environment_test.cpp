// Environment variables.
#include "util/environment.h"

#include <catch2/catch.hpp>

using namespace etendue;

TEST_CASE("a variable of the environment that is set can be read, and one that is not is empty")
{
    CHECK(environment("ETENDUE_TEST_VARIABLE") == "");
    set_environment("ETENDUE_TEST_VARIABLE", "a b");
    CHECK(environment("ETENDUE_TEST_VARIABLE") == "a b");
    set_environment("ETENDUE_TEST_VARIABLE", "");
    CHECK(environment("ETENDUE_TEST_VARIABLE") == "");
}
