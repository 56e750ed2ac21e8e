// etendue check as a user calls it: what it prints, and its exit codes.
#include "support/child_process.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <sstream>

using namespace etendue;
using Catch::Contains;
using Catch::StartsWith;

namespace
{
using Words = std::vector<std::string>;

ChildResult check(Words words)
{
    words.insert(words.begin(), "check");
    return run_child(ETENDUE_BINARY_DIR "/etendue", words);
}

// A room that glows, seen by 8 x 8 pixels, under constant roulette: its mean is 2, with a variance of 0.36.
std::string room(const std::string& fact, const std::string& tier = "quick")
{
    return fmt::format(R"({{
        "expect": {{"because": "a test", "tier": "{}", "facts": [{}]}},
        "camera": {{"position": [0.1, 0.2, -0.3], "look_at": [0.5, -0.1, 0.4], "vertical_fov": 100}}, "film": {{"size": [8, 8]}},
        "integrator": {{"type": "bsdf", "max_depth": "unlimited", "roulette": {{"type": "constant", "probability": 0.8, "start": 0}}}},
        "sampler": {{"type": "independent", "spp": 64}}, "materials": [{{"name": "grey", "type": "diffuse", "albedo": 0.5}}],
        "shapes": [{{"type": "box", "size": [2, 2, 2], "material": "grey", "flip_normals": true, "emission": {{"radiance": 1}}}}]}})",
                       tier, fact);
}

const std::string RIGHT = R"({"subject": "mean", "value": 2, "delta": 0.5})";
const std::string WRONG = R"({"subject": "mean", "value": 3, "delta": 0.5})";
const std::string WEAK = R"({"subject": "mean", "value": 2, "delta": 0.001})";

class Folder
{
public:
    std::string add(const std::string& name, const std::string& text)
    {
        const std::string path = (folder_.path() / name).string();
        write_file(path, text);
        return path;
    }
    std::string path() const { return folder_.path().string(); }

private:
    TemporaryFolder folder_;
};
} // namespace

TEST_CASE("a scene that is as it expects passes with exit code 0", "[render][command]")
{
    Folder folder;
    const ChildResult result = check({folder.add("right.json", room(RIGHT))});
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, Contains("passed       right ") && Contains("1 passed, 0 failed, 0 underpowered"));
    CHECK(result.errors.empty());
}

TEST_CASE("a failure is exit code 5, and so is a test without power", "[render][command]")
{
    Folder folder;
    const ChildResult wrong = check({folder.add("wrong.json", room(WRONG))});
    CHECK(wrong.exit_code == 5);
    CHECK_THAT(wrong.output, Contains("FAILED       wrong ") && Contains("1 failed"));
    const ChildResult weak = check({folder.add("weak.json", room(WEAK))});
    CHECK(weak.exit_code == 5);
    CHECK_THAT(weak.output, Contains("UNDERPOWERED weak ") && Contains("1 underpowered") &&
                                Contains("% could hide, 0.1 % must not"));
    // The same for all tests without a delta of their own.
    const std::string plain = folder.add("plain.json", room(R"({"subject": "mean", "value": 2})"));
    CHECK(check({plain, "--delta", "0.5"}).exit_code == 0);
    CHECK(check({plain, "--delta", "0.001"}).exit_code == 5);
}

TEST_CASE("a wrong scene is exit code 2, a missing one 4, and a misspelt group 1 with a suggestion", "[command]")
{
    Folder folder;
    const ChildResult formula = check({folder.add("formula.json", room(R"({"subject": "mean", "value": "2*"})"))});
    CHECK(formula.exit_code == 2);
    CHECK_THAT(formula.errors, Contains("formula.json:2:") && Contains("/expect/facts/0/value"));
    CHECK(check({folder.path() + "/missing.json"}).exit_code == 4);
    const ChildResult group = check({"analitic"});
    CHECK(group.exit_code == 1);
    CHECK_THAT(group.errors, Contains("Unknown group of checks \"analitic\"; did you mean \"analytic\"?"));
    CHECK(check({folder.add("plain.json", R"({"environment": {"radiance": 1}})")}).exit_code == 1);
    CHECK(check({"stiff", "--only", "no such check"}).exit_code == 1);
    CHECK(check({"stiff", "--seed", "stale"}).exit_code == 1);
}

