#include "util/json.h"

using namespace etendue;

namespace
{
std::string message_of(const std::string& text, const std::vector<std::string>& overrides = {})
{
    try {
        const json::Document document(text, "a.json", overrides);
    } catch (const Error& e) {
        const std::string message = e.what();
        return message.substr(0, message.find('\n'));
    }
    return "no error";
}
} // namespace

TEST_CASE("every value knows its line, column and path", "[host]")
{
    const json::Document document("{\n  \"a\": [10, {\"b/c\": \"x\"}],\r\n\t\"d\": null }", "a.json");
    const json::Value inner = document.root()["a"][1]["b/c"];
    CHECK(inner.as_string() == "x");
    CHECK(inner.pointer() == "/a/1/b~1c");
    const SourceLocation where = inner.location();
    CHECK(where.file == "a.json");
    CHECK(where.line == 2);
    CHECK(where.column == 21);
    CHECK(where.pointer == "/a/1/b~1c");
    CHECK(where.excerpt == "  \"a\": [10, {\"b/c\": \"x\"}],");
    CHECK(document.root()["d"].location().line == 3);
    CHECK(document.root()["d"].location().column == 7);
    CHECK(document.root()["a"][1].key_location("b/c").column == 14);
}

TEST_CASE("values are described as they are written", "[host]")
{
    const json::Document document(R"({"n": 1.40, "s": "x", "t": true, "z": null, "l": [1], "o": {}})", "a.json");
    const json::Value root = document.root();
    CHECK(root["n"].description() == "1.40");
    CHECK(root["s"].description() == "\"x\"");
    CHECK(root["t"].description() == "true");
    CHECK(root["z"].description() == "null");
    CHECK(root["l"].description() == "a list of 1 value");
    CHECK(root["o"].description() == "an object");
}

TEST_CASE("numbers keep every bit of double precision and of 64-bit integers", "[host]")
{
    const json::Document document("[0.1, -2.5e-7, 18446744073709551615, 5e-324, 1.7976931348623157e308]", "a.json");
    const json::Value root = document.root();
    CHECK(root[0].as_number() == 0.1);
    CHECK(root[1].as_number() == -2.5e-7);
    CHECK(root[2].raw().asUInt64() == 18446744073709551615u);
    CHECK(root[4].as_number() == 1.7976931348623157e308);
}

TEST_CASE("nesting is limited and a bad text never overflows the stack", "[host]")
{
    CHECK(message_of(std::string(64, '[') + std::string(64, ']')) == "no error");
    CHECK(message_of(std::string(20'000'000, '[')) == "a.json:1:65: lists and objects are nested more than 64 deep");
    std::string objects;
    for (int i = 0; i < 1000; ++i) objects += "{\"a\":";
    CHECK(message_of(objects) == "a.json:1:321: lists and objects are nested more than 64 deep");
}

TEST_CASE("a file of more values than memory should hold is refused while it is scanned", "[host]")
{
    std::string text = "[0";
    for (std::size_t i = 0; i < json::MAX_VALUES; ++i) text += ",0";
    // The bracket is the first value; value n > 1 stands in column 2 (n - 1).
    CHECK(message_of(text) ==
          "a.json:1:20000000: more than 10000000 values in one file; a large mesh belongs into a .ply or "
          ".obj file");
}

TEST_CASE("comments are skipped, also where they look like JSON", "[host]")
{
    CHECK(message_of("// {\n{ /* \" [ NaN */ \"a\": 1 } // ]") == "no error");
    CHECK(message_of("{\"a\": \"// no comment\"}") == "no error");
    CHECK(message_of("{\"a\": 1 / 2}") == "a.json:1:9: \"/\" is not JSON; comments are // ... and /* ... */");
}

