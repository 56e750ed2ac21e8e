// etendue render as a user calls it: files, messages, exit codes and Ctrl-C.
#include "image/image_io.h"
#include "support/child_process.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <set>
#include <sstream>
#include <thread>
#include <tuple>

#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <json/json.h>

extern char** environ;

using namespace etendue;
using Catch::Contains;
using Catch::StartsWith;

namespace
{
const std::string ETENDUE = ETENDUE_BINARY_DIR "/etendue";
const std::string SCENE = ETENDUE_SOURCE_DIR "/scenes/course-box/simple_native.json";

using Words = std::vector<std::string>;

// etendue render SCENE of 8 by 6 pixels and 2 samples, unless `words` say otherwise.
Words small_render(const Words& words, const std::string& scene = SCENE)
{
    Words all{"render", scene};
    const auto has = [&](const std::string& option) { return std::count(words.begin(), words.end(), option) > 0; };
    if (!has("--size")) all.insert(all.end(), {"--size", "8x6"});
    if (!has("--spp") && !has("--time") && !has("--error")) all.insert(all.end(), {"--spp", "2"});
    all.insert(all.end(), words.begin(), words.end());
    return all;
}

std::set<std::string> files_in(const std::filesystem::path& folder)
{
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename());
    return names;
}

Json::Value report_in(const std::string& path)
{
    Json::Value report;
    std::istringstream(read_file(path)) >> report;
    return report;
}

// A folder and names of files in it.
struct Folder : TemporaryFolder {
    std::string operator/(const std::string& name) const { return (path() / name).string(); }
    std::set<std::string> files() const { return files_in(path()); }
};

bool same_bits(const Image& a, const Image& b)
{
    return a.channels == b.channels && a.data.size() == b.data.size() &&
           std::memcmp(a.data.data(), b.data.data(), a.data.size() * sizeof(float)) == 0;
}

// What must become of a command line that cannot be carried out: a code, a message, and no file.
void check_refused(const Words& words, int exit_code, const std::string& message, const Folder& folder,
                   const std::map<std::string, std::string>& environment = {})
{
    const std::set<std::string> before = folder.files();
    const ChildResult result = run_child(ETENDUE, words, environment);
    INFO(result.errors);
    CHECK(result.exit_code == exit_code);
    CHECK(result.output.empty());
    CHECK_THAT(result.errors, Contains(message));
    CHECK(folder.files() == before);
}

// A render that can be interrupted.
class RunningChild
{
public:
    RunningChild(const Words& words, const std::string& errors)
    {
        Words all{ETENDUE};
        all.insert(all.end(), words.begin(), words.end());
        std::vector<char*> pointers;
        for (std::string& word : all) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, 2, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        REQUIRE(posix_spawn(&id_, ETENDUE.c_str(), &actions, nullptr, pointers.data(), environ) == 0);
        posix_spawn_file_actions_destroy(&actions);
    }
    ~RunningChild()
    {
        if (running_) {
            kill(id_, SIGKILL);
            waitpid(id_, nullptr, 0);
        }
    }
    RunningChild(const RunningChild&) = delete;
    RunningChild& operator=(const RunningChild&) = delete;

    void interrupt() { kill(id_, SIGINT); }

    // The exit code, or nothing after half a minute.
    std::optional<int> exit_code()
    {
        for (int tries = 0; tries < 600; ++tries) {
            int status = 0;
            if (waitpid(id_, &status, WNOHANG) == id_) {
                running_ = false;
                return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
            }
            pause(50);
        }
        return {};
    }

    static void pause(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

private:
    pid_t id_ = 0;
    bool running_ = true;
};

// Wait until a file has the text, at most half a minute.
bool wait_for(const std::string& path, const std::string& text)
{
    for (int tries = 0; tries < 600; ++tries) {
        if (std::filesystem::exists(path) && read_file(path).find(text) != std::string::npos) return true;
        RunningChild::pause(50);
    }
    return false;
}
} // namespace

