// Whole studies of a small scene on a device.
#include "converge/study.h"

#include "converge/analysis.h"
#include "converge/study_files.h"
#include "support/child_process.h"
#include "support/device_evaluate.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <sstream>

using namespace etendue;
using Catch::Contains;

namespace
{
StudyOptions small_study(const std::string& reference)
{
    StudyOptions options;
    options.preparation.scene = ETENDUE_SOURCE_DIR "/scenes/course-box/simple_native.json";
    options.preparation.overrides = {"sampler.type=independent"};
    options.preparation.size = FilmSize{16, 16};
    options.preparation.device = std::to_string(test_devices().front().info().index);
    options.configurations = {parse_configuration("default")};
    options.checkpoints = parse_checkpoints("spp:1:64:x2");
    options.seeds = 4;
    options.reference = reference;
    options.reference_seconds = 20.0;
    options.draws = 200;
    return options;
}

// A reference kept by another test or run would do as well, so that none is.
struct Quiet {
    std::ostringstream stream;
    Log log{{stream}, Verbosity::quiet};
};
} // namespace

TEST_CASE("a study of a small box finds the law of independent samples and no bias", "[converge]")
{
    Quiet quiet;
    StudyOptions options = small_study("auto");
    options.configurations = {parse_configuration("path"), parse_configuration("general:render.specialize=off")};
    const Study study = run_study(options, quiet.log);
    CHECK_FALSE(study.interrupted);
    REQUIRE(study.configurations.size() == 2);
    const StudiedConfiguration& studied = study.configurations[0];
    CHECK(studied.reference->kind == Reference::Kind::independent);
    CHECK(studied.reference == study.configurations[1].reference);
    CHECK(studied.cold.compile > 0.0);
    CHECK(studied.cold.first_launch > 0.0);
    REQUIRE(studied.runs.size() == 4);
    for (const Run& run : studied.runs) {
        CHECK(run.measurement.complete);
        REQUIRE(run.rows.size() == 7);
        for (std::size_t k = 1; k < 7; ++k) {
            CHECK(run.rows[k].samples == 2 * run.rows[k - 1].samples);
            CHECK(run.rows[k].render_seconds > run.rows[k - 1].render_seconds);
            CHECK(run.rows[k].kernel_seconds > run.rows[k - 1].kernel_seconds);
            CHECK(run.rows[k].rays > run.rows[k - 1].rays);
        }
        CHECK(run.rows.back().kernel_seconds <= run.rows.back().render_seconds);
        CHECK(run.measurement.look_seconds > 0.0);
    }
    // The same seeds give the same pictures, whatever the kernel.
    CHECK(studied.runs[1].rows[6].mse == study.configurations[1].runs[1].rows[6].mse);
    const Analysis analysis = analyse(study);
    CHECK_FALSE(analysis.bad());
    CHECK(analysis.bench_passed);
    for (const ConfigurationAnalysis& configuration : analysis.configurations) {
        CHECK(configuration.slope_samples.contains(-1.0));
        CHECK(configuration.verdict.mean_passed);
        CHECK(configuration.verdict.tiles_passed);
    }
}

TEST_CASE("an estimator that loses light is found biased", "[converge]")
{
    // Against a reference of more bounces.
    Quiet quiet;
    const TemporaryFolder folder;
    StudyOptions options = small_study("auto");
    const Study good = run_study(options, quiet.log);
    const Analysis good_analysis = analyse(good);
    write_study(good, good_analysis, folder.path().string());
    options.reference = (folder.path() / "default_reference.exr").string();
    options.configurations = {parse_configuration("short:integrator.max_depth=2")};
    const Analysis analysis = analyse(run_study(options, quiet.log));
    CHECK(analysis.configurations[0].verdict.result == BiasResult::biased);
    CHECK(analysis.configurations[0].verdict.mean_error < 0.0);
    CHECK(analysis.bad());
}

TEST_CASE("a few samples of skewed noise are no bias", "[converge]")
{
    // In the corners of a furnace light sampling has no finite variance: most of 128 samples see too little.
    Quiet quiet;
    StudyOptions options = small_study("auto");
    options.preparation.scene = ETENDUE_SOURCE_DIR "/scenes/furnace/furnace.json";
    options.preparation.overrides = {"sampler.type=independent", "integrator.max_depth=3"};
    options.preparation.size = FilmSize{8, 8};
    options.checkpoints = parse_checkpoints("spp:1:8:x2");
    options.configurations = {parse_configuration("bsdf:integrator.type=bsdf"),
                              parse_configuration("path:integrator.type=path")};
    const Study study = run_study(options, quiet.log);
    CHECK(study.configurations[0].reference->skewness > 0.2);
    for (const ConfigurationAnalysis& configuration : analyse(study).configurations)
        CHECK(configuration.verdict.result == BiasResult::underpowered);
}

