// Options of etendue render: what is understood, what is refused, and what each does to a scene.
#include "command/render_arguments.h"
#include "scene/scene_loader.h"
#include "util/error.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace etendue;
using Catch::Contains;

namespace
{
RenderArguments parse(std::vector<std::string> words)
{
    CLI::App app;
    RenderArguments arguments;
    add_render_options(app, arguments);
    std::reverse(words.begin(), words.end()); // as CLI11 wants them
    app.parse(words);
    return arguments;
}

// What the user is told of a command line that is refused.
std::string refusal(const std::vector<std::string>& words)
{
    try {
        parse(words);
    } catch (const CLI::ParseError& error) {
        return error.what();
    }
    return "";
}

Scene scene_with(const RenderArguments& arguments)
{
    Scene scene = parse_scene(R"({"environment": {"radiance": 1}, "film": {"size": [30, 20]},
        "sampler": {"spp": 5, "seed": 6}, "integrator": {"type": "bsdf"}, "accelerator": "lbvh"})",
                              "arguments.json")
                      .scene;
    apply_arguments(scene, arguments);
    return scene;
}
} // namespace

TEST_CASE("without options the scene stays as it is")
{
    const RenderArguments a = parse({"room.json"});
    CHECK(a.scene == "room.json");
    CHECK(a.device == "auto");
    CHECK(a.specialize == "on");
    CHECK(a.lanes == 0);
    CHECK(a.threads == 0);
    CHECK(a.overrides.empty());
    CHECK_FALSE(a.seconds);
    CHECK_FALSE(a.error);
    CHECK(a.confidence == 0.95);
    CHECK(a.verbosity() == Verbosity::normal);
    const Scene scene = scene_with(a);
    CHECK(scene.film.width == 30);
    CHECK(scene.film.height == 20);
    CHECK(scene.sampler.samples_per_pixel == 5);
    CHECK(scene.sampler.seed == 6);
    CHECK(scene.integrator.type == IntegratorType::bsdf);
    CHECK(scene.accelerator.type == ACCELERATOR_LBVH);
}

TEST_CASE("every option is read")
{
    const RenderArguments a = parse({"-o",
                                     "a.png",
                                     "room.json",
                                     "-o",
                                     "b.exr",
                                     "--device",
                                     "cpu,0",
                                     "--spp",
                                     "77",
                                     "--time",
                                     "1.5",
                                     "--seed",
                                     "8",
                                     "--size",
                                     "64x48",
                                     "-D",
                                     "film.x=[1,2]",
                                     "-D",
                                     "/a/b=c",
                                     "--crop",
                                     "1,2,3,4",
                                     "--integrator",
                                     "light",
                                     "--accelerator",
                                     "none",
                                     "--specialize",
                                     "off",
                                     "--report",
                                     "r.json",
                                     "--threads",
                                     "2",
                                     "--lanes",
                                     "8",
                                     "--lenient",
                                     "--no-cache",
                                     "--quiet",
                                     "--error",
                                     "0.02",
                                     "--confidence",
                                     "0.8"});
    CHECK(a.outputs == std::vector<std::string>{"a.png", "b.exr"});
    CHECK(a.overrides == std::vector<std::string>{"film.x=[1,2]", "/a/b=c"});
    CHECK(a.device == "cpu,0");
    CHECK(a.samples == 77u);
    CHECK(a.seconds == 1.5);
    CHECK(a.error == 0.02);
    CHECK(a.confidence == 0.8);
    CHECK(a.seed == 8u);
    CHECK(a.specialize == "off");
    CHECK(a.report == "r.json");
    CHECK(a.threads == 2);
    CHECK(a.lanes == 8);
    CHECK(a.lenient);
    CHECK(a.no_cache);
    CHECK(a.verbosity() == Verbosity::quiet);
    CHECK(parse({"room.json", "-v"}).verbosity() == Verbosity::verbose);

    const Scene scene = scene_with(a);
    CHECK(scene.film.width == 64);
    CHECK(scene.film.height == 48);
    CHECK(scene.sampler.samples_per_pixel == 77);
    CHECK(scene.sampler.seed == 8);
    CHECK(scene.integrator.type == IntegratorType::light);
    CHECK(scene.accelerator.type == ACCELERATOR_BRUTE_FORCE);
    const PixelRect crop = crop_of(a, scene.film);
    CHECK((crop.x == 1 && crop.y == 2 && crop.width == 3 && crop.height == 4));
}

TEST_CASE("an accelerator of auto leaves the choice open")
{
    CHECK_FALSE(scene_with(parse({"room.json", "--accelerator", "auto"})).accelerator.type);
    CHECK(scene_with(parse({"room.json", "--accelerator", "lbvh"})).accelerator.type == ACCELERATOR_LBVH);
}