TEST_CASE("render writes every picture it is asked for, and a report", "[render][command]")
{
    const Folder folder;
    const ChildResult result =
        run_child(ETENDUE, small_render({"-o", folder / "a.png", "-o", folder / "b.exr", "-o", folder / "c.hdr", "-o",
                                         folder / "d.jpg", "--seed", "5", "--report", folder / "r.json"}));
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK(result.output.empty());
    CHECK(folder.files() == std::set<std::string>{"a.png", "b.exr", "c.hdr", "d.jpg", "r.json"});
    for (const char* name : {"a.png", "b.exr", "c.hdr", "d.jpg"}) {
        const Image image = read_image(folder / name);
        CHECK(image.width == 8);
        CHECK(image.height == 6);
        CHECK(*std::max_element(image.data.begin(), image.data.end()) > 0.0f);
        CHECK_THAT(result.errors, Contains("wrote " + (folder / name)));
    }
    const Image exr = read_image(folder / "b.exr");
    const std::set<std::string> channels(exr.channels.begin(), exr.channels.end());
    CHECK(channels == std::set<std::string>{"R", "G", "B", "stderr.R", "stderr.G", "stderr.B", "albedo.R", "albedo.G",
                                            "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z", "samples.Y"});
    for (auto metadata : {exr.metadata, read_image(folder / "a.png").metadata}) {
        CHECK(metadata["etendue:seed"] == "5");
        CHECK(metadata["etendue:spp"] == "2");
        CHECK(metadata["etendue:scene"] == SCENE);
        CHECK(metadata["etendue:scene_sha256"].size() == 64);
        CHECK(metadata["etendue:interrupted"] == "no");
        CHECK_FALSE(metadata["etendue:device"].empty());
        CHECK_THAT(metadata["etendue:seconds"], Contains("parse ") && Contains("render "));
    }
    const Json::Value report = report_in(folder / "r.json");
    CHECK(report["samples_per_pixel"] == 2);
    CHECK(report["rays"]["camera"] == 2 * 8 * 6);
    CHECK_THAT(report["command"].asString(), StartsWith("etendue render " + SCENE) && Contains(" --seed 5"));
    for (const char* phase : {"parse", "mesh_load", "upload", "bvh", "compile", "first_launch", "render", "write"})
        CHECK(report["seconds"][phase].isDouble());
}

TEST_CASE("without -o the pictures get the scene's name in the current folder", "[render][command]")
{
    const Folder folder;
    Words words = small_render({"--quiet"});
    words.insert(words.begin(), {"-C", folder.path().string(), ETENDUE});
    CHECK(run_child("/usr/bin/env", words).exit_code == 0);
    CHECK(folder.files() == std::set<std::string>{"simple_native.exr", "simple_native.png"});
}

TEST_CASE("a crop is the same rectangle of the whole picture", "[render][command]")
{
    const Folder folder;
    REQUIRE(run_child(ETENDUE, small_render({"-o", folder / "whole.exr"})).exit_code == 0);
    REQUIRE(
        run_child(ETENDUE, small_render({"--crop", "3,1,4,2", "-o", folder / "part.exr", "-o", folder / "part.png"}))
            .exit_code == 0);
    const Image whole = read_image(folder / "whole.exr"), part = read_image(folder / "part.exr");
    CHECK((part.width == 4 && part.height == 2 && part.x == 3 && part.y == 1));
    CHECK((part.full_width == 8 && part.full_height == 6));
    bool same = true;
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x)
            for (std::size_t c = 0; c < part.channels.size(); ++c)
                same &= part.at(x, y, c) == whole.at(3 + x, 1 + y, c);
    CHECK(same);
    const Image png = read_image(folder / "part.png");
    CHECK((png.width == 4 && png.height == 2));
}

TEST_CASE("the general kernel, other lanes and -D are chosen on the command line", "[render][command]")
{
    const Folder folder;
    const auto render_to = [&](const std::string& name, Words words) {
        words.insert(words.end(), {"-o", folder / name, "--report", folder / (name + ".json")});
        REQUIRE(run_child(ETENDUE, small_render(words)).exit_code == 0);
        return report_in(folder / (name + ".json"));
    };
    render_to("default.exr", {});
    const Json::Value general = render_to("general.exr", {"--specialize", "off"});
    const Json::Value defined =
        render_to("defined.exr", {"-D", "accelerator=none", "-D", "film.size=[3,3]", "--lanes", "4"});
    CHECK(general["devices"][0]["features"]["out"].empty());
    CHECK(defined["devices"][0]["lanes"] == 4);
    CHECK(same_bits(read_image(folder / "default.exr"), read_image(folder / "general.exr")));
    // --size is stronger than the scene, whoever wrote its value.
    CHECK(defined["accelerator"].asString() == "none");
    CHECK(same_bits(read_image(folder / "default.exr"), read_image(folder / "defined.exr")));
}

