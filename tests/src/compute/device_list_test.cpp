// Listing devices where the installation is empty, broken or unusual: each in a process of its own, because the OpenCL
// loader looks once.
#include "compute/device.h"

#include "support/child_process.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace etendue;
using Catch::Contains;

namespace
{
ChildResult list_with(const std::map<std::string, std::string>& environment)
{
    return run_child(ETENDUE_BINARY_DIR "/tests/etendue_tests", {"--list-devices"}, environment);
}

bool has_pocl()
{
    const auto devices = list_devices().devices;
    return std::any_of(devices.begin(), devices.end(),
                       [](const DeviceInfo& d) { return d.platform_name == "Portable Computing Language"; });
}
} // namespace

TEST_CASE("a folder without drivers means no device, and the package to install")
{
    const TemporaryFolder folder;
    const ChildResult result = list_with({{"OCL_ICD_VENDORS", folder.path().string()}});
    CHECK(result.exit_code == 3);
    CHECK(result.output.empty());
    CHECK_THAT(result.errors, Contains("There is no OpenCL device.") && Contains("pocl-opencl-icd"));
}

TEST_CASE("a driver that cannot be loaded is one warning")
{
    const TemporaryFolder folder;
    write_file((folder.path() / "dead.icd").string(), "/nowhere/libdead.so\n");
    write_file((folder.path() / "empty.icd").string(), "");
    const ChildResult result = list_with({{"OCL_ICD_VENDORS", folder.path().string()}});
    CHECK(result.exit_code == 3);
    CHECK_THAT(result.errors, Contains("  The driver that " + (folder.path() / "dead.icd").string() +
                                       " names cannot be loaded: /nowhere/libdead.so"));
    CHECK_THAT(result.errors, Contains("empty.icd names no driver library."));
}

TEST_CASE("a dead driver beside a live one hides no device")
{
    REQUIRE(has_pocl());
    const TemporaryFolder folder;
    std::filesystem::copy_file("/etc/OpenCL/vendors/pocl.icd", folder.path() / "pocl.icd");
    write_file((folder.path() / "dead.icd").string(), "/nowhere/libdead.so\n");
    const ChildResult result = list_with({{"OCL_ICD_VENDORS", folder.path().string()}});
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, Contains("0 cpu pthread") && Contains("takes device 0"));
    CHECK_THAT(result.errors, Contains("warning: The driver that") && Contains("dead.icd"));
}

TEST_CASE("a platform without a device is one warning and no crash")
{
    REQUIRE(has_pocl());
    const ChildResult result = list_with({{"POCL_DEVICES", ""}, {"OCL_ICD_VENDORS", "/etc/OpenCL/vendors/pocl.icd"}});
    CHECK(result.exit_code == 3);
    CHECK_THAT(result.errors, Contains("  OpenCL platform 0 (Portable Computing Language) has no device.") &&
                                  Contains("pocl-opencl-icd"));
}

TEST_CASE("two devices of one platform are listed apart")
{
    REQUIRE(has_pocl());
    const ChildResult result =
        list_with({{"POCL_DEVICES", "pthread pthread"}, {"OCL_ICD_VENDORS", "/etc/OpenCL/vendors/pocl.icd"}});
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, Contains("0 cpu pthread") && Contains("1 cpu pthread") &&
                                  Contains("of 2 of its type none has more compute units"));
}

TEST_CASE("a kernel cache that PoCL cannot write is replaced with a warning, and removed at the end")
{
    REQUIRE(has_pocl());
    const TemporaryFolder folder;
    write_file((folder.path() / "file").string(), "");
    const ChildResult result = list_with({{"POCL_CACHE_DIR", (folder.path() / "file" / "cache").string()},
                                          {"OCL_ICD_VENDORS", "/etc/OpenCL/vendors/pocl.icd"},
                                          {"TMPDIR", folder.path().string()}});
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, Contains("0 cpu pthread"));
    CHECK_THAT(result.errors, Contains("PoCL cannot write its kernel cache") && Contains("POCL_CACHE_DIR"));
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}
