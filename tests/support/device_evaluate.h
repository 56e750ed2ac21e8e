// The devices under test, and calls of functions of cl/ on them (check/device_functions.h).
//
//     for (Device& device : test_devices())
//         std::vector<float> spacing = functions.evaluate<float>(device, "spacing", {x});
#pragma once

#include "check/device_functions.h"
#include "compute/device.h"

#include <string>
#include <vector>

namespace etendue
{
// The devices of `--device`, opened at the first call. Throws DeviceError when there are none.
std::vector<Device>& test_devices();

// For main(): what test_devices() opens, whether anyone called it, and the release of all devices and programs.
void choose_test_devices(const std::string& spec);
bool test_devices_were_used();
void close_test_devices();
} // namespace etendue