TEST_CASE("the list names every case, and those that need features to come", "[command]")
{
    const ChildResult all = check({"--list", "--long"});
    CHECK(all.exit_code == 0);
    for (const char* id : {"F1-", "F2-", "F3-", "F4-", "F5-", "F6-", "F7-", "F8-", "F9-",  "F10-", "F11-", "L0-", "L1-",
                           "L2-", "L3-", "L4-", "L5-", "L6-", "L7-", "L8-", "L9-", "L10-", "L11-", "S1-",  "S2-", "S3-",
                           "S4-", "S5-", "G1-", "G2-", "G3-", "B2-", "B3-", "B4-", "R2-",  "R4-",  "M1-",  "M2-", "M3-",
                           "M5-", "M6-", "P1-", "P2-", "P3-", "P4-", "E1-", "E2-", "E3-",  "E4-",  "A1-",  "I1-"})
        CHECK_THAT(all.output, Contains(std::string(" ") + id));
    CHECK_THAT(check({"analytic", "--list"}).output, !Contains("S1-base") && Contains("F1-albedo-0.8-depth-8"));
    const ChildResult some = check({"--list", "--only", "F5-depth-?", "--only", "S1-base"});
    CHECK(std::count(some.output.begin(), some.output.end(), '\n') == 5);
}

TEST_CASE("a folder is checked, long scenes only when asked for, unless they are named", "[render][command]")
{
    Folder folder;
    folder.add("a.json", room(RIGHT));
    const std::string slow = folder.add("b.json", room(WRONG, "long"));
    const ChildResult quick = check({folder.path()});
    CHECK(quick.exit_code == 0);
    // The two fine checks and b.
    CHECK_THAT(quick.output, Contains("1 passed, 0 failed") && Contains("3 checks that take long were left out"));
    CHECK(check({folder.path(), "--long"}).exit_code == 5);
    CHECK(check({slow}).exit_code == 5);
    CHECK(check({folder.path(), "--only", "b*"}).exit_code == 1);
}

TEST_CASE("what there is no time for is said, and is no success", "[render][command]")
{
    Folder folder;
    const ChildResult result = check({folder.add("right.json", room(RIGHT)), "--budget", "0"});
    CHECK(result.exit_code == 5);
    CHECK_THAT(result.output, Contains("1 checks were not run for want of time, the first is right"));
}

TEST_CASE("what needs features to come is listed and does not fail", "[command]")
{
    const ChildResult result = check({"stiff", "--only", "M6-*"});
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, Contains("not covered") && Contains("M6-conductor") && Contains("0 passed") &&
                                  Contains("1 not covered yet"));
}

TEST_CASE("quiet prints what is not passed and the summary", "[render][command]")
{
    Folder folder;
    folder.add("a.json", room(RIGHT));
    folder.add("b.json", room(WRONG));
    const ChildResult result = check({folder.path(), "--quiet"});
    CHECK(result.exit_code == 5);
    CHECK_THAT(result.output,
               !Contains("passed       a ") && Contains("FAILED       b ") && Contains("1 passed, 1 failed"));
}

TEST_CASE("the JSON file has every result, and a folder that is missing is found before anything runs",
          "[render][command]")
{
    Folder folder;
    const std::string scene = folder.add("wrong.json", room(WRONG)), file = folder.path() + "/check.json";
    CHECK(check({scene, "--json", file, "--alpha", "0.01"}).exit_code == 5);
    Json::Value json;
    std::istringstream(read_file(file)) >> json;
    CHECK(json["passed"] == false);
    CHECK(json["family"]["alpha"] == 0.01);
    CHECK(json["family"]["tests"] == 1);
    CHECK(json["command"].asString().starts_with("etendue check "));
    CHECK(json["runs"][0]["canary"]["passed"] == true);
    CHECK(json["runs"][0]["canary"]["findings"].size() > 0);
    const Json::Value& result = json["runs"][0]["results"][0];
    CHECK(result["name"] == "wrong");
    CHECK(result["verdict"] == "failed");
    CHECK(result["unit"] == "z");
    CHECK(result["statistic"].asDouble() > 50.0);
    CHECK(result["critical"].asDouble() == Approx(2.576).epsilon(0.01));
    const ChildResult missing = check({scene, "--json", folder.path() + "/nowhere/check.json"});
    CHECK(missing.exit_code == 4);
    CHECK(missing.output.empty());
}

TEST_CASE("fresh seeds are said, differ from run to run, and try a failure again", "[render][command]")
{
    Folder folder;
    const std::string right = folder.add("right.json", room(RIGHT)), wrong = folder.add("wrong.json", room(WRONG));
    const ChildResult first = check({right, "--seed", "fresh"}), second = check({right, "--seed", "fresh"});
    CHECK_THAT(first.output, StartsWith("seed "));
    CHECK(first.exit_code == 0);
    CHECK(first.output.substr(0, first.output.find('\n')) != second.output.substr(0, second.output.find('\n')));
    const ChildResult again = check({wrong, "--seed", "fresh"});
    CHECK(again.exit_code == 5);
    CHECK_THAT(again.output, Contains("tried again with 16 times the samples"));
}
