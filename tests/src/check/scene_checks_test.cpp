// Scenes that judge themselves, on a device.
#include "check/check_picture.h"
#include "check/scene_checks.h"
#include "support/child_process.h"
#include "support/device_evaluate.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <fmt/format.h>

using namespace etendue;
using Catch::Contains;

namespace
{
// A white room that glows, seen by 4 x 4 pixels: every path of depth 3 brings 4.
std::string room(const std::string& facts, const std::string& expect_more = "")
{
    return fmt::format(R"({{
        "expect": {{"because": "a test", {} "facts": [{}]}},
        "camera": {{"position": [0.1, 0.2, -0.3], "look_at": [0.5, -0.1, 0.4], "vertical_fov": 100}},
        "film": {{"size": [4, 4]}}, "integrator": {{"type": "bsdf", "max_depth": 3, "roulette": "off"}}, "sampler": {{"type": "independent", "spp": 2}},
        "materials": [{{"name": "white", "type": "diffuse", "albedo": 1}}],
        "shapes": [{{"type": "box", "size": [2, 2, 2], "material": "white", "flip_normals": true, "emission": {{"radiance": 1}}}}]}})",
                       expect_more, facts);
}

// The results of one scene in a folder of its own.
class SceneFolder
{
public:
    void add(const std::string& name, const std::string& text) { write_file((folder_.path() / name).string(), text); }
    Check check(const std::string& name)
    {
        return scene_check(scenes_at((folder_.path() / name).string()).front()).value();
    }
    std::vector<CheckResult> run(const std::string& name)
    {
        CheckContext context;
        context.device = &test_devices().front();
        return check(name).run(context);
    }
    std::vector<CheckResult> run_text(const std::string& text)
    {
        add("scene.json", text);
        return run("scene.json");
    }
    std::string path() const { return folder_.path().string(); }

private:
    TemporaryFolder folder_;
};

std::string error_of(const std::string& text)
{
    SceneFolder folder;
    folder.add("scene.json", text);
    try {
        folder.check("scene.json");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "no error";
}
} // namespace

TEST_CASE("a scene finds itself right, and wrong when it expects what is not so", "[render]")
{
    SceneFolder folder;
    const CheckResult right =
        folder.run_text(room(R"({"subject": "pixels", "rule": "exact", "value": "D+1"})", R"("where": {"D": 3},)"))
            .front();
    CHECK(right.verdict == Verdict::passed);
    CHECK(right.name == "scene");
    CHECK(right.group == "stiff");
    CHECK(right.expected == "4");
    const CheckResult wrong = folder.run_text(room(R"({"subject": "pixels", "rule": "exact", "value": 5})")).front();
    CHECK(wrong.verdict == Verdict::failed);
    CHECK(wrong.found == "4");
}

TEST_CASE("each fact of a scene has a result with a name of its own", "[render]")
{
    SceneFolder folder;
    const std::vector<CheckResult> results =
        folder.run_text(room(R"({"subject": "mean", "value": 4}, {"subject": "pixels", "value": 4},
        {"subject": "pixels", "value": 5}, {"subject": "rays", "value": 3.9}, {"subject": "rays", "value": 4.1})"));
    REQUIRE(results.size() == 5);
    CHECK(results[0].name == "scene");
    CHECK(results[1].name == "scene/pixels");
    CHECK(results[2].name == "scene/pixels-2");
    CHECK(results[3].name == "scene/rays");
    CHECK(results[0].verdict == Verdict::passed);
    CHECK(results[1].verdict == Verdict::passed);
    CHECK(results[2].verdict == Verdict::failed);
    CHECK(results[3].verdict == Verdict::passed);
    CHECK(results[4].verdict == Verdict::failed);
}

TEST_CASE("statistical facts are counted for the family", "[host]")
{
    SceneFolder folder;
    folder.add("scene.json", room(R"({"subject": "mean", "value": 4}, {"subject": "mean", "value": [4, 4, 4]},
        {"subject": "pixels", "value": 4}, {"subject": "same", "rule": "stat", "specialized": true}, {"subject": "mean", "rule": "round", "value": 4})",
                                  R"("group": "analytic", "tier": "long",)"));
    const Check check = folder.check("scene.json");
    CHECK(check.statistical_tests == 1 + 3 + 3);
    CHECK(check.group == "analytic");
    CHECK(check.is_long);
}

