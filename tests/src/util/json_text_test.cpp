#include "util/json_text.h"

using namespace etendue;

TEST_CASE("offsets and lines agree for every kind of line end", "[host]")
{
    const json::Text text("ab\ncd\r\nef\rgh", "a.json");
    CHECK(text.location(0).line == 1);
    CHECK(text.location(4).line == 2);
    CHECK(text.location(4).column == 2);
    CHECK(text.location(7).line == 3);
    CHECK(text.location(10).line == 4);
    CHECK(text.location(11).excerpt == "gh");
    CHECK(text.location(1000).column == 3);
    for (std::size_t offset : {0u, 1u, 3u, 4u, 7u, 8u, 10u, 11u}) {
        const SourceLocation where = text.location(offset);
        CHECK(text.offset(static_cast<std::size_t>(where.line), static_cast<std::size_t>(where.column)) == offset);
    }
}

TEST_CASE("of a long line the excerpt keeps what stands around the column", "[host]")
{
    std::string line;
    for (int i = 0; i < 3000; ++i) line += std::to_string(i % 10);
    line += "é";
    const json::Text text(line, "a.json");
    for (std::size_t offset : {0u, 59u, 60u, 61u, 1500u, 2950u, 2999u}) {
        const SourceLocation where = text.location(offset);
        CHECK(where.excerpt.size() < 130);
        CHECK(where.column == static_cast<int>(offset) + 1);
        CHECK(where.excerpt[static_cast<std::size_t>(where.column - where.excerpt_column)] == line[offset]);
    }
}

TEST_CASE("the scan takes exactly the numbers of JSON", "[host]")
{
    for (const char* good : {"0", "-0", "1", "10", "-1.5", "1e5", "1E+5", "1.25e-7", "123456789012345678901234567890"})
        CHECK_NOTHROW(json::Text(good, "a").check());
    for (const char* bad : {"01", "+1", ".5", "5.", "-", "1e", "1e+", "0x10", "1.2.3", "--1", "1_000", "1e999", "NaN",
                            "-Infinity", "inf", "tru", "True"})
        CHECK_THROWS_AS(json::Text(bad, "a").check(), SceneError);
}
