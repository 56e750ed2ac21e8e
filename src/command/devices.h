// etendue devices: what there is to render on, and which one render would take.
#pragma once

#include "compute/device.h"

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace etendue
{
// Add the sub-command `devices` to the program. When the user calls it, `action` becomes what main() has to run: it
// returns 0, or throws DeviceError when no device is usable.
void register_devices(CLI::App& app, std::function<int()>& action);

// The table for people, and the same with every field for programs. Both end with the choice of `render`; the
// table says nothing and the JSON says why when there is none.
std::string devices_table(const DeviceList& list);
std::string devices_json(const DeviceList& list);
} // namespace etendue
