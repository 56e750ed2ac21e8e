#include "scene/fields.h"

using namespace etendue;

namespace
{
const Table& thing_table()
{
    static const Table table{"thing",
                             "",
                             {{"weight", Kind::number, {0, 10}, "2.5"},
                              {"count", Kind::integer, {0}, "7"},
                              {"paint", Kind::colour, {0, 1}, "[0, 0.5, 1]"},
                              {"limit", Kind::depth, {0, 9}, "\"unlimited\""},
                              {"mode", Kind::name, {}, "\"slow\"", "", {"fast", "slow"}},
                              {"frame", Kind::matrix}},
                             {{"round", "", {{"radius", Kind::number, {}, REQUIRED}}}, {"flat", "", {}}},
                             "flat",
                             true};
    return table;
}
} // namespace

TEST_CASE("keys that are not there have the defaults of the table", "[host]")
{
    const json::Document document("{}", "a.json");
    const Fields fields(document.root(), thing_table());
    CHECK(fields.variant() == 1);
    CHECK(fields.number("weight") == 2.5);
    CHECK(fields.integer("count") == 7);
    CHECK(fields.colour("paint") == Vec3(0, 0.5, 1));
    CHECK_FALSE(fields.depth("limit").has_value());
    CHECK(fields.name("mode") == 1);
}

TEST_CASE("keys that are there are read", "[host]")
{
    const json::Document document(
        R"({"type": "round", "radius": 3, "count": 18446744073709551615, "paint": 0.25, "limit": 9,
        "frame": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16]})",
        "a.json");
    const Fields fields(document.root(), thing_table());
    CHECK(fields.variant() == 0);
    CHECK(fields.number("radius") == 3);
    CHECK(fields.integer("count") == 18446744073709551615u);
    CHECK(fields.reals("paint") == std::vector<double>{0.25, 0.25, 0.25});
    CHECK(fields.depth("limit") == 9u);
    // Rows of the file are rows of the matrix: (2, 0, 0, 0) is transformed to twice the first column.
    CHECK(fields.matrix("frame") * Vec4(2, 0, 0, 0) == Vec4(2, 10, 18, 26));
}

TEST_CASE("a name alone stands for its object where the table allows it", "[host]")
{
    const json::Document document(R"({"a": "flat", "b": "round"})", "a.json");
    CHECK(Fields(document.root()["a"], thing_table()).number("weight") == 2.5);
    CHECK_THROWS_WITH(Fields(document.root()["b"], thing_table()),
                      Catch::Contains("this thing of type round needs the key \"radius\": a number"));
}

TEST_CASE("unknown keys fail or are collected", "[host]")
{
    const json::Document document(R"({"wait": 3, "paint": 1})", "a.json");
    CHECK_THROWS_WITH(Fields(document.root(), thing_table()),
                      Catch::Contains("/wait: unknown thing key \"wait\"; there are: type, weight"));
    std::vector<std::string> ignored;
    const Fields fields(document.root(), thing_table(), UnknownKeys::collect(ignored));
    CHECK(ignored == std::vector<std::string>{"/wait"});
}
