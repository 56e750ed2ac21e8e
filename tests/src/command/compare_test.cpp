// etendue compare as a user calls it: exit codes, messages and files.
#include "image/image_io.h"
#include "support/browser.h"
#include "support/child_process.h"
#include "support/compared_pictures.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <limits>
#include <memory>

#include <json/json.h>

using namespace etendue;
using Catch::Contains;

namespace
{
const std::string ETENDUE = ETENDUE_BINARY_DIR "/etendue";
using Words = std::vector<std::string>;

// A folder with a reference, a picture that is as good, and one that is too bright in a tile.
struct Pictures : TemporaryFolder {
    Pictures()
    {
        write_image(noisy_picture(1), *this / "reference.exr");
        write_image(noisy_picture(2), *this / "good.exr");
        Image bright = noisy_picture(3);
        brighten(bright, {16, 8, 12, 10}, 1.2f);
        write_image(bright, *this / "bright.exr");
    }
    std::string operator/(const std::string& name) const { return (path() / name).string(); }

    // etendue compare NAME reference.exr WORDS
    ChildResult compare(const std::string& name, const Words& words = {}) const
    {
        Words all{"compare", *this / name, *this / "reference.exr"};
        all.insert(all.end(), words.begin(), words.end());
        return run_child(ETENDUE, all);
    }
};

Json::Value parse(const std::string& text)
{
    Json::Value json;
    std::string errors;
    const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
    REQUIRE(reader->parse(text.data(), text.data() + text.size(), &json, &errors));
    return json;
}
} // namespace

TEST_CASE("compare ends with 0 where noise explains everything, with 5 where not", "[command][compare]")
{
    const Pictures pictures;
    const ChildResult good = pictures.compare("good.exr");
    INFO(good.output << good.errors);
    CHECK(good.exit_code == 0);
    CHECK_THAT(good.output, Contains("No difference at the level 0.001."));
    CHECK_THAT(good.output, Contains("relMSE") && Contains("MAPE") && Contains("PSNR"));
    CHECK_THAT(good.output, Contains("could have seen") && Contains("standard errors"));
    CHECK(good.errors.empty());

    const ChildResult bright = pictures.compare("bright.exr");
    INFO(bright.output << bright.errors);
    CHECK(bright.exit_code == 5);
    CHECK_THAT(bright.output, Contains("The pictures differ beyond the level 0.001."));
    CHECK_THAT(bright.output, Contains("of the tile at 16,8"));

    CHECK_THAT(pictures.compare("reference.exr").output, Contains("The pictures are equal in every value."));
}

TEST_CASE("compare --quiet says nothing but that they differ", "[command][compare]")
{
    const Pictures pictures;
    const ChildResult good = pictures.compare("good.exr", {"--quiet"}),
                      bright = pictures.compare("bright.exr", {"--quiet"});
    CHECK((good.output + good.errors).empty());
    CHECK(bright.exit_code == 5);
    CHECK(bright.output.empty());
    CHECK_THAT(bright.errors, Contains("warning: The pictures differ beyond the level 0.001."));
}

TEST_CASE("compare prints the metrics it is asked for, and knows no others", "[command][compare]")
{
    const Pictures pictures;
    const ChildResult two = pictures.compare("good.exr", {"--metrics", "mape,psnr"});
    CHECK(two.exit_code == 0);
    CHECK_THAT(two.output, Contains("MAPE") && Contains("PSNR") && !Contains("relMSE"));
    const ChildResult wrong = pictures.compare("good.exr", {"--metrics", "mse,relmes"});
    CHECK(wrong.exit_code == 1);
    CHECK_THAT(wrong.errors, Contains("relmes") && Contains("did you mean \"relmse\"?"));
    CHECK(pictures.compare("good.exr", {"--metrics", "mse,"}).exit_code == 1);
}

TEST_CASE("compare refuses what it cannot compare", "[command][compare]")
{
    const Pictures pictures;
    Image small = noisy_picture(1), moved = small;
    small.height = small.full_height = 16;
    small.data.resize(small.data.size() / 2);
    moved.x = 2;
    moved.full_width = 60;
    write_image(small, pictures / "small.exr");
    write_image(moved, pictures / "moved.exr");
    write_file(pictures / "text.exr", "not a picture");

    struct {
        std::string name;
        Words words;
        int exit_code;
        std::string message;
    } const cases[] = {
        {"small.exr", {}, 1, "A has 48x16 pixels, B has 48x32"},
        {"moved.exr", {}, 1, "A begins at 2,0, B at 0,0"},
        {"text.exr", {}, 4, "text.exr: cannot be read as a picture"},
        {"missing.exr", {}, 4, "missing.exr: there is no such file."},
        {"good.exr", {"--tile", "0"}, 1, "between 1 and 65536"},
        {"good.exr", {"--alpha", "1"}, 1, "between 0 and 1"},
        {"good.exr", {"--alpha", "nan"}, 1, "between 0 and 1"},
        {"good.exr", {"--variance", "some"}, 1, "--variance"},
        {"good.exr", {"--html", pictures / "no/such/folder.html"}, 4, "does not exist"},
        {"good.exr", {"--diff", pictures / "diff.hdr"}, 1, "negative"},
        {"good.exr", {"--diff", pictures / "diff.gif"}, 1, ".gif"},
    };
    for (const auto& one : cases) {
        const ChildResult result = pictures.compare(one.name, one.words);
        INFO(one.message << "\n" << result.output << result.errors);
        CHECK(result.exit_code == one.exit_code);
        CHECK_THAT(result.errors, Contains(one.message));
    }
}