TEST_CASE("an extension in capitals is the same format, with every channel", "[render][command]")
{
    const Folder folder;
    CHECK(run_child(ETENDUE, small_render({"-o", folder / "X.EXR"})).exit_code == 0);
    CHECK(read_image(folder / "X.EXR").channels.size() == 14);
}

TEST_CASE("what cannot be written is refused before the work, with nothing left behind", "[render][command]")
{
    const Folder folder;
    std::filesystem::create_directory(folder / "folder.png");
    check_refused(small_render({"-o", folder / "x.foo"}), 1, "has the extension \".foo\"; there are: .exr", folder);
    check_refused(small_render({"-o", folder / "x"}), 1, "no picture format has the extension \"\"", folder);
    check_refused(small_render({"-o", folder / "y.png", "-o", folder / "none/x.png"}), 4,
                  "none/x.png: the folder " + (folder / "none") + " does not exist.", folder);
    check_refused(small_render({"-o", folder / "folder.png"}), 4, "this is a directory", folder);
    check_refused(small_render({"-o", folder / "x.png", "--report", folder / "none/r.json"}), 4,
                  "none/r.json: the folder " + (folder / "none") + " does not exist.", folder);
}

TEST_CASE("mistakes on the command line exit with 1", "[render][command]")
{
    const Folder folder;
    const auto check_usage = [&](Words words, const std::string& message) {
        words.insert(words.end(), {"-o", folder / "x.png"});
        check_refused(small_render(words), 1, message, folder);
    };
    check_usage({"--bogus"}, "--bogus");
    check_usage({"--spp", "0"}, "--spp: must be a whole number between 1 and");
    check_usage({"--time", "-1"}, "--time: must be more than 0 seconds");
    check_usage({"--error", "0"}, "--error: must be more than 0");
    check_usage({"--error", "0.1"}, "48 pixels do not tell how well their error is known");
    check_usage({"--error", "0.1", "-D", R"(sampler={"type":"sobol","replicates":1})"}, "-D sampler.replicates=2");
    check_usage({"--error", "0.1", "--integrator", "normals"}, "--error needs another integrator");
    check_usage({"--lanes", "3"}, "--lanes");
    check_usage({"--size", "8"}, "--size must be WxH");
    check_usage({"--crop", "0,0,0,5"}, "does not lie within the film of 8x6 pixels, or is empty");
    check_usage({"--crop", "5,0,4,1"}, "does not lie within the film of 8x6 pixels");
    check_usage({"--integrator", "pth"}, "unknown integrator \"pth\"; did you mean \"path\"?");
    check_usage({"-D", "nonsense"}, "-D nonsense: an override is written path=value");
    check_refused({}, 1, "A subcommand is required", folder);
    check_refused({"render"}, 1, "SCENE is required", folder);
    check_refused({"rendr", SCENE}, 1, "A subcommand is required", folder);
}

TEST_CASE("mistakes in a scene exit with 2 and their place", "[render][command]")
{
    const Folder folder;
    const std::string scene = folder / "bad.json";
    write_file(scene, "{\n  \"film\": {\"sise\": [4, 4]},\n  \"environment\": {\"radiance\": 1}\n}\n");
    check_refused(small_render({"-o", folder / "x.png"}, scene), 2,
                  scene + ":2:12: /film/sise: unknown film key \"sise\"; did you mean \"size\"?", folder);
    check_refused(small_render({"-o", folder / "x.png", "-D", "film.sise=3"}), 2, "command line: /film/sise", folder);
    check_refused(small_render({"-o", folder / "x.png"}, folder / "none.json"), 4, "none.json: there is no such file.",
                  folder);
    check_refused(small_render({"-o", folder / "x.png"}, folder.path().string()), 4, "this is a directory", folder);
}

TEST_CASE("a device that does not exist exits with 3 and what there is", "[render][command]")
{
    const Folder folder, drivers;
    check_refused(small_render({"-o", folder / "x.png", "--device", "no such device"}), 3,
                  "No OpenCL device is called \"no such device\". There are", folder);
    check_refused(small_render({"-o", folder / "x.png"}), 3, "sudo apt install pocl-opencl-icd", folder,
                  {{"OCL_ICD_VENDORS", drivers.path().string()}});
    check_refused(small_render({"-o", folder / "x.png", "--threads", "100000"}), 3, "100000 threads were asked for",
                  folder);
}

