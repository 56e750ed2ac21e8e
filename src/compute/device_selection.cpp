// Which devices a person means.
#include "compute/device.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <functional>
#include <optional>

#include <fmt/format.h>

namespace etendue
{
namespace
{
bool is_usable(const DeviceInfo& device)
{
    return device.available && device.compiler_available;
}

std::string lower_case(std::string text)
{
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

bool contains(const std::string& text, const std::string& part)
{
    return lower_case(text).find(lower_case(part)) != std::string::npos;
}

std::optional<std::size_t> parse_index(const std::string& text)
{
    std::size_t index = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, index);
    if (text.empty() || failure != std::errc() || stop != end) return {};
    return index;
}

std::string describe(const DeviceInfo& d)
{
    return fmt::format("  {}  {}:{}  {}  {} ({}){}\n", d.index, d.platform_index, d.device_index, d.type, d.name,
                       d.platform_name, is_usable(d) ? "" : ", not usable");
}

std::string describe(const DeviceList& list)
{
    std::string text;
    for (const DeviceInfo& device : list.devices) text += describe(device);
    return text;
}

[[noreturn]] void throw_no_usable_device(const DeviceList& list)
{
    std::string text = list.devices.empty()
                           ? "There is no OpenCL device.\n"
                           : "No OpenCL device is usable: each is unavailable or lacks a compiler.\n" + describe(list);
    for (const std::string& warning : list.warnings) text += "  " + warning + '\n';
    throw DeviceError(text + "Install a driver: on Debian and Ubuntu `sudo apt install pocl-opencl-icd` makes the CPU "
                             "an OpenCL device; for a GPU install the OpenCL driver of its maker.");
}

[[noreturn]] void throw_no_such_device(const DeviceList& list, const std::string& item)
{
    throw DeviceError(fmt::format("No OpenCL device is called \"{}\". There are (index, platform:device, type, "
                                  "name):\n{}A device is named by index, by platform:device, by a part of its name, or "
                                  "as cpu, gpu, all or auto.",
                                  item, describe(list)));
}

using Condition = std::function<bool(const DeviceInfo&)>;

// The usable device with most compute units that meets the condition, the first of equals; null if there is none.
const DeviceInfo* largest(const DeviceList& list, const Condition& condition)
{
    const DeviceInfo* best = nullptr;
    for (const DeviceInfo& device : list.devices)
        if (is_usable(device) && condition(device) && (!best || device.compute_units > best->compute_units))
            best = &device;
    return best;
}

// A GPU, else a CPU, else whatever there is.
const DeviceInfo* automatic(const DeviceList& list)
{
    const DeviceInfo* device = largest(list, [](const DeviceInfo& d) { return d.type == "gpu"; });
    if (!device) device = largest(list, [](const DeviceInfo& d) { return d.type == "cpu"; });
    if (!device) device = largest(list, [](const DeviceInfo&) { return true; });
    return device;
}

const DeviceInfo* first(const DeviceList& list, const Condition& condition)
{
    const auto found = std::find_if(list.devices.begin(), list.devices.end(), condition);
    return found == list.devices.end() ? nullptr : &*found;
}

// Either half of platform:device is an index or a part of the name.
const DeviceInfo* by_platform(const DeviceList& list, const std::string& platform, const std::string& device)
{
    if (platform.empty() || device.empty()) return nullptr;
    const auto platform_index = parse_index(platform), device_index = parse_index(device);
    return first(list, [&](const DeviceInfo& d) {
        return (platform_index ? d.platform_index == *platform_index : contains(d.platform_name, platform)) &&
               (device_index ? d.device_index == *device_index : contains(d.name, device));
    });
}

// A part of the name; of several that have it the first usable one.
const DeviceInfo* by_name(const DeviceList& list, const std::string& part)
{
    const DeviceInfo* usable = first(list, [&](const auto& d) { return is_usable(d) && contains(d.name, part); });
    return usable ? usable : first(list, [&](const auto& d) { return contains(d.name, part); });
}

const DeviceInfo* find_device(const DeviceList& list, const std::string& item)
{
    if (item.empty()) return nullptr;
    if (item == "auto") return automatic(list);
    if (item == "cpu" || item == "gpu") return largest(list, [&](const DeviceInfo& d) { return d.type == item; });
    if (const auto index = parse_index(item)) return *index < list.devices.size() ? &list.devices[*index] : nullptr;
    if (const DeviceInfo* device = by_name(list, item)) return device;
    const auto colon = item.find(':');
    return colon == std::string::npos ? nullptr : by_platform(list, item.substr(0, colon), item.substr(colon + 1));
}

std::vector<std::string> split_at_commas(const std::string& text)
{
    std::vector<std::string> items(1);
    for (const char c : text) {
        if (c == ',')
            items.emplace_back();
        else if (c != ' ' || !items.back().empty())
            items.back() += c;
    }
    return items;
}

void add_once(std::vector<DeviceInfo>& chosen, const DeviceInfo& device)
{
    const auto same = [&](const DeviceInfo& d) { return d.index == device.index; };
    if (std::none_of(chosen.begin(), chosen.end(), same)) chosen.push_back(device);
}
} // namespace

std::vector<DeviceInfo> select_devices(const DeviceList& list, const std::string& spec)
{
    if (!automatic(list)) throw_no_usable_device(list);
    std::vector<DeviceInfo> chosen;
    for (const std::string& item : split_at_commas(spec)) {
        if (item == "all") {
            for (const DeviceInfo& device : list.devices)
                if (is_usable(device)) add_once(chosen, device);
            continue;
        }
        const DeviceInfo* device = find_device(list, item);
        if (!device) throw_no_such_device(list, item);
        if (!is_usable(*device))
            throw DeviceError(fmt::format("{}: the device {}.", device->name,
                                          device->available ? "has no compiler for kernels" : "is not available"));
        add_once(chosen, *device);
    }
    return chosen;
}

std::string explain_choice(const DeviceList& list)
{
    const DeviceInfo device = select_devices(list, "auto").front();
    const auto rivals = std::count_if(list.devices.begin(), list.devices.end(),
                                      [&](const DeviceInfo& d) { return is_usable(d) && d.type == device.type; });
    std::string reason = device.type == "gpu"   ? "it is a GPU"
                         : device.type == "cpu" ? "there is no GPU and it is a CPU"
                                                : "there is neither a GPU nor a CPU";
    if (rivals > 1) reason += fmt::format(", and of {} of its type none has more compute units", rivals);
    return fmt::format("`etendue render` takes device {} ({}), because {}.", device.index, device.name, reason);
}
} // namespace etendue
