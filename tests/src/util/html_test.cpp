// Pages: what is escaped, what a page is made of, and how a browser shows it.
#include "util/html.h"

#include "support/browser.h"
#include "support/child_process.h"
#include "support/pattern.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <string>

#include <fmt/format.h>

using namespace etendue;
using Catch::Contains;

namespace
{
const std::string HOSTILE = "</title><script>throw 1</script><img src=x onerror=\"throw 2\"> & 'ü'";

// An SVG drawing of any size.
std::string drawing()
{
    return "<?xml version=\"1.0\"?><svg xmlns=\"http://www.w3.org/2000/svg\" aria-label=\"a line\" width=\"720\" "
           "height=\"100\" viewBox=\"0 0 720 100\"><rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>"
           "<text x=\"9\" y=\"40\" font-size=\"14\">a label</text></svg>";
}

// The smallest PNG: one grey pixel.
std::string pixel()
{
    const unsigned char bytes[] = {0x89, 'P',  'N',  'G',  0x0d, 0x0a, 0x1a, 0x0a, 0,    0,    0,    0x0d, 'I',  'H',
                                   'D',  'R',  0,    0,    0,    1,    0,    0,    0,    1,    8,    0,    0,    0,
                                   0,    0x3a, 0x7e, 0x9b, 0x55, 0,    0,    0,    0x0a, 'I',  'D',  'A',  'T',  0x78,
                                   0x9c, 0x63, 0x68, 0,    0,    0,    0x82, 0,    0x81, 0x77, 0xcd, 0x72, 0xb6, 0,
                                   0,    0,    0,    'I',  'E',  'N',  'D',  0xae, 0x42, 0x60, 0x82};
    return {reinterpret_cast<const char*>(bytes), sizeof(bytes)};
}

// Every part there is, with content that tests its limits.
std::string everything()
{
    const std::string path = "/a/very/long/path/without/any/space/" + std::string(120, 'x') + "/picture.exr";
    std::string body = "<h1>" + html_escape("Every part of a page, and " + HOSTILE) + "</h1>\n";
    body += html_verdict(HtmlMark::good, "No difference", "Nothing was found.");
    body += html_verdict(HtmlMark::bad, "Differs " + path, HOSTILE);
    body += html_verdict(HtmlMark::caution, "Unknown", path);
    std::vector<std::string> head;
    std::vector<HtmlCell> row;
    for (int i = 0; i < 14; ++i) {
        head.push_back(fmt::format("column {}", i));
        row.push_back(fmt::format("{}.25e-3", i));
    }
    std::string tables = html_table("A table that is too wide", head, {row, row});
    tables += html_table("A narrow one", {"name", "value", "verdict"},
                         {{"first", "1.5", HtmlCell("passed", HtmlMark::good)},
                          {HOSTILE, "−12.25", HtmlCell("failed", HtmlMark::bad)},
                          {"third", "–", HtmlCell("unsure", HtmlMark::caution)}});
    body += html_section("Tables", tables);
    body += html_section("Definitions", html_definitions({{"file", path}, {HOSTILE, HOSTILE}, {"seconds", "12.5"}}));
    body += html_section("Command", html_code("etendue compare " + path + " b.exr --html " + HOSTILE));
    const HtmlPicture picture{
        path, HOSTILE, "image/png", pixel(), 1, 1, html_scale({"#000000", "#ffffff"}, "0", "half", HOSTILE)};
    body += html_section("Pictures", html_figures({picture, picture, picture, picture}));
    return body + html_section("Drawing", html_drawing("A drawing", drawing()));
}
} // namespace

TEST_CASE("text is escaped, whatever it is", "[util][html]")
{
    CHECK(html_escape("a<b>&\"'ü\n") == "a&lt;b&gt;&amp;&quot;&#39;ü\n");
    CHECK(html_escape(std::string("\0\x1b\x7f", 3)) == "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");
    const std::string page = html_page(HOSTILE, everything());
    CHECK_THAT(page, !Contains("<script") && !Contains("<img src=x"));
}

TEST_CASE("data URIs are base64 (RFC 4648, section 10)", "[util][html]")
{
    const auto digits = [](const std::string& bytes) { return data_uri("text/plain", bytes); };
    const std::string start = "data:text/plain;base64,";
    CHECK(digits("") == start);
    CHECK(digits("f") == start + "Zg==");
    CHECK(digits("fo") == start + "Zm8=");
    CHECK(digits("foo") == start + "Zm9v");
    CHECK(digits("foobar") == start + "Zm9vYmFy");
    CHECK(digits("\xff\xfe\xfd") == start + "//79");
}

TEST_CASE("a page needs nothing but itself", "[util][html]")
{
    const std::string page = html_page("title", everything());
    const auto resources = matches(page, "<[^<>]*\\b(src|href)=\"([^\"]*)\"", 2);
    for (const std::string& resource : resources) CHECK(resource.starts_with("data:"));
    CHECK_THAT(page, !Contains("url(") && !Contains("@import"));
    CHECK(resources.size() >= 5);
    CHECK_THAT(page, !Contains("<?xml"));
}

TEST_CASE("columns of numbers are set to the right, columns of words are not", "[util][html]")
{
    const std::string table = html_table("", {"name", "value"}, {{"a", "1.5"}, {"b", "−2"}, {"c", "–"}});
    CHECK_THAT(table, Contains("<th scope=\"col\" class=\"number\">value</th>"));
    CHECK_THAT(table, Contains("<td class=\"number\">−2</td>"));
    CHECK_THAT(table, Contains("<th scope=\"col\">name</th>") && Contains("<td>a</td>"));
    CHECK_THAT(html_table("", {"mixed"}, {{"1.5"}, {"none"}}), !Contains("class=\"number\""));
}

TEST_CASE("a verdict says by a word and an icon what its colour says", "[util][html]")
{
    CHECK_THAT(html_verdict(HtmlMark::good, "Equal", "x"), Contains("Equal") && Contains("✓") && Contains("good"));
    CHECK_THAT(html_verdict(HtmlMark::bad, "Differs", "x"), Contains("Differs") && Contains("✗") && Contains("bad"));
}

TEST_CASE("a browser shows every part without errors, sideways scrolling or small print", "[util][html][browser]")
{
    const std::string folder = ETENDUE_BINARY_DIR "/pictures";
    std::filesystem::create_directories(folder);
    const std::string path = folder + "/parts.html";
    write_file(path, html_page("Every part of a page", everything()));
    check_page(path);
    CHECK(view_page(path, {700})[0].images == 4);
    photograph_page(path, 1280, 2300, folder + "/parts_1280.png");
    photograph_page(path, 400, 3900, folder + "/parts_400.png", true);
}

TEST_CASE("the browser finds what is wrong with a page", "[util][html][browser]")
{
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "bad.html").string();
    write_file(path, "<!DOCTYPE html><html><head></head><body style=\"margin:0\">"
                     "<img src=\"missing.png\"><div style=\"width:900px;font-size:9px\">small <b style=\"color:#aaa\">"
                     "pale</b></div><script>throw new Error('oops');</script></body></html>");
    const PageView view = view_page(path, {400}).at(0);
    CHECK(view.width == 400);
    CHECK(view.scroll_width == 900);
    REQUIRE(view.errors.size() == 2);
    CHECK_THAT(view.errors[0] + view.errors[1], Contains("oops") && Contains("missing.png"));
    CHECK(view.broken_images == 1);
    CHECK(view.figures_without_text == 1);
    CHECK(view.smallest_text == Approx(9));
    CHECK(view.least_contrast == Approx(2.32).margin(0.05));
    CHECK(view.least_contrast_words == "pale");
}
