#include "util/shell_word.h"

#include "support/child_process.h"

#include <catch2/catch.hpp>

using namespace etendue;

TEST_CASE("a shell reads a quoted word as it was", "[util]")
{
    CHECK(shell_word("scenes/a.json") == "scenes/a.json");
    for (const std::string word : {"", "a b", "it's", "$HOME", "*", "{\"type\":\"lbvh\"}", "a\\b", "-x"}) {
        CAPTURE(word);
        CHECK(run_child("/bin/sh", {"-c", "printf %s " + shell_word(word)}).output == word);
    }
}
