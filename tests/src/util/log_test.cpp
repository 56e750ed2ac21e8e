// Messages and the status line on a stream that plays the terminal.
#include "util/log.h"

#include <catch2/catch.hpp>
#include <sstream>

using namespace etendue;

namespace
{
// What remains visible of a text with \r, "erase to the end of the line" and \n.
std::string visible(const std::string& text)
{
    std::string screen, line;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.compare(i, 4, "\r\x1b[K") == 0) {
            line.clear();
            i += 3;
        } else if (text[i] == '\n') {
            screen += line + '\n';
            line.clear();
        } else {
            line += text[i];
        }
    }
    return screen + line;
}
} // namespace

TEST_CASE("verbosity decides which messages are written, and warnings always are")
{
    const auto written = [](Verbosity verbosity) {
        std::ostringstream stream;
        Log log({stream}, verbosity);
        log.warning("W.");
        log.info("I.");
        log.detail("D.");
        return stream.str();
    };
    CHECK(written(Verbosity::quiet) == "warning: W.\n");
    CHECK(written(Verbosity::normal) == "warning: W.\nI.\n");
    CHECK(written(Verbosity::verbose) == "warning: W.\nI.\nD.\n");
}

TEST_CASE("messages appear above the status line, which stays whole")
{
    std::ostringstream stream;
    Log log({stream, true});
    log.set_status("10 %");
    CHECK(visible(stream.str()) == "10 %");
    log.warning("Hot.");
    CHECK(visible(stream.str()) == "warning: Hot.\n10 %");
    log.set_status("9");
    CHECK(visible(stream.str()) == "warning: Hot.\n9");
    log.keep_status();
    log.info("Done.");
    CHECK(visible(stream.str()) == "warning: Hot.\n9\nDone.\n");
}

TEST_CASE("an empty status removes the line")
{
    std::ostringstream stream;
    {
        Log log({stream, true});
        log.set_status("10 %");
        log.set_status("");
    }
    CHECK(visible(stream.str()).empty());
}

TEST_CASE("there is no status line where lines cannot be redrawn, or in quiet")
{
    std::ostringstream piped, quiet;
    {
        Log log({piped, false});
        log.set_status("10 %");
        Log silent({quiet, true}, Verbosity::quiet);
        silent.set_status("10 %");
    }
    CHECK(piped.str().empty());
    CHECK(quiet.str().empty());
}

TEST_CASE("a log that ends leaves the cursor on a new line")
{
    std::ostringstream stream;
    {
        Log log({stream, true});
        log.set_status("10 %");
    }
    CHECK(stream.str().ends_with("10 %\n"));
}

TEST_CASE("a message does not steer the terminal")
{
    std::ostringstream stream;
    Log log({stream});
    log.warning("The name \x1b[2J\b is odd.");
    CHECK(stream.str() == "warning: The name ?[2J? is odd.\n");
}