TEST_CASE("facts that ask for little power are judged finely by a long check", "[render]")
{
    SceneFolder folder;
    folder.add("scene.json", room(R"({"subject": "mean", "value": 4, "delta": 0.05}, {"subject": "mean", "value": 4},
        {"subject": "pixels", "value": 4}, {"subject": "mean", "value": 4.001, "delta": 0.01})"));
    folder.add("strict.json",
               room(R"({"subject": "mean", "value": 4, "delta": 0.005}, {"subject": "mean", "value": 4})"));
    const std::vector<Check> checks = scene_checks(scenes_at(folder.path()));
    REQUIRE(checks.size() == 3);
    CHECK_FALSE(checks[0].is_long);
    CHECK(checks[0].statistical_tests == 3);
    CHECK(checks[1].is_long);
    CHECK(checks[1].name == "scene-finely");
    CHECK(checks[1].statistical_tests == 2);
    CHECK(checks[2].name == "strict");

    CheckContext context;
    context.device = &test_devices().front();
    const std::vector<CheckResult> results = checks[1].run(context);
    REQUIRE(results.size() == 2);
    CHECK(results[0].name == "scene-finely");
    CHECK(results[0].verdict == Verdict::passed);
    CHECK(results[1].name == "scene-finely/mean-2");
    CHECK(results[1].verdict == Verdict::failed);
}

TEST_CASE("a fine check has the samples that its power needs, up to 16 times as many", "[render]")
{
    // Roulette by throughput: the number of a path's vertices is geometric.
    SceneFolder folder;
    std::string text = room(R"({"subject": "mean", "value": 2, "delta": DELTA})");
    const auto replace = [&](const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
    };
    replace("\"albedo\": 1", "\"albedo\": 0.5");
    replace("\"max_depth\": 3, \"roulette\": \"off\"",
            R"("max_depth": "unlimited", "roulette": {"type": "throughput", "start": 0})");
    replace("[4, 4]", "[16, 16]");
    replace("\"spp\": 2", "\"spp\": 128");
    const auto gain = [&](const std::string& delta, double wanted) {
        std::string scene = text;
        scene.replace(scene.find("DELTA"), 5, delta);
        folder.add("scene.json", scene);
        CheckContext context;
        context.device = &test_devices().front();
        context.delta = wanted;
        const std::vector<Check> checks = scene_checks(scenes_at(folder.path()));
        REQUIRE(checks.size() == 2);
        const CheckResult plain = checks[0].run(context).front(), fine = checks[1].run(context).front();
        CHECK(plain.verdict == Verdict::passed);
        CHECK(fine.verdict == Verdict::passed);
        return plain.detectable_bias / fine.detectable_bias;
    };
    CHECK(gain("0.05", 0.025) == Approx(2).epsilon(0.02));
    CHECK(gain("0.04", 0.005) == Approx(4).epsilon(0.02));
    CHECK(gain("0.05", 0.05) == Approx(1));
}

TEST_CASE("a scene is compared with itself rendered otherwise and with its neighbour", "[render]")
{
    SceneFolder folder;
    folder.add("other.json", room(R"({"subject": "pixels", "value": 4})"));
    const std::vector<CheckResult> results = folder.run_text(
        room(R"({"subject": "same", "specialized": true}, {"subject": "same", "overrides": ["accelerator=lbvh"]},
        {"subject": "same", "scene": "other.json"}, {"subject": "same", "scene": "other.json", "overrides": ["integrator.max_depth=2"]})"));
    REQUIRE(results.size() == 4);
    CHECK(results[0].verdict == Verdict::passed);
    CHECK(results[1].verdict == Verdict::passed);
    CHECK(results[2].verdict == Verdict::passed);
    CHECK(results[3].verdict == Verdict::failed);
}

TEST_CASE("a load error that is expected passes, one that does not come fails", "[host]")
{
    SceneFolder folder;
    folder.add("scene.json",
               room(R"({"subject": "load_error", "text": "unknown bsdf", "overrides": ["materials.0.type=glas"]},
        {"subject": "load_error", "text": "unknown bsdf", "overrides": ["materials.0.albedo=0.5"]},
        {"subject": "load_error", "text": "has no area", "overrides": ["materials.0.type=glas"]})"));
    CheckContext context;
    const std::vector<CheckResult> results = folder.check("scene.json").run(context);
    REQUIRE(results.size() == 3);
    CHECK(results[0].verdict == Verdict::passed);
    CHECK(results[1].verdict == Verdict::failed);
    CHECK(results[1].found == "nothing said");
    CHECK(results[2].verdict == Verdict::failed);
}

TEST_CASE("a warning that is expected passes, one that does not come fails", "[render]")
{
    SceneFolder folder;
    const std::string dark = room(R"({"subject": "warning", "text": "nothing in the scene emits light"})");
    CHECK(folder.run_text(dark).front().verdict == Verdict::failed);
    std::string text = dark;
    text.replace(text.find("\"radiance\": 1"), 13, "\"radiance\": 0");
    CHECK(folder.run_text(text).front().verdict == Verdict::passed);
}

TEST_CASE("the seed and the effort of a run change the picture of a scene", "[render]")
{
    const std::string text = room(R"({"subject": "mean", "value": 4})");
    const LoadedScene loaded = parse_scene(text, "scene.json");
    CheckContext context;
    context.device = &test_devices().front();
    context.effort = 16.0;
    LoadedScene grey = loaded;
    grey.scene.integrator.roulette = RouletteType::constant;
    grey.scene.integrator.roulette_start = 0;
    const CheckPicture first = check_picture(context, grey, {});
    CHECK(first.pixels.front().samples == 32);
    CHECK(first.accident.empty());
    const auto same = [&](const CheckPicture& other) {
        for (std::size_t i = 0; i < first.pixels.size(); ++i)
            if (first.pixels[i].mean != other.pixels[i].mean) return false;
        return true;
    };
    CHECK(same(check_picture(context, grey, {})));
    context.seed = 1;
    CHECK_FALSE(same(check_picture(context, grey, {})));
}

TEST_CASE("a wrong formula is found before anything runs", "[host]")
{
    CHECK_THAT(error_of(room(R"({"subject": "pixels", "value": "2*"})")),
               Contains("scene.json:") && Contains("/expect/facts/0/value"));
    CHECK_THAT(error_of(room(R"({"subject": "pixels", "value": "E"})", R"("where": {"D": 3},)")),
               Contains("unknown name in a formula \"E\""));
    CHECK_THAT(error_of(room(R"({"subject": "pixels", "value": 1, "tolerance": "1/0"})")),
               Contains("not a finite number"));
}

TEST_CASE("a folder holds scenes, those without expectations are passed by", "[host]")
{
    SceneFolder folder;
    folder.add("b.json", room(R"({"subject": "pixels", "value": 4})"));
    folder.add("a.json", room(R"({"subject": "pixels", "value": 4})"));
    folder.add("plain.json", R"({"environment": {"radiance": 1}})");
    folder.add("notes.txt", "no scene");
    const std::vector<Check> checks = scene_checks(scenes_at(folder.path()));
    REQUIRE(checks.size() == 2);
    CHECK(checks[0].name == "a");
    CHECK(checks[1].name == "b");
    CHECK_THROWS_AS(scenes_at(folder.path() + "/missing"), FileError);
    const TemporaryFolder empty;
    CHECK_THROWS_AS(scenes_at(empty.path().string()), UsageError);
}
