// A configuration made ready to render: its scene, its geometry, its devices, and what that cost.
#pragma once

#include "converge/configuration.h"
#include "geometry/geometry.h"
#include "render/renderer.h"

#include <optional>
#include <string>
#include <vector>

namespace etendue
{
struct FilmSize {
    int width = 0, height = 0;
};

struct PreparationOptions {
    std::string scene;                  // a file
    std::vector<std::string> overrides; // of all configurations
    std::optional<FilmSize> size;       // empty: the scene's, made smaller where its longer edge is above DEFAULT_EDGE
    std::string device = "auto";
    KernelCache cache;
};

// Pixels of the longer edge. Errors of a smaller picture are as good evidence: they are means over its pixels.
constexpr int DEFAULT_EDGE = 64;

struct PreparedConfiguration {
    Configuration configuration;
    Scene scene;
    Geometry geometry;
    RenderOptions options;
    double load_seconds = 0.0, geometry_seconds = 0.0;
    std::vector<std::string> warnings;
};

// Throws SceneError, FileError, DeviceError, and UsageError where a configuration cannot be rendered, or has no noise.
PreparedConfiguration prepare(const Configuration& configuration, const PreparationOptions& options);

// Width and height for a scene's film, with its aspect kept.
FilmSize limited_size(const FilmDescription& film, int longest_edge);

// What the pictures of two prepared configurations must have in common to converge to the same: all but how light is
// gathered. A SHA-256 of kernels, geometry, materials, lights, camera, film and the limit of the depth: a
// reference that is kept is one of these very kernels.
std::string picture_key(const PreparedConfiguration& prepared);
} // namespace etendue
