// The kernels of a whole render under Oclgrind: no access outside a buffer and no race.
#include "support/child_process.h"
#include "support/device_oclgrind.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>

using namespace etendue;

namespace
{
// Render a few pixels of the course box with everything built by kernels: sort, tree, paths, film.
ChildResult render_under_oclgrind(const std::filesystem::path& folder,
                                  const std::map<std::string, std::string>& environment)
{
    const std::string scene = std::string(ETENDUE_SOURCE_DIR) + "/scenes/course-box/simple_native.json";
    // Oclgrind ignores -cl-single-precision-constant, so literals are double there; it does not know llvm.bitreverse,
    // which the compiler makes of Sobol points.
    return run_child("/usr/bin/oclgrind",
                     {"--data-races",
                      "--disable-pch",
                      "--build-options",
                      "-cl-ext=-cl_khr_fp64",
                      std::string(ETENDUE_BINARY_DIR) + "/etendue",
                      "render",
                      scene,
                      "--no-cache",
                      "--size",
                      "6x5",
                      "--spp",
                      "2",
                      "-D",
                      "accelerator={\"type\":\"lbvh\",\"build\":\"device\"}",
                      "-D",
                      "integrator.max_depth=3",
                      "-D",
                      "sampler.type=independent",
                      "-o",
                      (folder / "picture.exr").string()},
                     environment);
}

std::string listed(const std::vector<OclgrindReport>& reports)
{
    std::string text;
    for (const OclgrindReport& r : reports) text += r.kernel + ": " + r.error + "\n";
    return text;
}

void copy_kernels_with(const std::filesystem::path& folder, const std::string& file, const std::string& from,
                       const std::string& to)
{
    std::filesystem::copy(std::string(ETENDUE_SOURCE_DIR) + "/cl", folder, std::filesystem::copy_options::recursive);
    std::ifstream in(folder / file);
    std::string text(std::istreambuf_iterator<char>(in), {});
    const auto place = text.find(from);
    REQUIRE(place != std::string::npos);
    text.replace(place, from.size(), to);
    std::ofstream(folder / file) << text;
}
} // namespace

TEST_CASE("a render with every kernel has no report of Oclgrind's but the climb's races", "[render][oclgrind]")
{
    const TemporaryFolder folder;
    const ChildResult result = render_under_oclgrind(folder.path(), {});
    INFO(result.errors.substr(0, 2000));
    REQUIRE(result.exit_code == 0);
    REQUIRE(std::filesystem::exists(folder.path() / "picture.exr"));
    const auto reports = oclgrind_reports(result.errors + result.output);
    const auto unexpected = without_expected(reports);
    INFO(listed(unexpected));
    CHECK(unexpected.empty());
    // The climb ran on the device, and Oclgrind watched it.
    CHECK(reports.size() > unexpected.size());
}

TEST_CASE("Oclgrind sees a write behind a buffer in the same render", "[render][oclgrind]")
{
    const TemporaryFolder folder;
    copy_kernels_with(folder.path() / "cl", "film.cl", "blocks[pixel] = block;", "blocks[pixel + 1000000u] = block;");
    const ChildResult result =
        render_under_oclgrind(folder.path(), {{"ETENDUE_CL_DIR", (folder.path() / "cl").string()}});
    const auto unexpected = without_expected(oclgrind_reports(result.errors + result.output));
    INFO(result.errors.substr(0, 2000));
    REQUIRE(!unexpected.empty());
    CHECK(unexpected.front().kernel == "film_accumulate");
}
