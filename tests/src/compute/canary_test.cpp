// The canary: strict builds pass, relaxed ones are found out, and the verdict is kept and mended.
#include "compute/canary.h"

#include "support/child_process.h"
#include "support/device_evaluate.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

using namespace etendue;
using Catch::Contains;
namespace fs = std::filesystem;

namespace
{
std::vector<std::string> names_of_failures(const CanaryReport& report)
{
    std::vector<std::string> names;
    for (const CanaryFinding& finding : report.findings)
        if (!finding.passed) names.push_back(finding.name);
    return names;
}

fs::path only_verdict(const fs::path& folder)
{
    std::vector<fs::path> verdicts;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".canary") verdicts.push_back(entry.path());
    REQUIRE(verdicts.size() == 1);
    return verdicts.front();
}

bool is_pocl(const Device& device)
{
    return device.info().platform_name == "Portable Computing Language";
}
} // namespace

TEST_CASE("a device that computes strictly passes the canary, with twelve findings")
{
    for (const Device& device : test_devices()) {
        const CanaryReport report = run_canary(device, "", KernelCache::none());
        CAPTURE(device.info().name, report.complaint());
        CHECK(report.passed);
        CHECK(report.complaint().empty());
        CHECK(report.findings.size() == 12);
        CHECK_FALSE(report.from_cache);
    }
}

TEST_CASE(
    "under relaxed floating point PoCL's compiler loses NaN, rounding errors and signs of zero, and the canary sees it")
{
    for (const Device& device : test_devices()) {
        if (!is_pocl(device)) continue;
        const CanaryReport report = run_canary(device, FAST_MATH_OPTION, KernelCache::none());
        CHECK_FALSE(report.passed);
        CHECK(names_of_failures(report) ==
              std::vector<std::string>{"nan_by_comparison", "signed_zeros", "sum_error", "compensated_sum"});
        CHECK_THAT(report.complaint(), Contains("numbers are mistaken by x != x"));
    }
}

TEST_CASE("the canary sees numbers below the normal ones go")
{
    for (const Device& device : test_devices()) {
        if (!is_pocl(device)) continue;
        const auto failures = names_of_failures(run_canary(device, "-cl-denorms-are-zero", KernelCache::none()));
        CHECK(std::count(failures.begin(), failures.end(), "subnormal_numbers") == 1);
    }
}

TEST_CASE("a verdict is kept beside the kernels, read the next time, and apart for other options")
{
    for (const Device& device : test_devices()) {
        const TemporaryFolder folder;
        const KernelCache cache = KernelCache::at(folder.path());
        const CanaryReport first = run_canary(device, "", cache), second = run_canary(device, "", cache);
        CHECK_FALSE(first.from_cache);
        CHECK(second.from_cache);
        CHECK(second.passed == first.passed);
        REQUIRE(second.findings.size() == first.findings.size());
        for (std::size_t i = 0; i < first.findings.size(); ++i) {
            CHECK(second.findings[i].name == first.findings[i].name);
            CHECK(second.findings[i].passed == first.findings[i].passed);
            CHECK(second.findings[i].detail == first.findings[i].detail);
        }
        only_verdict(folder.path());
        CHECK_FALSE(run_canary(device, "-DANOTHER=1", cache).from_cache);
    }
}

TEST_CASE("a verdict on disk that is damaged is asked for anew and mended, without a word")
{
    for (const Device& device : test_devices()) {
        const TemporaryFolder folder;
        const KernelCache cache = KernelCache::at(folder.path());
        run_canary(device, "", cache);
        const std::string file = only_verdict(folder.path()).string(), good = read_file(file);
        std::string turned = good;
        std::replace(turned.begin(), turned.end(), '+', '-');
        for (const std::string& bad : {std::string(), good.substr(0, good.size() / 2), turned}) {
            write_file(file, bad);
            const CanaryReport report = run_canary(device, "", cache);
            CHECK_FALSE(report.from_cache);
            CHECK(report.passed);
            CHECK(read_file(file) == good);
            CHECK(run_canary(device, "", cache).from_cache);
        }
    }
}
