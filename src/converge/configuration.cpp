// Configurations from text, and the axes there are.
#include "converge/configuration.h"

#include "scene/scene_tables.h"
#include "util/suggestion.h"

#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>

namespace etendue
{
namespace
{
[[noreturn]] void fail(const std::string& text, const std::string& message)
{
    throw UsageError(fmt::format(
        "--config must be NAME:path=value,..., for example bsdf:integrator.type=bsdf; \"{}\" {}.", text, message));
}

bool is_name(const std::string& name)
{
    return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) || c == '-' || c == '_' || c == '.';
    });
}

// The parts between commas that are not within brackets, braces or quotes.
std::vector<std::string> split_list(const std::string& text)
{
    std::vector<std::string> parts{""};
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"' && (i == 0 || text[i - 1] != '\\')) in_string = !in_string;
        if (!in_string && (c == '[' || c == '{')) ++depth;
        if (!in_string && (c == ']' || c == '}')) --depth;
        if (c == ',' && depth <= 0 && !in_string)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

bool read_switch(const std::string& key, const std::string& value)
{
    if (value != "on" && value != "off") throw UsageError(fmt::format("{} must be on or off, is \"{}\".", key, value));
    return value == "on";
}

std::uint32_t read_lanes(const std::string& value)
{
    for (const std::uint32_t lanes : {0u, 1u, 4u, 8u, 16u})
        if (value == std::to_string(lanes)) return lanes;
    throw UsageError(fmt::format("render.lanes must be 0, 1, 4, 8 or 16, is \"{}\".", value));
}

void set_render_option(Configuration& configuration, const std::string& key, const std::string& value)
{
    if (key == "render.specialize")
        configuration.specialize = read_switch(key, value);
    else if (key == "render.fast_math")
        configuration.fast_math = read_switch(key, value);
    else if (key == "render.lanes")
        configuration.lanes = read_lanes(value);
    else if (key == "render.device")
        configuration.device = value;
    else if (key == "render.precision") {
        if (value != "single" && value != "fp64")
            throw UsageError(fmt::format("render.precision must be single or fp64, is \"{}\".", value));
        configuration.precision = value;
    } else
        throw UsageError(unknown_name(
            "setting", key,
            {"render.specialize", "render.lanes", "render.precision", "render.fast_math", "render.device"}));
}

Configuration with_override(const std::string& name, const std::string& override)
{
    Configuration configuration;
    configuration.name = name;
    configuration.overrides = {override};
    return configuration;
}

std::vector<Configuration> along_names(std::vector<std::string> names, const std::string& path,
                                       const std::string& left_out)
{
    std::vector<Configuration> configurations;
    for (const std::string& name : names)
        if (name != left_out) configurations.push_back(with_override(name, path + '=' + name));
    return configurations;
}

// A setting of the integrator path.
std::vector<Configuration> along_path_settings(const std::string& key, const std::vector<std::string>& names)
{
    std::vector<Configuration> configurations = along_names(names, "integrator." + key, "");
    for (Configuration& configuration : configurations)
        configuration.overrides.insert(configuration.overrides.begin(), "integrator.type=path");
    return configurations;
}

std::vector<Configuration> along_devices(const std::vector<DeviceInfo>& devices)
{
    std::vector<Configuration> configurations;
    for (const DeviceInfo& device : devices) {
        Configuration configuration;
        configuration.name = fmt::format("device-{}", device.index);
        configuration.device = std::to_string(device.index);
        configurations.push_back(configuration);
    }
    return configurations;
}

std::vector<Configuration> along_render_option(const std::string& key, const std::vector<std::string>& values,
                                               const std::vector<std::string>& names)
{
    std::vector<Configuration> configurations;
    for (std::size_t i = 0; i < values.size(); ++i) {
        Configuration configuration;
        configuration.name = names[i];
        set_render_option(configuration, key, values[i]);
        configurations.push_back(configuration);
    }
    return configurations;
}

} // namespace

std::string Configuration::text() const
{
    std::vector<std::string> parts = overrides;
    if (!specialize) parts.emplace_back("render.specialize=off");
    if (lanes != 0) parts.push_back(fmt::format("render.lanes={}", lanes));
    if (precision != "single") parts.push_back("render.precision=" + precision);
    if (fast_math) parts.emplace_back("render.fast_math=on");
    if (!device.empty()) parts.push_back("render.device=" + device);
    return fmt::format("{}:{}", name, fmt::join(parts, ","));
}

Configuration parse_configuration(const std::string& text)
{
    const std::size_t colon = text.find(':');
    Configuration configuration;
    configuration.name = text.substr(0, colon);
    if (!is_name(configuration.name))
        fail(text, "does not begin with a name of letters, digits, \"-\", \"_\" and \".\"");
    if (colon == std::string::npos || colon + 1 == text.size()) return configuration;
    for (const std::string& part : split_list(text.substr(colon + 1))) {
        const std::size_t equals = part.find('=');
        if (equals == std::string::npos || equals == 0) fail(text, fmt::format("has \"{}\" without path=", part));
        if (part.rfind("render.", 0) == 0)
            set_render_option(configuration, part.substr(0, equals), part.substr(equals + 1));
        else
            configuration.overrides.push_back(part);
    }
    return configuration;
}

const std::vector<std::string>& comparison_axes()
{
    static const std::vector<std::string> axes{"integrators", "heuristics",   "sphere_lights",  "samplers",
                                               "roulette",    "accelerators", "specialization", "precision",
                                               "fast_math",   "devices"};
    return axes;
}

std::vector<Configuration> configurations_along(const std::string& axis, const Scene& scene,
                                                const std::vector<DeviceInfo>& devices)
{
    if (axis == "integrators") return along_names(integrator_table().variant_names(), "integrator.type", "normals");
    if (axis == "heuristics") return along_path_settings("heuristic", {"power", "balance"});
    if (axis == "sphere_lights") return along_path_settings("sphere_lights", {"cone", "area"});
    if (axis == "samplers") return along_names(sampler_table().variant_names(), "sampler.type", "");
    if (axis == "accelerators") return along_names(accelerator_table().variant_names(), "accelerator.type", "auto");
    // Without a limit of the depth, roulette is what ends the paths.
    if (axis == "roulette")
        return along_names(roulette_table().variant_names(), "integrator.roulette",
                           scene.integrator.max_depth ? "" : "off");
    if (axis == "specialization")
        return along_render_option("render.specialize", {"on", "off"}, {"specialised", "general"});
    if (axis == "precision") return along_render_option("render.precision", {"single", "fp64"}, {"single", "fp64"});
    if (axis == "fast_math") return along_render_option("render.fast_math", {"off", "on"}, {"strict", "fast-math"});
    if (axis == "devices") return along_devices(devices);
    throw UsageError("--compare: " + unknown_name("axis", axis, comparison_axes()));
}

void check_names(const std::vector<Configuration>& configurations)
{
    std::set<std::string> names;
    for (const Configuration& configuration : configurations)
        if (!names.insert(configuration.name).second)
            throw UsageError(
                fmt::format("Two configurations are called \"{}\"; each needs a name of its own.", configuration.name));
}
} // namespace etendue