TEST_CASE("an override replaces a value by dots or by a pointer", "[host]")
{
    const std::string text = R"({"film": {"size": [64, 32]}, "a.b": {"c/d": 1}})";
    CHECK(json::Document(text, "a", {"film.size=[8,8]"}).canonical() ==
          json::Document(R"({"film": {"size": [8, 8]}, "a.b": {"c/d": 1}})", "b").canonical());
    CHECK(json::Document(text, "a", {"/film/size/1=7"}).root()["film"]["size"][1].as_number() == 7);
    CHECK(json::Document(text, "a", {"film.size.1=7"}).root()["film"]["size"][1].as_number() == 7);
    CHECK(json::Document(text, "a", {"/a.b/c~1d=2"}).root()["a.b"]["c/d"].as_number() == 2);
}

TEST_CASE("an override adds keys, and a text that is not JSON is a string", "[host]")
{
    const json::Document document("{\"integrator\": \"path\"}", "a.json",
                                  {"sampler.spp=4", "name=two words", "integrator.max_depth=3", "quoted=\"x=y\""});
    const json::Value root = document.root();
    CHECK(root["sampler"]["spp"].as_number() == 4);
    CHECK(root["name"].as_string() == "two words");
    CHECK(root["quoted"].as_string() == "x=y");
    CHECK(root["integrator"]["type"].as_string() == "path");
    CHECK(root["integrator"]["max_depth"].as_number() == 3);
}

TEST_CASE("later overrides win, and errors in them point into the option", "[host]")
{
    const json::Document document("{\"a\": {\"b\": 1}}", "a.json", {"a={\"b\":2,\"c\":3}", "a.b=4"});
    const json::Value a = document.root()["a"];
    CHECK(a["b"].as_number() == 4);
    const SourceLocation b = a["b"].location(), c = a["c"].location();
    CHECK(b.file == "command line");
    CHECK(b.line == 0);
    CHECK(b.excerpt == "-D a.b=4");
    CHECK(b.column == 8);
    CHECK(c.excerpt == "-D a={\"b\":2,\"c\":3}");
    CHECK(c.column == 17);
    CHECK(a["c"].description() == "3");
}

TEST_CASE("a path that leads nowhere says what is there", "[host]")
{
    const std::string text = R"({"l": [1, 2], "e": [], "n": 5})";
    CHECK(message_of(text, {"l.2=0"}) == "command line: /l is a list; its elements are 0 to 1, not \"2\"");
    CHECK(message_of(text, {"l.first=0"}) == "command line: /l is a list; its elements are 0 to 1, not \"first\"");
    CHECK(message_of(text, {"e.0=0"}) == "command line: /e is an empty list");
    CHECK(message_of(text, {"n.x=0"}) == "command line: /n is neither an object nor a list, so it has no \"x\"");
    CHECK(message_of(text, {"n=[1,"}) == "command line: the value is neither JSON nor a plain name");
    CHECK(message_of(text, {"n"}) == "-D n: an override is written path=value, e.g. film.size=[64,64].");
}

TEST_CASE("an override is UTF-8 and no deeper than a file", "[host]")
{
    std::string path = "a";
    for (std::size_t i = 1; i < json::MAX_DEPTH - 1; ++i) path += ".a";
    const std::string canonical = json::Document("{}", "a", {path + "=[1]"}).canonical();
    CHECK(json::Document(canonical, "b").canonical() == canonical);
    CHECK(json::Document("{}", "a", {path + ".a=1"}).canonical().size() > 4 * json::MAX_DEPTH);
    const std::string too_deep = "command line: path and value are nested more than 64 deep";
    CHECK(message_of("{}", {path + "=[[1]]"}) == too_deep);
    CHECK(message_of("{}", {path + "={\"b\": 2, \"c\": {}}"}) == too_deep);
    CHECK(message_of("{}", {path + ".a.a=1"}) == too_deep);
    CHECK(message_of("{}", {"a=\xff"}) == "-D a=\xff: this option is not UTF-8.");
}

TEST_CASE("the canonical text forgets comments, space and the order of keys, and nothing else", "[host]")
{
    const auto canonical = [](const char* text) { return json::Document(text, "a").canonical(); };
    CHECK(canonical("{\"a\":1, // x\n \"b\":[0.1]}") == canonical("{\"b\":[0.1],\"a\":1}"));
    CHECK(canonical("[0.1]") != canonical("[0.10000000000000002]"));
}