TEST_CASE("quiet says nothing, and without a terminal there are plain lines", "[render][command]")
{
    const Folder folder;
    const ChildResult quiet = run_child(ETENDUE, small_render({"-o", folder / "x.exr", "--quiet"}));
    CHECK(quiet.exit_code == 0);
    CHECK(quiet.errors.empty());
    CHECK(quiet.output.empty());
    const ChildResult normal = run_child(ETENDUE, small_render({"-o", folder / "x.exr"}));
    CHECK(normal.errors.find('\r') == std::string::npos);
    CHECK(normal.errors.find('\x1b') == std::string::npos);
    CHECK_THAT(normal.errors, Contains("8x6 pixels\n") && Contains("] 100%  2/2 spp") && Contains("Mrays/s"));
    CHECK_THAT(normal.errors, !Contains("lanes"));
    const ChildResult verbose = run_child(ETENDUE, small_render({"-o", folder / "x.exr", "-v"}));
    CHECK_THAT(verbose.errors, Contains("96 samples in") && Contains(" lanes"));
}

TEST_CASE("a time limit ends a render without an error", "[render][command]")
{
    const Folder folder;
    const ChildResult result = run_child(ETENDUE, small_render({"--time", "0.5", "-o", folder / "x.exr"}));
    CHECK(result.exit_code == 0);
    Image image = read_image(folder / "x.exr");
    CHECK(std::stoull(image.metadata["etendue:spp"]) >= 1);
    CHECK(image.metadata["etendue:interrupted"] == "no");
    const std::size_t samples = image.channel("samples.Y");
    for (int x = 0; x < 8; ++x) CHECK(image.at(x, 3, samples) == image.at(0, 0, samples));
    // The normals have no noise that more time would take away.
    const ChildResult normals =
        run_child(ETENDUE, small_render({"--integrator", "normals", "--time", "1000", "-o", folder / "n.exr"}));
    CHECK(normals.exit_code == 0);
    CHECK(read_image(folder / "n.exr").metadata["etendue:spp"] == "1");
    CHECK_THAT(normals.errors, Contains("relative error unknown"));
}

TEST_CASE("a wanted error ends a render, and the report says how it was judged", "[render][command]")
{
    const Folder folder;
    for (const auto& [sampler, estimate, least] :
         {std::tuple("independent", "samples", 128), std::tuple("stratified", "blocks", 320),
          std::tuple("sobol", "halves", 384)}) {
        INFO(sampler);
        const ChildResult result =
            run_child(ETENDUE, small_render({"--error", "0.2", "--confidence", "0.9", "--size", "12x10", "-D",
                                             std::string("sampler.type=") + sampler, "-o", folder / "x.exr", "--report",
                                             folder / "r.json"}));
        CHECK(result.exit_code == 0);
        CHECK_THAT(result.errors, Contains("error 0.2 reached after") && Contains(std::string("by ") + estimate));
        const Json::Value report = report_in(folder / "r.json");
        const Json::Value& target = report["error_target"];
        CHECK(report["error_estimate"].asString() == estimate);
        CHECK(target["reached"] == Json::Value(true));
        CHECK(target["confidence"].asDouble() == 0.9);
        CHECK(target["high"].asDouble() <= 0.2);
        CHECK(target["relative_error"].asDouble() == Approx(report["relative_error"].asDouble()));
        CHECK(target["looks"].asUInt64() >= 2);
        CHECK(report["samples_per_pixel"].asUInt64() >= static_cast<std::uint64_t>(least));
    }
    // --spp and --time end it too.
    const ChildResult limited =
        run_child(ETENDUE, small_render({"--error", "0.0001", "--spp", "70", "--size", "12x10", "-o", folder / "x.exr",
                                         "--report", folder / "r.json"}));
    CHECK(limited.exit_code == 0);
    CHECK_THAT(limited.errors, Contains("error 0.0001 not reached after 70 samples per pixel"));
    CHECK(report_in(folder / "r.json")["error_target"]["reached"] == Json::Value(false));
    const ChildResult timed = run_child(
        ETENDUE, small_render({"--error", "0.0001", "--time", "0.5", "--size", "12x10", "-o", folder / "x.exr"}));
    CHECK(timed.exit_code == 0);
    CHECK_THAT(timed.errors, Contains("error 0.0001 not reached"));
}