TEST_CASE("a study writes files that hold together", "[converge]")
{
    Quiet quiet;
    const TemporaryFolder folder;
    const Study study = run_study(small_study("none"), quiet.log);
    const std::string path = (folder.path() / "made").string();
    make_study_folder(path);
    write_study(study, analyse(study), path);
    for (const char* const name : {"errors.csv", "converge.json", "converge.svg", "converge.png", "converge_total.svg",
                                   "converge_total.png", "default.exr", "report.html"})
        CHECK(std::filesystem::file_size(folder.path() / "made" / name) > 100);
    const std::string html = read_file(path + "/report.html");
    CHECK_THAT(html, Contains("default: UNKNOWN"));
    CHECK_THAT(html, Contains("data:image/png;base64,"));
    CHECK_THAT(html, Contains("<svg"));
    CHECK_THAT(html, !Contains("<script"));
    CHECK_THAT(html, !Contains("http://") || Contains("http://www.w3.org"));
    // A file where the folder should be.
    write_file((folder.path() / "file").string(), "");
    CHECK_THROWS_AS(make_study_folder((folder.path() / "file").string()), FileError);
}

TEST_CASE("a study that is interrupted reports what it has", "[converge]")
{
    Quiet quiet;
    StudyOptions options = small_study("none");
    // Stops somewhere in the third run.
    std::size_t runs = 0;
    bool stopped = false;
    options.stop = [&] { return stopped; };
    options.checkpoints = parse_checkpoints("spp:1:4096:x2");
    options.seeds = 1000;
    const Stopwatch watch;
    options.stop = [&] { return stopped = stopped || (runs = runs + 1) > 400; };
    const Study study = run_study(options, quiet.log);
    CHECK(study.interrupted);
    const TemporaryFolder folder;
    const bool has_runs = !study.configurations.empty() && !study.configurations[0].runs.empty();
    REQUIRE(has_runs);
    CHECK(study.configurations[0].runs.size() < 1000);
    write_study(study, analyse(study), folder.path().string());
    CHECK_THAT(read_file((folder.path() / "report.html").string()), Contains("Interrupted"));
}

TEST_CASE("a study that is interrupted before its first checkpoint says so in a report", "[converge]")
{
    Quiet quiet;
    for (const char* const reference : {"none", "auto"}) {
        StudyOptions options = small_study(reference);
        options.stop = [] { return true; };
        const Study study = run_study(options, quiet.log);
        CHECK(study.interrupted);
        const TemporaryFolder folder;
        write_study(study, analyse(study), folder.path().string());
        const std::string html = read_file((folder.path() / "report.html").string());
        CHECK_THAT(html, Contains("Interrupted"));
        CHECK_THAT(html, Contains("No run reached a checkpoint."));
        CHECK(read_file((folder.path() / "converge.json").string()).find("UNKNOWN") != std::string::npos);
    }
}

TEST_CASE("checkpoints in time are reached in time", "[converge]")
{
    Quiet quiet;
    StudyOptions options = small_study("none");
    options.checkpoints = parse_checkpoints("time:0.01:0.1:x2");
    options.seeds = 2;
    const Study study = run_study(options, quiet.log);
    for (const Run& run : study.configurations.at(0).runs) {
        CHECK(run.measurement.complete);
        REQUIRE_FALSE(run.rows.empty());
        CHECK(run.rows.back().render_seconds >= 0.08);
        CHECK(run.rows.front().render_seconds >= 0.01);
    }
}

TEST_CASE("what cannot be studied is refused", "[converge]")
{
    Quiet quiet;
    StudyOptions options = small_study("analytic");
    CHECK_THROWS_WITH(run_study(options, quiet.log), Contains("there is no analytic reference"));
    options.configurations = {parse_configuration("normals:integrator.type=normals")};
    CHECK_THROWS_WITH(run_study(options, quiet.log), Contains("has no noise"));
}

TEST_CASE("what a scene expects is no reference for another picture", "[converge]")
{
    Quiet quiet;
    StudyOptions options = small_study("analytic");
    options.preparation.scene = ETENDUE_SOURCE_DIR "/scenes/furnace/furnace.json";
    options.preparation.size = FilmSize{8, 8};
    options.checkpoints = parse_checkpoints("spp:1:4:x2");
    const Study study = run_study(options, quiet.log);
    CHECK(study.configurations[0].reference->kind == Reference::Kind::analytic);
    CHECK(analyse(study).configurations[0].verdict.result == BiasResult::unbiased);
    options.configurations = {parse_configuration("shallow:integrator.max_depth=3")};
    CHECK_THROWS_WITH(run_study(options, quiet.log), Contains("is not for a picture changed by -D or --config"));
}
