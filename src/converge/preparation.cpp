// From a configuration to what a Renderer is made of.
#include "converge/preparation.h"

#include "compute/kernel_source.h"
#include "render/render_settings.h"
#include "util/sha256.h"
#include "util/stopwatch.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
RenderOptions render_options(const Configuration& configuration, const PreparationOptions& options,
                             std::vector<std::string>& warnings)
{
    RenderOptions result;
    const DeviceList list = list_devices();
    result.devices = select_devices(list, configuration.device.empty() ? options.device : configuration.device);
    warnings.insert(warnings.end(), list.warnings.begin(), list.warnings.end());
    result.lanes = configuration.lanes;
    result.specialize = configuration.specialize;
    result.cache = options.cache;
    result.precision = configuration.precision == "fp64" ? Precision::fp64 : Precision::single;
    result.fast_math = configuration.fast_math;
    return result;
}

template<typename T>
std::string bytes_of(const std::vector<T>& values)
{
    return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}
} // namespace

FilmSize limited_size(const FilmDescription& film, int longest_edge)
{
    const int edge = std::max(film.width, film.height);
    if (edge <= longest_edge) return {film.width, film.height};
    const auto scaled = [&](int length) {
        return std::max(1, static_cast<int>(std::lround(static_cast<double>(length) * longest_edge / edge)));
    };
    return {scaled(film.width), scaled(film.height)};
}

PreparedConfiguration prepare(const Configuration& configuration, const PreparationOptions& options)
{
    PreparedConfiguration prepared;
    prepared.configuration = configuration;
    std::vector<std::string> overrides = options.overrides;
    overrides.insert(overrides.end(), configuration.overrides.begin(), configuration.overrides.end());
    Stopwatch watch;
    LoadedScene loaded = load_configured(options.scene, overrides);
    prepared.load_seconds = watch.restart();
    prepared.scene = std::move(loaded.scene);
    prepared.warnings = std::move(loaded.warnings);
    if (prepared.scene.integrator.type == IntegratorType::normals)
        throw UsageError(configuration.name + ": the integrator normals has no noise whose fall could be measured.");
    const FilmSize size = options.size.value_or(limited_size(prepared.scene.film, DEFAULT_EDGE));
    prepared.scene.film.width = size.width;
    prepared.scene.film.height = size.height;
    prepared.geometry = make_geometry(prepared.scene);
    prepared.geometry_seconds = watch.seconds();
    prepared.warnings.insert(prepared.warnings.end(), prepared.geometry.warnings.begin(),
                             prepared.geometry.warnings.end());
    prepared.options = render_options(configuration, options, prepared.warnings);
    return prepared;
}

std::string picture_key(const PreparedConfiguration& prepared)
{
    const Geometry& geometry = prepared.geometry;
    const Scene& scene = prepared.scene;
    const Vec3& centre = geometry.normalisation.centre;
    const std::string numbers = fmt::format(
        "{} {}x{} {} {} {} {} {} {} {} {}", sha256(expand_program("path_megakernel.cl")), scene.film.width,
        scene.film.height, static_cast<int>(scene.film.filter), scene.film.filter_radius, scene.film.filter_sigma,
        scene.integrator.max_depth.value_or(NO_INDEX), centre.x, centre.y, centre.z, geometry.normalisation.scale);
    return sha256(numbers + bytes_of(geometry.primitives) + bytes_of(geometry.surfaces) + bytes_of(geometry.normals) +
                  bytes_of(geometry.materials) + bytes_of(geometry.parameters) + bytes_of(geometry.lights) +
                  bytes_of(geometry.light_table) + bytes_of(std::vector<Camera>{geometry.camera}));
}
} // namespace etendue
