#include "util/error.h"

using namespace etendue;

TEST_CASE("a located error has place, path, message, excerpt and caret", "[host]")
{
    const SourceLocation where{"glass.json", 12, 7, "/ior", "\"ior\": 0"};
    CHECK(format_located(where, "must be positive") == "glass.json:12:7: /ior: must be positive\n"
                                                       "  \"ior\": 0\n"
                                                       "        ^");
}

TEST_CASE("a located error leaves out what is not known", "[host]")
{
    CHECK(format_located({"a.json", 3, 1, "", ""}, "is wrong") == "a.json:3:1: is wrong");
    CHECK(format_located({"command line", 0, 4, "/a", "-D a=1"}, "is wrong") == "command line: /a: is wrong\n"
                                                                                "  -D a=1\n"
                                                                                "     ^");
    CHECK(format_located({}, "is wrong") == "is wrong");
}

TEST_CASE("the caret stands below its character after tabs and accents", "[host]")
{
    // Seven bytes and five characters stand before the x.
    const SourceLocation where{"a.json", 1, 8, "", "\té\"é x"};
    CHECK(format_located(where, "bad") == "a.json:1:8: bad\n   é\"é x\n       ^");
}

TEST_CASE("the caret of a cut line counts from the first column that is shown", "[host]")
{
    SourceLocation where{"a.json", 1, 1003, "", "...abc"};
    where.excerpt_column = 998;
    CHECK(format_located(where, "bad") == "a.json:1:1003: bad\n  ...abc\n       ^");
}

TEST_CASE("each kind of error has its exit code", "[host]")
{
    CHECK(UsageError("x").code() == ExitCode::usage);
    CHECK(SceneError("x").code() == ExitCode::scene);
    CHECK(DeviceError("x").code() == ExitCode::device);
    CHECK(BuildError("x").code() == ExitCode::device);
    CHECK(FileError("a", "x").code() == ExitCode::file);
    CHECK(FileError("a", "is lost.").what() == std::string("a: is lost."));
}

TEST_CASE("control characters of a file do not reach the terminal, nor does a zero end the message", "[host]")
{
    const std::string text("a\tb\nc\0d\x1b[31me\x7f\r\x1f é", 19);
    CHECK(SceneError(text).what() == std::string("a\tb\nc?d?[31me??? é"));
}
