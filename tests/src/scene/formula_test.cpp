#include "scene/formula.h"

#include "util/error.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace etendue;
using Catch::Contains;

namespace
{
FormulaText formula(const std::string& text)
{
    return {text, {"test.json", 7, 3, "/expect/x", "", 1}};
}

double value(const std::string& text)
{
    return Formulas({}).evaluate(formula(text));
}

std::string error_of(const std::function<void()>& action)
{
    try {
        action();
    } catch (const SceneError& error) {
        return error.what();
    }
    return "no error";
}
} // namespace

TEST_CASE("a formula is arithmetic with functions and constants", "[host]")
{
    CHECK(value("1") == 1.0);
    CHECK(value("2+3*4^2") == 50.0);
    CHECK(value("-2^2") == -4.0);
    CHECK(value("atan2(1,-1)") == 0.75 * value("pi"));
    CHECK(value("min(3,2)+max(3,2)") == 5.0);
    CHECK(value("sqrt(2)*abs(-1)") == std::sqrt(2.0));
    CHECK(value("pi") == std::acos(-1.0));
    CHECK(value("u") == std::pow(2.0, -24));
    CHECK(value("1e-12") == 1e-12);
}

TEST_CASE("a comma makes two formulas, which are not a number", "[host]")
{
    CHECK_THAT(error_of([] { value("0,5"); }), Contains("test.json:7:3") && Contains("\"0,5\" is 2 numbers, not one"));
}

TEST_CASE("float rounds to single precision", "[host]")
{
    CHECK(value("float(0.1)") == static_cast<double>(0.1f));
    // What becomes of the mean of a nearly white room, 1.3 % less.
    CHECK(value("1/(1-float(0.999999))") == Approx(986895).epsilon(1e-5));
}

TEST_CASE("names are formulas of each other, in whatever order", "[host]")
{
    const Formulas formulas(
        {{"D", formula("8")}, {"S", formula("(1-a^n)/(1-a)")}, {"a", formula("float(0.8)")}, {"n", formula("D+1")}});
    CHECK(formulas.evaluate(formula("S")) == Approx(4.32891136).epsilon(1e-7));
    CHECK(formulas.evaluate(formula("2*D+4")) == 20.0);
}

TEST_CASE("what is wrong in a formula is said at its place", "[host]")
{
    const auto starts_at_its_place = Catch::StartsWith("test.json:7:3: /expect/x: ");
    const std::string syntax = error_of([] { value("2*"); });
    CHECK_THAT(syntax, starts_at_its_place && Contains("\"2*\" is not a formula"));
    CHECK_THAT(error_of([] { value(""); }), starts_at_its_place);
    CHECK_THAT(error_of([] {
                   Formulas({{"rho", formula("1")}}).evaluate(formula("rha+1"));
               }),
               starts_at_its_place && Contains("unknown name in a formula \"rha\"; did you mean \"rho\"?"));
    CHECK_THAT(error_of([] { value("1/0"); }), starts_at_its_place && Contains("not a finite number"));
    CHECK_THAT(error_of([] { value("sqrt(-1)"); }), Contains("not a finite number"));
    CHECK_THAT(error_of([] {
                   Formulas({{"a", formula("b+1")}, {"b", formula("a")}});
               }),
               starts_at_its_place && Contains("made of itself"));
    CHECK_THAT(error_of([] { Formulas({{"2x", formula("1")}}); }), Contains("cannot be a name"));
}
