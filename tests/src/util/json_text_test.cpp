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

TEST_CASE("a text is UTF-8 where every code point is whole, as short as possible and no surrogate", "[host]")
{
    for (const char* good : {"", "a", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xee\x80\x80",
                             "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf", "é€😀x"}) {
        INFO(good);
        CHECK(json::is_utf8(good));
    }
    for (const char* bad :
         {"\x80", "\xbf", "\xc0\x80", "\xc1\xbf", "\xc3", "\xc3(", "\xe0\x9f\xbf", "\xe2\x82", "\xe2\x82x",
          "\xed\xa0\x80", "\xf0\x8f\xbf\xbf", "\xf0\x9f\x98", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff", "a\xffz"})
        CHECK_FALSE(json::is_utf8(bad));
}

TEST_CASE("strings are UTF-8, and escaped surrogates come in pairs", "[host]")
{
    for (const char* good : {"\"é😀\"", R"("\ud83d\ude00")", R"("\\udc00")", R"("\u0041\n\"")", "1 // latin-1: \xe4"})
        CHECK_NOTHROW(json::Text(good, "a").check());
    const auto message_of = [](const char* text) -> std::string {
        try {
            json::Text(text, "a.json").check();
        } catch (const SceneError& e) {
            return std::string(e.what(), std::string_view(e.what()).find('\n'));
        }
        return "no error";
    };
    CHECK(message_of("\"\xe4\"") == "a.json:1:2: this byte is not UTF-8; save the file in that encoding");
    CHECK(message_of("[\"\xc3\xa4\xc3\"]") == "a.json:1:5: this byte is not UTF-8; save the file in that encoding");
    for (const char* half : {R"("x\udc00")", R"("x\ud800")", R"("x\ud800\ud800")", R"("x\ud800\u0041")", R"("x\uDBFF)"})
        CHECK(message_of(half) == "a.json:1:3: this half of a surrogate pair lacks the other half");
}
