// Which devices a SPEC means, on made-up lists.
#include "compute/device.h"

#include <catch2/catch.hpp>

using namespace etendue;
using Catch::Contains;

namespace
{
DeviceInfo make_device(std::size_t platform, std::size_t device, const std::string& type, const std::string& name,
                       std::uint32_t units)
{
    DeviceInfo info;
    info.platform_index = platform;
    info.device_index = device;
    info.platform_name = platform == 0 ? "Portable Computing Language" : "Vendor CL";
    info.type = type;
    info.name = name;
    info.compute_units = units;
    info.available = info.compiler_available = true;
    return info;
}

DeviceList make_list(std::vector<DeviceInfo> devices)
{
    DeviceList list;
    for (std::size_t i = 0; i < devices.size(); ++i) devices[i].index = i;
    list.devices = devices;
    return list;
}

DeviceList mixed()
{
    return make_list({make_device(0, 0, "cpu", "pthread-small", 2), make_device(0, 1, "cpu", "pthread-large", 64),
                      make_device(1, 0, "gpu", "Radeon 1", 8), make_device(1, 1, "gpu", "Radeon 2", 40),
                      make_device(1, 2, "accelerator", "Board", 100)});
}

std::vector<std::size_t> indices(const DeviceList& list, const std::string& spec)
{
    std::vector<std::size_t> result;
    for (const DeviceInfo& d : select_devices(list, spec)) result.push_back(d.index);
    return result;
}

using Indices = std::vector<std::size_t>;
} // namespace

TEST_CASE("auto takes the largest GPU, else the largest CPU, else anything")
{
    DeviceList list = mixed();
    CHECK(indices(list, "auto") == Indices{3});
    list.devices[2].available = list.devices[3].compiler_available = false;
    CHECK(indices(list, "auto") == Indices{1});
    list.devices[0].available = list.devices[1].available = false;
    CHECK(indices(list, "auto") == Indices{4});
}

TEST_CASE("of equal devices auto takes the first")
{
    CHECK(indices(make_list({make_device(0, 0, "cpu", "a", 4), make_device(0, 1, "cpu", "a", 4)}), "auto") ==
          Indices{0});
}

TEST_CASE("a device is named by index, platform:device, part of a name or type")
{
    const DeviceList list = mixed();
    CHECK(indices(list, "0") == Indices{0});
    CHECK(indices(list, "1:1") == Indices{3});
    CHECK(indices(list, "portable:1") == Indices{1});
    CHECK(indices(list, "vendor:board") == Indices{4});
    CHECK(indices(list, "RADEON") == Indices{2});
    CHECK(indices(list, "large") == Indices{1});
    CHECK(indices(list, "cpu") == Indices{1});
    CHECK(indices(list, "gpu") == Indices{3});
}

TEST_CASE("all and comma lists take several devices, each once, in the order given")
{
    DeviceList list = mixed();
    CHECK(indices(list, "all") == Indices{0, 1, 2, 3, 4});
    CHECK(indices(list, "3, 0,gpu,small") == Indices{3, 0});
    CHECK(indices(list, "board,all") == Indices{4, 0, 1, 2, 3});
    list.devices[1].available = false;
    CHECK(indices(list, "all") == Indices{0, 2, 3, 4});
}

TEST_CASE("a part of a name prefers a device that can be used")
{
    DeviceList list = mixed();
    list.devices[2].available = false;
    CHECK(indices(list, "radeon") == Indices{3});
}

TEST_CASE("a device that does not exist is answered with the list of those that do")
{
    const DeviceList list = mixed();
    for (const std::string spec : {"5", "2:0", "1:7", "geforce", "", "0,", "-1", "0:", ":0", "99999999999999999999"}) {
        INFO(spec);
        CHECK_THROWS_AS(select_devices(list, spec), DeviceError);
    }
    CHECK_THROWS_WITH(select_devices(list, "0,geforce"),
                      "No OpenCL device is called \"geforce\". There are (index, platform:device, type, name):\n"
                      "  0  0:0  cpu  pthread-small (Portable Computing Language)\n"
                      "  1  0:1  cpu  pthread-large (Portable Computing Language)\n"
                      "  2  1:0  gpu  Radeon 1 (Vendor CL)\n"
                      "  3  1:1  gpu  Radeon 2 (Vendor CL)\n"
                      "  4  1:2  accelerator  Board (Vendor CL)\n"
                      "A device is named by index, by platform:device, by a part of its name, or as cpu, gpu, all or "
                      "auto.");
    CHECK_THROWS_WITH(select_devices(make_list({make_device(0, 0, "cpu", "a", 4)}), "gpu"), Contains("called \"gpu\""));
}

TEST_CASE("a named device that cannot be used says why")
{
    DeviceList list = mixed();
    list.devices[2].available = false;
    list.devices[3].compiler_available = false;
    CHECK_THROWS_WITH(select_devices(list, "2"), "Radeon 1: the device is not available.");
    CHECK_THROWS_WITH(select_devices(list, "3"), "Radeon 2: the device has no compiler for kernels.");
}

TEST_CASE("no device at all names the package to install and repeats the warnings")
{
    DeviceList list;
    list.warnings = {"OpenCL platform 0 (Vendor CL) has no device."};
    for (const char* spec : {"auto", "all", "0", "cpu"})
        CHECK_THROWS_WITH(select_devices(list, spec), Contains("There is no OpenCL device.") &&
                                                          Contains("Vendor CL) has no device.") &&
                                                          Contains("pocl-opencl-icd"));
    list.devices = make_list({make_device(0, 0, "cpu", "a", 4)}).devices;
    list.devices[0].available = false;
    CHECK_THROWS_WITH(select_devices(list, "0"),
                      Contains("a (Portable Computing Language), not usable") && Contains("pocl-opencl-icd"));
    CHECK_THROWS_AS(explain_choice(list), DeviceError);
}

TEST_CASE("the choice is explained in a sentence")
{
    CHECK(explain_choice(mixed()) == "`etendue render` takes device 3 (Radeon 2), because it is a GPU, and of 2 of its "
                                     "type none has more compute units.");
    CHECK(explain_choice(make_list({make_device(0, 0, "cpu", "a", 4)})) ==
          "`etendue render` takes device 0 (a), because there is no GPU and it is a CPU.");
}
