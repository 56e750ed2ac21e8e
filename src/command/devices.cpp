// etendue devices.
#include "command/devices.h"

#include "util/log.h"

#include <iostream>
#include <memory>

#include <fmt/format.h>
#include <json/json.h>

namespace etendue
{
namespace
{
constexpr const char* DESCRIPTION = "List the OpenCL devices and say which one `etendue render` would take";

constexpr const char* DETAILS = R"(A platform without a device, a driver that cannot be loaded and a driver that
fails are one warning each. Without a usable device the exit code is 3.

Devices are named in --device of `etendue render` by
  INDEX             the number in front of the device, e.g. 0
  PLATFORM:DEVICE   two numbers, or parts of the two names, e.g. 0:1
  NAME              a part of the device's name, in upper or lower case
  cpu, gpu          the device of that type with most compute units
  all               every usable device
  auto              a GPU if there is one, else the CPU with most compute units
or a comma list of these.

Examples:
  etendue devices
  etendue devices --json | python3 -m json.tool)";

// "1.5 GiB"
std::string bytes_text(std::uint64_t bytes)
{
    const char* const units[] = {"bytes", "KiB", "MiB", "GiB", "TiB"};
    double value = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; value >= 1024.0 && unit + 1 < std::size(units); ++unit) value /= 1024.0;
    return fmt::format("{:.4g} {}", value, units[unit]);
}

std::string yes_no(bool value)
{
    return value ? "yes" : "no";
}

std::string usable_text(const DeviceInfo& d)
{
    if (!d.available) return "no, it is not available";
    return d.compiler_available ? "yes" : "no, it has no compiler for kernels";
}

std::string table_of(const DeviceInfo& d)
{
    std::string text = fmt::format("{}  {}\n", d.index, d.name);
    const auto row = [&](const char* label, const std::string& value) {
        text += fmt::format("   {:<22} {}\n", label, value);
    };
    row("platform:device", fmt::format("{}:{}", d.platform_index, d.device_index));
    row("platform", fmt::format("{}, {}", d.platform_name, d.platform_version));
    row("type", d.type);
    row("vendor", d.vendor);
    row("driver", d.driver_version);
    row("OpenCL", fmt::format("{}, {}", d.device_version, d.opencl_c_version));
    row("compute units", fmt::format("{}, at most {} MHz", d.compute_units, d.max_clock_mhz));
    row("floats per vector", fmt::format("{}", d.native_float_width));
    row("global memory", bytes_text(d.global_memory));
    row("largest buffer", bytes_text(d.max_allocation));
    row("local memory", bytes_text(d.local_memory));
    row("constant buffer", bytes_text(d.constant_memory));
    row("largest work-group", fmt::format("{} work-items", d.max_work_group_size));
    row("double precision", yes_no(d.has_double));
    row("exact division", yes_no(d.correctly_rounded_divide));
    row("usable", usable_text(d));
    return text + '\n';
}

Json::Value json_of(const DeviceInfo& d)
{
    Json::Value value;
    value["index"] = Json::UInt64(d.index);
    value["platform_index"] = Json::UInt64(d.platform_index);
    value["device_index"] = Json::UInt64(d.device_index);
    value["platform_name"] = d.platform_name;
    value["platform_vendor"] = d.platform_vendor;
    value["platform_version"] = d.platform_version;
    value["name"] = d.name;
    value["vendor"] = d.vendor;
    value["type"] = d.type;
    value["driver_version"] = d.driver_version;
    value["device_version"] = d.device_version;
    value["opencl_c_version"] = d.opencl_c_version;
    value["compute_units"] = d.compute_units;
    value["max_clock_mhz"] = d.max_clock_mhz;
    value["native_float_width"] = d.native_float_width;
    value["global_memory"] = Json::UInt64(d.global_memory);
    value["max_allocation"] = Json::UInt64(d.max_allocation);
    value["local_memory"] = Json::UInt64(d.local_memory);
    value["constant_memory"] = Json::UInt64(d.constant_memory);
    value["max_work_group_size"] = Json::UInt64(d.max_work_group_size);
    value["has_double"] = d.has_double;
    value["correctly_rounded_divide"] = d.correctly_rounded_divide;
    value["available"] = d.available;
    value["compiler_available"] = d.compiler_available;
    value["extensions"] = d.extensions;
    return value;
}

// The index of the device that render takes and why, or none and why not.
struct Choice {
    bool exists = false;
    std::size_t index = 0;
    std::string explanation;
};

Choice choose(const DeviceList& list)
{
    try {
        return {true, select_devices(list, "auto").front().index, explain_choice(list)};
    } catch (const DeviceError& error) {
        return {false, 0, error.what()};
    }
}

int list_for_user(bool as_json)
{
    const DeviceList list = list_devices();
    std::cout << (as_json ? devices_json(list) : devices_table(list)) << std::flush;
    const Choice choice = choose(list);
    if (!choice.exists) throw DeviceError(choice.explanation);
    for (const std::string& warning : list.warnings) standard_log().warning(warning);
    return static_cast<int>(ExitCode::success);
}
} // namespace

std::string devices_table(const DeviceList& list)
{
    std::string text;
    for (const DeviceInfo& device : list.devices) text += table_of(device);
    const Choice choice = choose(list);
    return choice.exists ? text + choice.explanation + '\n' : text;
}

std::string devices_json(const DeviceList& list)
{
    Json::Value value;
    value["devices"] = Json::Value(Json::arrayValue);
    for (const DeviceInfo& device : list.devices) value["devices"].append(json_of(device));
    value["warnings"] = Json::Value(Json::arrayValue);
    for (const std::string& warning : list.warnings) value["warnings"].append(warning);
    const Choice choice = choose(list);
    value["choice"] = choice.exists ? Json::Value(Json::UInt64(choice.index)) : Json::Value();
    value["explanation"] = choice.explanation;
    Json::StreamWriterBuilder writer;
    writer["indentation"] = "  ";
    return Json::writeString(writer, value) + '\n';
}

void register_devices(CLI::App& app, std::function<int()>& action)
{
    CLI::App* command = app.add_subcommand("devices", DESCRIPTION);
    command->footer(DETAILS);
    const auto as_json = std::make_shared<bool>(false);
    command->add_flag("--json", *as_json, "Print one JSON object with every field, sizes in bytes");
    command->callback([as_json, &action] { action = [as_json] { return list_for_user(*as_json); }; });
}
} // namespace etendue
