// What a study compares: a scene rendered in different ways.
#pragma once

#include "compute/device.h"
#include "scene/scene.h"
#include "scene/scene_loader.h"

#include <cstdint>
#include <string>
#include <vector>

namespace etendue
{
struct Configuration {
    std::string name; // letters, digits, "-", "_" and "."
    // Of the scene, as -D; the sections integrator, sampler and accelerator in scenes of the course's format too.
    std::vector<std::string> overrides;
    // Of the renderer: what begins with "render.".
    bool specialize = true;
    std::uint32_t lanes = 0;          // 0: as suits the device
    std::string precision = "single"; // or "fp64"
    bool fast_math = false;
    std::string device; // "": that of the study

    std::string text() const; // "path:integrator.type=path"
};

// From NAME:path=value,... Commas within brackets and quotes belong to the value. Throws UsageError.
Configuration parse_configuration(const std::string& text);

// The axes that can be compared out of the box, and the configurations along one of them for a scene. Throws UsageError
// for an unknown axis.
const std::vector<std::string>& comparison_axes();
std::vector<Configuration> configurations_along(const std::string& axis, const Scene& scene,
                                                const std::vector<DeviceInfo>& devices);

// Throws UsageError when two configurations have one name.
void check_names(const std::vector<Configuration>& configurations);

// The scene as the overrides say. Throws what load_scene throws.
LoadedScene load_configured(const std::string& path, const std::vector<std::string>& overrides);
} // namespace etendue
