// etendue devices: the table, the JSON, and the command as a user calls it.
#include "command/devices.h"

#include "support/child_process.h"

#include <catch2/catch.hpp>

#include <sstream>

#include <json/json.h>

using namespace etendue;
using Catch::Contains;

namespace
{
DeviceList one_gpu()
{
    DeviceInfo d;
    d.platform_index = 1;
    d.platform_name = "Vendor CL";
    d.platform_vendor = "Vendor Inc.";
    d.platform_version = "OpenCL 3.0 vendor";
    d.name = "Radeon";
    d.vendor = "Maker";
    d.driver_version = "9.8";
    d.device_version = "OpenCL 2.0 device";
    d.opencl_c_version = "OpenCL C 1.2";
    d.type = "gpu";
    d.compute_units = 40;
    d.native_float_width = 1;
    d.global_memory = 8ull << 30;
    d.max_allocation = 3ull << 29;
    d.local_memory = 65536;
    d.constant_memory = 1000;
    d.max_work_group_size = 256;
    d.max_clock_mhz = 2000;
    d.has_double = true;
    d.available = d.compiler_available = true;
    d.extensions = "cl_khr_fp64";
    DeviceList list;
    list.devices = {d};
    list.warnings = {"OpenCL platform 0 (Empty) has no device."};
    return list;
}

Json::Value parse(const std::string& text)
{
    Json::Value value;
    std::istringstream(text) >> value;
    return value;
}

ChildResult etendue_devices(const std::vector<std::string>& arguments,
                            const std::map<std::string, std::string>& environment)
{
    std::vector<std::string> all{"devices"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run_child(ETENDUE_BINARY_DIR "/etendue", all, environment);
}
} // namespace

TEST_CASE("the device table shows what a person needs to choose")
{
    CHECK(devices_table(one_gpu()) == "0  Radeon\n"
                                      "   platform:device        1:0\n"
                                      "   platform               Vendor CL, OpenCL 3.0 vendor\n"
                                      "   type                   gpu\n"
                                      "   vendor                 Maker\n"
                                      "   driver                 9.8\n"
                                      "   OpenCL                 OpenCL 2.0 device, OpenCL C 1.2\n"
                                      "   compute units          40, at most 2000 MHz\n"
                                      "   floats per vector      1\n"
                                      "   global memory          8 GiB\n"
                                      "   largest buffer         1.5 GiB\n"
                                      "   local memory           64 KiB\n"
                                      "   constant buffer        1000 bytes\n"
                                      "   largest work-group     256 work-items\n"
                                      "   double precision       yes\n"
                                      "   exact division         no\n"
                                      "   usable                 yes\n"
                                      "\n"
                                      "`etendue render` takes device 0 (Radeon), because it is a GPU.\n");
}

TEST_CASE("the JSON of the devices has every field, the warnings and the choice")
{
    const Json::Value value = parse(devices_json(one_gpu()));
    CHECK(value["choice"].asUInt64() == 0);
    CHECK_THAT(value["explanation"].asString(), Contains("takes device 0 (Radeon)"));
    CHECK(value["warnings"][0].asString() == "OpenCL platform 0 (Empty) has no device.");
    CHECK(value["devices"].size() == 1);
    CHECK(value["devices"][0] == parse(R"({"index": 0, "platform_index": 1, "device_index": 0,
        "platform_name": "Vendor CL", "platform_vendor": "Vendor Inc.", "platform_version": "OpenCL 3.0 vendor",
        "name": "Radeon", "vendor": "Maker", "type": "gpu", "driver_version": "9.8",
        "device_version": "OpenCL 2.0 device", "opencl_c_version": "OpenCL C 1.2", "compute_units": 40,
        "max_clock_mhz": 2000, "native_float_width": 1, "global_memory": 8589934592, "max_allocation": 1610612736,
        "local_memory": 65536, "constant_memory": 1000, "max_work_group_size": 256, "has_double": true,
        "correctly_rounded_divide": false, "available": true, "compiler_available": true,
        "extensions": "cl_khr_fp64"})"));
}

TEST_CASE("the JSON without a usable device says why there is no choice")
{
    DeviceList list = one_gpu();
    list.devices[0].available = false;
    const Json::Value value = parse(devices_json(list));
    CHECK(value["choice"].isNull());
    CHECK_THAT(value["explanation"].asString(), Contains("No OpenCL device is usable") && Contains("pocl-opencl-icd"));
    CHECK_THAT(devices_table(list), Contains("no, it is not available") && !Contains("etendue render"));
}

TEST_CASE("etendue devices lists the devices of this machine and the choice")
{
    const ChildResult table = etendue_devices({}, {});
    CHECK(table.exit_code == 0);
    CHECK_THAT(table.output, Contains("0  " + list_devices().devices.at(0).name) && Contains("`etendue render` takes"));
    const ChildResult json = etendue_devices({"--json"}, {});
    CHECK(json.exit_code == 0);
    CHECK(parse(json.output)["devices"].size() == list_devices().devices.size());
}

TEST_CASE("etendue devices without a device exits with 3 and the package to install")
{
    const TemporaryFolder folder;
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{}, {"--json"}}) {
        const ChildResult result = etendue_devices(arguments, {{"OCL_ICD_VENDORS", folder.path().string()}});
        CHECK(result.exit_code == 3);
        CHECK_THAT(result.errors, Contains("There is no OpenCL device.") && Contains("pocl-opencl-icd"));
        CHECK(result.output.empty() == arguments.empty());
    }
}