TEST_CASE("compare fails a picture with one pixel that is not finite", "[command][compare]")
{
    const Pictures pictures;
    Image bad = noisy_picture(2);
    bad.data[7] = std::numeric_limits<float>::quiet_NaN();
    write_image(bad, pictures / "bad.exr");
    const ChildResult result = pictures.compare("bad.exr", {"--html", pictures / "bad.html"});
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 5);
    CHECK_THAT(result.output, Contains("1 pixel is not finite"));
    CHECK_THAT(read_file(pictures / "bad.html"), Contains("Failed: values are not finite"));
}

TEST_CASE("compare writes JSON that says what the table says", "[command][compare]")
{
    const Pictures pictures;
    const ChildResult result = pictures.compare("bright.exr", {"--json", "-", "--tile", "16", "--alpha", "0.01"});
    CHECK(result.exit_code == 5);
    const Json::Value json = parse(result.output);
    CHECK_FALSE(json["passed"].asBool());
    CHECK(json["alpha"].asDouble() == 0.01);
    CHECK(json["tiles"]["tile"].asInt() == 16);
    CHECK(json["tiles"]["columns"].asInt() == 3);
    CHECK(json["tiles"]["p_values"].size() == 3 * 2 * 3);
    CHECK(json["variance"].asString() == "stderr");
    CHECK(json["metrics"]["mse"].asDouble() > 0);
    CHECK_THAT(json["metrics"]["definitions"]["relmse"].asString(), Contains("0.01 mean r"));
    CHECK(json["detectable_bias"].asDouble() > 0);
    CHECK(json["failures"].size() >= 1);
    CHECK_THAT(json["command"].asString(), Contains("etendue compare") && Contains("--tile 16"));

    // What is infinite is null, in a file too.
    CHECK(pictures.compare("reference.exr", {"--json", pictures / "same.json"}).exit_code == 0);
    CHECK(parse(read_file(pictures / "same.json"))["metrics"]["psnr"].isNull());
}

TEST_CASE("compare writes the difference as numbers and as colours", "[command][compare]")
{
    const Pictures pictures;
    CHECK(pictures.compare("bright.exr", {"--diff", pictures / "diff.exr"}).exit_code == 5);
    const Image diff = read_image(pictures / "diff.exr"), a = read_image(pictures / "bright.exr"),
                b = read_image(pictures / "reference.exr");
    REQUIRE(diff.pixel_count() == a.pixel_count());
    for (int x = 0; x < diff.width; ++x) CHECK(diff.at(x, 9, diff.channel("G")) == a.at(x, 9, 1) - b.at(x, 9, 1));

    CHECK(pictures.compare("bright.exr", {"--diff", pictures / "diff.png"}).exit_code == 5);
    const Image colours = read_image(pictures / "diff.png");
    // Too bright is red.
    CHECK(colours.at(20, 12, 0) > colours.at(20, 12, 2));
}

TEST_CASE("compare takes pictures of 8 bits and half as many channels", "[command][compare]")
{
    const Pictures pictures;
    write_image(noisy_picture(2), pictures / "good.png");
    const ChildResult result = pictures.compare("good.png");
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, Contains("A has no channel stderr.R"));
}

TEST_CASE("the page of compare is one that a browser shows as it should be", "[command][compare][browser]")
{
    const Pictures pictures;
    const std::string folder = ETENDUE_BINARY_DIR "/pictures";
    std::filesystem::create_directories(folder);
    for (const std::string name : {"bright", "good"}) {
        const std::string page = folder + "/compare_" + name + ".html";
        pictures.compare(name + ".exr", {"--html", page});
        const std::string text = read_file(page);
        CHECK_THAT(text, Contains(name == "good" ? "No difference at the level 0.001" : "The pictures differ beyond"));
        CHECK_THAT(text, Contains("etendue compare " + pictures / (name + ".exr")));
        check_page(page);
        CHECK(view_page(page, {1280}).at(0).images == 4);
    }
    photograph_page(folder + "/compare_bright.html", 1280, 2300, folder + "/compare_1280.png");
    photograph_page(folder + "/compare_bright.html", 400, 3600, folder + "/compare_400.png");
    photograph_page(folder + "/compare_good.html", 1280, 2300, folder + "/compare_dark.png", true);
}

TEST_CASE("compare explains itself", "[command][compare]")
{
    const ChildResult help = run_child(ETENDUE, {"compare", "--help"});
    CHECK(help.exit_code == 0);
    CHECK_THAT(help.output, Contains("Examples:") && Contains("--variance") && Contains("Exit codes"));
}
