// Opens the devices of `--device` once for all tests.
#include "support/device_evaluate.h"

namespace etendue
{
namespace
{
// What tests keep of OpenCL; released before main() ends.
struct DevicesUnderTest {
    std::string spec = "auto";
    bool used = false;
    std::vector<Device> devices;
};

DevicesUnderTest& under_test()
{
    static DevicesUnderTest all;
    return all;
}
} // namespace

std::vector<Device>& test_devices()
{
    DevicesUnderTest& all = under_test();
    all.used = true;
    if (all.devices.empty())
        for (const DeviceInfo& info : select_devices(list_devices(), all.spec)) all.devices.emplace_back(info);
    return all.devices;
}

void choose_test_devices(const std::string& spec)
{
    under_test().spec = spec;
}

bool test_devices_were_used()
{
    return under_test().used;
}

void close_test_devices()
{
    release_device_functions();
    under_test().devices.clear();
}
} // namespace etendue
