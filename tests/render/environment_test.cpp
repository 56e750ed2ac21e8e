// Rendering where the OpenCL installation is empty, broken or has several devices: each render in a process of its
// own, because the OpenCL loader looks once.
#include "compute/device.h"
#include "image/image_io.h"
#include "support/child_process.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>
#include <sstream>

#include <json/json.h>

using namespace etendue;
using Catch::Contains;

namespace
{
const char* const POCL = "/etc/OpenCL/vendors/pocl.icd";

bool has_pocl()
{
    const auto devices = list_devices().devices;
    return std::any_of(devices.begin(), devices.end(),
                       [](const DeviceInfo& d) { return d.platform_name == "Portable Computing Language"; });
}

ChildResult render_with(const std::map<std::string, std::string>& environment, std::vector<std::string> words)
{
    words.insert(words.begin(), {"render", ETENDUE_SOURCE_DIR "/scenes/course-box/simple_native.json"});
    return run_child(ETENDUE_BINARY_DIR "/etendue", words, environment);
}

bool same_bits(const Image& a, const Image& b)
{
    return a.channels == b.channels && a.data.size() == b.data.size() &&
           std::memcmp(a.data.data(), b.data.data(), a.data.size() * sizeof(float)) == 0;
}
} // namespace

TEST_CASE("without a driver nothing renders, and the message names the package", "[render][environment]")
{
    const TemporaryFolder drivers, folder;
    const ChildResult result =
        render_with({{"OCL_ICD_VENDORS", drivers.path().string()}}, {"-o", (folder.path() / "x.png").string()});
    CHECK(result.exit_code == 3);
    CHECK_THAT(result.errors, Contains("There is no OpenCL device.") && Contains("pocl-opencl-icd"));
    CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("a platform without devices is no device, and says which platform", "[render][environment]")
{
    REQUIRE(has_pocl());
    const TemporaryFolder folder;
    const ChildResult result =
        render_with({{"POCL_DEVICES", ""}, {"OCL_ICD_VENDORS", POCL}}, {"-o", (folder.path() / "x.png").string()});
    CHECK(result.exit_code == 3);
    CHECK_THAT(result.errors, Contains("(Portable Computing Language) has no device.") && Contains("pocl-opencl-icd"));
    CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("a dead driver beside a live one is one warning, and the picture is rendered", "[render][environment]")
{
    REQUIRE(has_pocl());
    const TemporaryFolder drivers, folder;
    std::filesystem::copy_file(POCL, drivers.path() / "pocl.icd");
    write_file((drivers.path() / "dead.icd").string(), "/nowhere/libdead.so\n");
    const std::string picture = (folder.path() / "x.exr").string();
    const ChildResult result = render_with({{"OCL_ICD_VENDORS", drivers.path().string()}},
                                           {"-o", picture, "--size", "4x4", "--spp", "1", "--quiet"});
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.errors, Contains("warning: The driver that") && Contains("dead.icd"));
    CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
    CHECK(std::filesystem::exists(picture));
}

TEST_CASE("two devices at once render the bits of one, and each is reported", "[render][environment]")
{
    REQUIRE(has_pocl());
    const TemporaryFolder folder;
    const std::string one = (folder.path() / "one.exr").string(), two = (folder.path() / "two.exr").string(),
                      report_file = (folder.path() / "report.json").string();
    const std::vector<std::string> small{"--size", "96x80", "--spp", "66", "--crop", "7,3,83,71"};
    const auto render = [&](const std::string& devices, std::vector<std::string> words) {
        words.insert(words.end(), small.begin(), small.end());
        const ChildResult result = render_with({{"POCL_DEVICES", devices}, {"OCL_ICD_VENDORS", POCL}}, words);
        INFO(result.errors);
        REQUIRE(result.exit_code == 0);
    };
    render("pthread", {"-o", one});
    render("pthread pthread", {"-o", two, "--device", "all", "--report", report_file});
    CHECK(same_bits(read_image(one), read_image(two)));

    Json::Value report;
    std::istringstream(read_file(report_file)) >> report;
    REQUIRE(report["devices"].size() == 2);
    std::uint64_t samples = 0;
    for (const Json::Value& device : report["devices"]) {
        CHECK(device["launches"].asUInt64() > 0);
        samples += device["samples"].asUInt64();
    }
    CHECK(samples == 83u * 71u * 66u);
}
