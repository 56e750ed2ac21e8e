// etendue converge as a user calls it.
#include "command/converge_arguments.h"

#include "support/browser.h"
#include "support/child_process.h"
#include "util/error.h"
#include "util/file.h"
#include "util/revision.h"

#include <catch2/catch.hpp>

#include <json/json.h>

#include <sstream>

using namespace etendue;
using Catch::Contains;

namespace
{
const std::string ETENDUE = ETENDUE_BINARY_DIR "/etendue";
const std::string SCENE = ETENDUE_SOURCE_DIR "/scenes/furnace/furnace.json";

void check_refused(const std::vector<std::string>& words, int exit_code, const std::string& message)
{
    std::vector<std::string> all{"converge"};
    all.insert(all.end(), words.begin(), words.end());
    const ChildResult result = run_child(ETENDUE, all);
    INFO(result.errors);
    CHECK(result.exit_code == exit_code);
    CHECK(result.output.empty());
    CHECK_THAT(result.errors, Contains(message));
}
} // namespace

TEST_CASE("targets and sizes are read, or refused with what is wrong", "[command][converge]")
{
    CHECK(parse_target("mse=1e-3").metric == "mse");
    CHECK(parse_target("mse=1e-3").value == 1e-3);
    CHECK_THROWS_WITH(parse_target("1e-3"), Contains("must be METRIC=VALUE"));
    CHECK_THROWS_WITH(parse_target("relmsee=1e-3"), Contains("relmse"));
    CHECK_THROWS_WITH(parse_target("mse=0"), Contains("a number above 0, is \"0\""));
    CHECK_THROWS_WITH(parse_target("mse=1x"), Contains("a number above 0, is \"1x\""));
    CHECK(parse_size("12x34").height == 34);
    for (const char* const text : {"12", "12x", "x12", "0x5", "12x34x", "1e2x3", "70000x1"})
        CHECK_THROWS_WITH(parse_size(text), Contains("--size must be WxH"));
}

TEST_CASE("a study is what its arguments say", "[command][converge]")
{
    ConvergeArguments arguments;
    arguments.scene = SCENE;
    arguments.folder = "out";
    StudyOptions options = study_options(arguments);
    REQUIRE(options.configurations.size() == 1);
    CHECK(options.configurations[0].name == "default");
    CHECK(options.targets.size() == 3);
    CHECK(options.checkpoints.text() == "spp:1:1024:x2");
    arguments.configurations = {"mine:integrator.type=bsdf"};
    arguments.axes = {"accelerators", "specialization"};
    arguments.targets = {"mse=0.5"};
    options = study_options(arguments);
    CHECK(options.configurations.size() == 5);
    CHECK(options.targets.size() == 1);
    arguments.axes = {"accelerators", "accelerators"};
    CHECK_THROWS_WITH(study_options(arguments), Contains("Two configurations are called"));
}

TEST_CASE("command lines that cannot be carried out end with their exit code and a reason", "[command][converge]")
{
    const TemporaryFolder folder;
    const std::string out = (folder.path() / "out").string();
    check_refused({}, 1, "A scene file is needed");
    check_refused({SCENE}, 1, "--out DIR is needed");
    check_refused({SCENE, "--out", out, "--checkpoints", "spp:1"}, 1, "--checkpoints must be");
    check_refused({SCENE, "--out", out, "--seeds", "0"}, 1, "--seeds must be between 1");
    check_refused({SCENE, "--out", out, "--compare", "colours"}, 1, "axis");
    check_refused({SCENE, "--out", out, "--metrics", "mse,psnr"}, 1, "psnr");
    check_refused({SCENE, "--out", out, "--delta", "2"}, 1, "--delta must be between 0 and 1");
    check_refused({"nothing.json", "--out", out}, 4, "nothing.json");
    CHECK_FALSE(std::filesystem::exists(folder.path() / "out" / "report.html"));
}

TEST_CASE("converge says its verdict and writes a report that a browser shows as it should be",
          "[command][converge][browser]")
{
    const TemporaryFolder folder;
    const std::string out = (folder.path() / "out").string();
    const ChildResult result =
        run_child(ETENDUE, {"converge", SCENE, "--out", out, "--size", "8x8", "--seeds", "2", "--reference", "analytic",
                            "--checkpoints", "spp:1:8:x2", "--config", "full:integrator.type=path", "--config",
                            "plain:integrator.type=bsdf"});
    INFO(result.errors);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.errors, Contains("full: U") && Contains("plain: U")); // not BIASED, not FAILED
    check_page(out + "/report.html");
    // The report says what it was made by, and on what.
    const std::string page = read_file(out + "/report.html");
    for (const char* picture : {"Mean over 2 seeds", "Reference", "Signed error, of the", "p-values: the least"}) {
        CAPTURE(picture);
        std::size_t times = 0;
        for (std::size_t at = 0; (at = page.find(std::string("<figcaption>") + picture, at)) != std::string::npos; ++at)
            ++times;
        CHECK(times == 2);
    }
    CHECK_THAT(page, Contains(REVISION) && Contains("yes, by the canary") && Contains("etendue converge " + SCENE));
    Json::Value json;
    std::istringstream(read_file(out + "/converge.json")) >> json;
    CHECK(json["revision"].asString() == REVISION);
    REQUIRE(json["configurations"].size() == 2);
    for (const Json::Value& configuration : json["configurations"]) {
        REQUIRE(configuration["canaries"].size() == 1);
        CHECK(configuration["canaries"][0]["passed"].asBool());
        CHECK(configuration["canaries"][0]["findings"].size() > 0);
    }
}
