#include "util/revision.h"

#include "support/child_process.h"

#include <catch2/catch.hpp>

#include <string>

namespace etendue
{
TEST_CASE("the revision is a commit of this repository", "[util]")
{
    const std::string revision = REVISION;
    const ChildResult git = run_child("git", {"-C", ETENDUE_SOURCE_DIR, "rev-parse", "--is-inside-work-tree"});
    if (git.exit_code != 0) {
        CHECK(revision == "unknown");
        return;
    }
    const std::string commit = revision.substr(0, revision.find("-dirty"));
    CAPTURE(revision);
    CHECK(run_child("git", {"-C", ETENDUE_SOURCE_DIR, "cat-file", "-e", commit + "^{commit}"}).exit_code == 0);
}
} // namespace etendue