TEST_CASE("numbers are decimal and within their range, and a refusal says so")
{
    CHECK(parse({"room.json", "--spp", "010"}).samples == 10u);
    CHECK(parse({"room.json", "--spp", "1000000000000000"}).samples == 1000000000000000u);
    CHECK(parse({"room.json", "--seed", "9223372036854775807"}).seed == 9223372036854775807u);
    for (const std::string number : {"0", "-3", "1e3", "4x", "1000000000000001", "99999999999999999999"})
        CHECK(refusal({"room.json", "--spp=" + number}) ==
              "--spp: must be a whole number between 1 and 1000000000000000, is \"" + number + "\".");
    for (const std::string number : {"-1", "9223372036854775808", "0x10"})
        CHECK_THAT(
            refusal({"room.json", "--seed=" + number}),
            Contains("--seed: must be a whole number between 0 and 9223372036854775807, is \"" + number + "\"."));
    CHECK_THAT(refusal({"room.json", "--threads=-1"}), Contains("--threads: must be a whole number"));
    for (const std::string seconds : {"0", "-1", "nan", "inf", "soon"})
        CHECK(refusal({"room.json", "--time=" + seconds}) ==
              "--time: must be more than 0 seconds, is \"" + seconds + "\".");
    for (const std::string error : {"0", "-1", "nan", "inf", "small"})
        CHECK(refusal({"room.json", "--error=" + error}) == "--error: must be more than 0, is \"" + error + "\".");
    for (const std::string confidence : {"0.4", "1", "nan", "sure"})
        CHECK(refusal({"room.json", "--confidence=" + confidence}) ==
              "--confidence: must be between 0.5 and 0.9999, is \"" + confidence + "\".");
    for (const std::string lanes : {"3", "32", "-1"})
        CHECK_THAT(refusal({"room.json", "--lanes=" + lanes}), Contains("--lanes"));
}

TEST_CASE("what is missing, unknown or no choice is refused")
{
    CHECK_THAT(refusal({}), Contains("SCENE is required"));
    CHECK_THAT(refusal({"room.json", "--bogus"}), Contains("--bogus"));
    CHECK_THAT(refusal({"room.json", "second.json"}), Contains("second.json"));
    CHECK_THAT(refusal({"room.json", "-o"}), Contains("--output"));
    CHECK_THAT(refusal({"room.json", "--specialize", "maybe"}), Contains("maybe not in {on,off}"));
}

TEST_CASE("sizes and crops that are none are refused with an example")
{
    const auto size_of = [](const std::string& text) { scene_with(parse({"room.json", "--size=" + text})); };
    for (const std::string text : {"64", "64x", "x64", "64x48x2", "64,48", "6 4x48", "a x b", "99999999999x1"})
        CHECK_THROWS_WITH(size_of(text), "--size must be WxH, for example 640x480, is \"" + text + "\".");
    for (const std::string text : {"0x4", "4x0", "-1x4", "65537x1"})
        CHECK_THROWS_WITH(size_of(text), "--size must be between 1x1 and 65536x65536, is \"" + text + "\".");
    CHECK_THROWS_AS(size_of("0x4"), UsageError);
    CHECK_NOTHROW(size_of("65536x1"));

    const FilmDescription film;
    for (const std::string text : {"1,2,3", "1,2,3,4,5", "1,2,3,", "1 2 3 4", "1,2,3,four", "1,2,3,99999999999"}) {
        const RenderArguments a = parse({"room.json", "--crop=" + text});
        CHECK_THROWS_WITH(crop_of(a, film), "--crop must be X,Y,W,H, for example 100,50,64,64, is \"" + text + "\".");
        CHECK_THROWS_AS(crop_of(a, film), UsageError);
    }
    const PixelRect whole = crop_of(parse({"room.json"}), film);
    CHECK((whole.x == 0 && whole.y == 0 && whole.width == film.width && whole.height == film.height));
}

TEST_CASE("an unknown integrator or accelerator is refused with the nearest name")
{
    CHECK_THROWS_WITH(scene_with(parse({"room.json", "--integrator", "pth"})),
                      Contains("--integrator: unknown integrator \"pth\"; did you mean \"path\"?") &&
                          Contains("normals, hemisphere, bsdf, light, path"));
    CHECK_THROWS_WITH(scene_with(parse({"room.json", "--accelerator", "bvh"})),
                      Contains("did you mean \"lbvh\"?") && Contains("auto, none, lbvh"));
    CHECK_THROWS_AS(scene_with(parse({"room.json", "--accelerator", "bvh"})), UsageError);
}

TEST_CASE("without -o the pictures have the scene's name, in the current folder")
{
    CHECK(outputs_of(parse({"scenes/room.v2.json"})) == std::vector<std::string>{"room.v2.png", "room.v2.exr"});
    CHECK(outputs_of(parse({"room.json", "-o", "x/y.hdr"})) == std::vector<std::string>{"x/y.hdr"});
}
