#include "scene/table.h"

using namespace etendue;

TEST_CASE("a range says in words what it contains", "[host]")
{
    CHECK(Range{0, 1}.text() == "between 0 and 1");
    CHECK(Range{0, 180, true, true}.text() == "greater than 0 and less than 180");
    CHECK(Range{0.5}.text() == "at least 0.5");
    CHECK(Range{}.text().empty());
    CHECK(Range{0, 1}.contains(1.0));
    CHECK_FALSE(Range{0, 1, true, true}.contains(1.0));
    CHECK_FALSE(Range{0, 1, true, true}.contains(0.0));
    CHECK_FALSE(Range{0, 1}.contains(std::numeric_limits<double>::quiet_NaN()));
}

TEST_CASE("numbers in messages are short", "[host]")
{
    CHECK(number_text(600) == "600");
    CHECK(number_text(0.1) == "0.1");
    CHECK(number_text(-1e15) == "-1e+15");
}
