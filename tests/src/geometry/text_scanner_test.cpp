// Words, lines and numbers.
#include "geometry/text_scanner.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace etendue;

TEST_CASE("lines end in either way and words are separated by any blanks")
{
    TextScanner scanner("a  b\tc\r\n\n d", 10);
    REQUIRE(scanner.next_line());
    CHECK(scanner.line_number() == 11);
    CHECK(scanner.next_word() == "a");
    CHECK(scanner.next_word() == "b");
    CHECK(scanner.next_word() == "c");
    CHECK(scanner.next_word().empty());
    REQUIRE(scanner.next_line());
    CHECK(scanner.next_word().empty());
    CHECK(scanner.rest() == " d");
    REQUIRE(scanner.next_line());
    CHECK(scanner.next_word() == "d");
    CHECK_FALSE(scanner.next_line());
    CHECK(scanner.line_number() == 13);
}

TEST_CASE("a real number is the nearest double and nothing but a whole number word")
{
    CHECK(parse_real("0.1").value() == 0.1);
    CHECK(parse_real("+1.5e3").value() == 1500.0);
    CHECK(parse_real("-.25").value() == -0.25);
    CHECK(parse_real("0.57735026918962576450914878050196").value() == 0.57735026918962576450914878050196);
    CHECK(parse_real("1e39").value() == 1e39);
    CHECK(std::isnan(parse_real("nan").value()));
    CHECK(parse_real("1e400").value() == std::numeric_limits<double>::infinity());
    CHECK(parse_real("-1e400").value() == -std::numeric_limits<double>::infinity());
    CHECK(parse_real("1e-400").value() == 0.0);
    const std::string zeros(400, '0');
    CHECK(parse_real("-1" + zeros).value() == -std::numeric_limits<double>::infinity());
    CHECK(parse_real("1" + zeros + ".5e-9").value() == std::numeric_limits<double>::infinity());
    CHECK(parse_real("1" + zeros + "e-500").value() == 1e-100);
    CHECK(parse_real("0." + zeros + "1e+9").value() == 0.0);
    CHECK(parse_real("0." + zeros + "1E501").value() == 1e100);
    CHECK(parse_real("0e99999999999999999999").value() == 0.0);
    CHECK(parse_real("1e99999999999999999999").value() == std::numeric_limits<double>::infinity());
    CHECK(parse_real("1e-99999999999999999999").value() == 0.0);
    for (const char* word : {"", "1,5", "1.5x", "x", "+-1", "--1", "+", "1e", "0x10"}) {
        INFO(word);
        CHECK_FALSE(parse_real(word).has_value());
    }
}

TEST_CASE("a whole number is the whole word and fits 64 bits")
{
    CHECK(parse_integer("-7").value() == -7);
    CHECK(parse_integer("+7").value() == 7);
    for (const char* word : {"", "7.0", "7/", "99999999999999999999"}) {
        INFO(word);
        CHECK_FALSE(parse_integer(word).has_value());
    }
}

TEST_CASE("a quoted word is short and printable")
{
    CHECK(quote("a\x01\xff") == "\"a??\"");
    CHECK(quote(std::string(50, 'x')) == "\"" + std::string(40, 'x') + "...\"");
}
