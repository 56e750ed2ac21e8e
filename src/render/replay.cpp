// Launches of the replay kernel.
#include "render/replay.h"

#include "compute/canary.h"
#include "render/precision.h"
#include "render/render_settings.h"
#include "render/scene_features.h"
#include "util/shell_word.h"

#include <algorithm>

#include <fmt/format.h>

namespace etendue
{
namespace
{
// Bytes of the vertices of one launch.
constexpr std::size_t LAUNCH_BYTES = std::size_t{1} << 25;

RenderSettings replay_settings(const Scene& scene, const Geometry& geometry)
{
    return make_render_settings(scene, geometry, choose_accelerator(scene.accelerator, geometry.primitives.size(), 1));
}

// Checked before anything is uploaded.
const Device& able_device(const Device& device, const Scene& scene, Precision precision)
{
    if (scene.integrator.type == IntegratorType::normals)
        throw UsageError("The normals integrator follows no paths that could be replayed; choose another one.");
    if (precision == Precision::fp64) device.require_double();
    return device;
}

Specialization replay_features(const Scene& scene, const Geometry& geometry, const RenderSettings& settings,
                               std::uint32_t bvh_depth, Precision precision, bool specialize)
{
    Specialization s = scene_features(scene, geometry, settings, false, 1, bvh_depth);
    if (!specialize) s = Specialization::everything(1, s.stack_size);
    s.precision = precision;
    return s;
}

WorkUnit unit_of(const ReplaySample& sample)
{
    return {sample.x,
            sample.y,
            1,
            1,
            static_cast<std::uint32_t>(sample.sample),
            static_cast<std::uint32_t>(sample.sample >> 32),
            1,
            1};
}

std::vector<fp64::PathVertex> in_double(const std::vector<fp64::PathVertex>& vertices)
{
    return vertices;
}
std::vector<fp64::PathVertex> in_double(const std::vector<PathVertex>& vertices)
{
    return widen(vertices);
}
} // namespace

std::string replay_command(const std::string& file, const ReplaySample& sample, std::uint64_t seed,
                           const std::vector<std::string>& options)
{
    std::string line = fmt::format("etendue replay {} --pixel {},{} --sample {} --seed {}", shell_word(file), sample.x,
                                   sample.y, sample.sample, seed);
    for (const std::string& option : options) line += ' ' + shell_word(option);
    return line;
}

Replayer::Replayer(const Device& device, const Scene& scene, const Geometry& geometry, Precision precision,
                   const ReplayOptions& options)
    : device_(&able_device(device, scene, precision)), precision_(precision),
      settings_(replay_settings(scene, geometry)),
      scene_(device, geometry, settings_, BvhPlace::host, options.cache, precision),
      program_(device, "replay.cl",
               replay_features(scene, geometry, settings_, scene_.bvh_statistics().depth, precision, options.specialize)
                       .build_options() +
                   (options.fast_math ? std::string(" ") + FAST_MATH_OPTION : ""),
               options.cache),
      kernel_(program_, "replay")
{
}

std::vector<PathRecord> Replayer::replay(std::span<const ReplaySample> samples, std::uint32_t max_vertices)
{
    for (const ReplaySample& s : samples)
        if (s.x >= settings_.width || s.y >= settings_.height)
            throw UsageError(fmt::format("The pixel {},{} is outside the film of {}x{} pixels.", s.x, s.y,
                                         settings_.width, settings_.height));
    const std::size_t vertex_bytes = precision_ == Precision::fp64 ? sizeof(fp64::PathVertex) : sizeof(PathVertex);
    const std::size_t batch = std::max<std::size_t>(1, LAUNCH_BYTES / vertex_bytes / std::max(max_vertices, 1u));
    std::vector<PathRecord> records;
    records.reserve(samples.size());
    for (std::size_t first = 0; first < samples.size(); first += batch) {
        const auto part = samples.subspan(first, std::min(batch, samples.size() - first));
        if (precision_ == Precision::fp64)
            launch<DoubleReals>(part, max_vertices, records);
        else
            launch<SingleReals>(part, max_vertices, records);
    }
    return records;
}

template<typename Reals>
void Replayer::launch(std::span<const ReplaySample> samples, std::uint32_t max_vertices,
                      std::vector<PathRecord>& records)
{
    std::vector<WorkUnit> units;
    std::transform(samples.begin(), samples.end(), std::back_inserter(units), unit_of);
    const std::size_t count = units.size();
    const Buffer<WorkUnit> unit_buffer(*device_, "samples to replay", units);
    const Buffer<typename Reals::Vertex> vertex_buffer(*device_, "vertices", count * max_vertices);
    const Buffer<cl_uint> count_buffer(*device_, "vertex counts", count);
    const Buffer<typename Reals::Result> result_buffer(*device_, "replayed samples", count);
    scene_.launch(kernel_, count, 0, unit_buffer, static_cast<cl_uint>(count), max_vertices, vertex_buffer,
                  count_buffer, result_buffer);

    const auto vertices = vertex_buffer.read();
    const auto counts = count_buffer.read();
    const auto results = result_buffer.read();
    for (std::size_t i = 0; i < count; ++i) {
        const auto begin = vertices.begin() + static_cast<std::ptrdiff_t>(i * max_vertices);
        const std::vector path(begin, begin + std::min(counts[i], max_vertices));
        const auto& r = results[i].radiance;
        records.push_back(
            {in_double(path), counts[i], Vec3(r.s[0], r.s[1], r.s[2]), static_cast<std::uint32_t>(r.s[3])});
    }
}

std::vector<PathRecord> replay(const Device& device, const Scene& scene, const Geometry& geometry, Precision precision,
                               std::span<const ReplaySample> samples, std::uint32_t max_vertices,
                               const ReplayOptions& options)
{
    return Replayer(device, scene, geometry, precision, options).replay(samples, max_vertices);
}
} // namespace etendue
