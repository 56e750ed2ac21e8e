#include "util/suggestion.h"

using namespace etendue;

TEST_CASE("the nearest name has the fewest edits", "[host]")
{
    const std::vector<std::string> known{"diffuse", "mirror", "glass", "grass"};
    CHECK(nearest_name("glas", known) == "glass");
    CHECK(nearest_name("miror", known) == "mirror");
    CHECK(nearest_name("difuse", known) == "diffuse");
    CHECK(nearest_name("metal", known).empty());
    CHECK(nearest_name("", known).empty());
    CHECK(nearest_name(std::string(1'000'000, 'x'), known).empty());
}

TEST_CASE("an unknown name is answered with a suggestion and all names", "[host]")
{
    CHECK(unknown_name("bsdf", "glas", {"diffuse", "glass"}) ==
          "unknown bsdf \"glas\"; did you mean \"glass\"? there are: diffuse, glass");
    CHECK(unknown_name("material", "x", {}) == "unknown material \"x\"; there are: none");
}

TEST_CASE("a long list of names is cut", "[host]")
{
    std::vector<std::string> names(30, "n");
    CHECK(list_names(names).ends_with("n, n and 6 more"));
    names.resize(24);
    CHECK(list_names(names).ends_with("n, n"));
}