TEST_CASE("an interrupt writes the samples there are, says so, and exits with 130", "[render][command]")
{
    const Folder folder;
    const std::string errors = folder / "errors";
    RunningChild child(small_render({"--spp", "1000000000", "-o", folder / "x.exr", "-o", folder / "y.png", "--report",
                                     folder / "r.json"}),
                       errors);
    REQUIRE(wait_for(errors, " spp"));
    child.interrupt();
    CHECK(child.exit_code() == 130);
    CHECK(folder.files() == std::set<std::string>{"errors", "x.exr", "y.png", "r.json"});
    CHECK_THAT(read_file(errors), Contains("warning: interrupted: the pictures hold the samples there were."));
    CHECK_THAT(read_file(errors), !Contains("100%"));
    Image image = read_image(folder / "x.exr");
    CHECK(image.metadata["etendue:interrupted"] == "yes");
    CHECK(read_image(folder / "y.png").metadata["etendue:interrupted"] == "yes");
    CHECK(image.at(4, 3, image.channel("samples.Y")) >= 1.0f);
    CHECK(report_in(folder / "r.json")["interrupted"].asBool());
}

TEST_CASE("a second interrupt ends a render at once", "[render][command]")
{
    // Paths of 65000 vertices in a closed white box: the first launch lasts minutes.
    const Folder folder;
    const std::string scene = folder / "scene.json", errors = folder / "errors";
    write_file(scene, R"({"film": {"size": [128, 128]}, "camera": {"position": [0, 1, 0], "look_at": [0, 1, -1]},
        "integrator": {"type": "bsdf", "max_depth": 65000, "roulette": "off"},
        "materials": [{"name": "white", "type": "diffuse", "albedo": 1}],
        "shapes": [{"type": "box", "size": [4, 4, 4], "material": "white", "transform": {"translate": [0, 1, 0]}}],
        "lights": [{"type": "rectangle", "size": [0.01, 0.01], "radiance": 1}]})");
    RunningChild child(small_render({"--size", "128x128", "-o", folder / "x.exr"}, scene), errors);
    REQUIRE(wait_for(errors, "128x128 pixels"));
    RunningChild::pause(2500);
    child.interrupt();
    RunningChild::pause(1000); // two that come at once are one
    child.interrupt();
    CHECK(child.exit_code() == 130);
    CHECK(folder.files() == std::set<std::string>{"errors", "scene.json"});
}

TEST_CASE("an interrupt before the first sample leaves the pictures that are there", "[render][command]")
{
    // The child waits for its scene, which comes through a pipe after the interrupt.
    const Folder folder;
    const std::string scene = folder / "scene.json", errors = folder / "errors";
    REQUIRE(mkfifo(scene.c_str(), 0600) == 0);
    write_file(folder / "x.exr", "an older picture");
    RunningChild child(small_render({"-o", folder / "x.exr"}, scene), errors);
    int pipe = -1;
    for (int tries = 0; pipe < 0 && tries < 600; ++tries) {
        pipe = open(scene.c_str(), O_WRONLY | O_NONBLOCK);
        if (pipe < 0) RunningChild::pause(50);
    }
    REQUIRE(pipe >= 0);
    child.interrupt();
    RunningChild::pause(100);
    const std::string text = R"({"environment": {"radiance": 1}})";
    CHECK(write(pipe, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    close(pipe);
    CHECK(child.exit_code() == 130);
    CHECK_THAT(read_file(errors), Contains("interrupted before the first sample: nothing is written."));
    CHECK(read_file(folder / "x.exr") == "an older picture");
}

TEST_CASE("the version and the help are printed on request", "[render][command]")
{
    const ChildResult version = run_child(ETENDUE, {"--version"});
    CHECK(version.exit_code == 0);
    CHECK(version.output == "etendue " ETENDUE_VERSION "\n");
    const ChildResult help = run_child(ETENDUE, {"--help"});
    CHECK(help.exit_code == 0);
    CHECK_THAT(help.output, Contains("render") && Contains("devices") && Contains("Exit codes: 0 success"));
    const ChildResult render_help = run_child(ETENDUE, {"render", "--help"});
    CHECK(render_help.exit_code == 0);
    CHECK_THAT(render_help.output, Contains("Examples:\n  etendue render scenes/course-box/simple.json"));
    for (const char* option : {"--output", "--device", "--spp", "--time", "--error", "--confidence", "--seed", "--size",
                               "--crop", "-D,--define", "--integrator", "--accelerator", "--specialize", "--report",
                               "--threads", "--lanes", "--quiet", "-v,--verbose"})
        CHECK_THAT(render_help.output, Contains(option));
}
