// Launches of the path kernel.
#include "render/megakernel.h"

#include "render/scene_features.h"

#include <algorithm>

namespace etendue
{
namespace
{
constexpr std::uint32_t GPU_LOCAL_SIZE = 64;
constexpr std::uint32_t GPU_POOL_SIZE = 4;
// A pool this long keeps the lanes 96 % busy to its end; shorter ones spread a small launch over all compute units.
constexpr std::uint64_t CPU_POOL_SIZE = 1024;
constexpr std::uint64_t POOLS_PER_COMPUTE_UNIT = 8;

LaunchShape complete_shape(LaunchShape shape, const Device& device, const Specialization& specialization)
{
    const auto largest =
        static_cast<std::uint32_t>(std::min<std::size_t>(device.info().max_work_group_size, GPU_LOCAL_SIZE));
    if (shape.local_size == 0) shape.local_size = device.is_cpu() || specialization.lanes > 1 ? 1 : largest;
    return shape;
}

std::string joined(const std::string& options, const std::string& more)
{
    return more.empty() ? options : options + ' ' + more;
}
} // namespace

Megakernel::Megakernel(const Device& device, bool normals, const Specialization& specialization,
                       const KernelCache& cache, const LaunchShape& shape, const std::string& path_options)
    : device_(&device), specialization_(specialization), shape_(complete_shape(shape, device, specialization)),
      path_program_(device, normals ? "normals.cl" : "path_megakernel.cl",
                    joined(specialization.build_options(), path_options), cache),
      film_program_(device, "film.cl", film_features(specialization.has(Feature::AOV)).build_options(), cache),
      path_kernel_(path_program_, normals ? "normals" : "path_megakernel"),
      film_kernel_(film_program_, "film_accumulate"), results_(device, "sample results", shape_.max_samples),
      blocks_(device, "pixel sums", shape_.max_samples), counters_(device, "counters", 1)
{
    if (!specialization.has(Feature::AOV)) return;
    sample_aovs_ = Buffer<SampleAov>(device, "sample AOVs", shape_.max_samples);
    block_aovs_ = Buffer<PixelAov>(device, "pixel AOVs", shape_.max_samples);
}

std::uint32_t Megakernel::pool_size(std::uint64_t samples) const
{
    if (shape_.pool_size != 0) return shape_.pool_size;
    if (!device_->is_cpu()) return GPU_POOL_SIZE * specialization_.lanes;
    const std::uint64_t shared = samples / (device_->compute_units() * POOLS_PER_COMPUTE_UNIT);
    return static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(shared, std::uint64_t{4} * specialization_.lanes, CPU_POOL_SIZE));
}

LaunchCounters Megakernel::trace(const DeviceScene& scene, WorkUnit unit, std::vector<PixelBlock>& blocks,
                                 std::vector<PixelAov>& aovs)
{
    const std::uint64_t pixels = std::uint64_t{unit.tile_width} * unit.tile_height;
    const std::uint64_t samples = pixels * unit.sample_count;
    unit.pool_size = pool_size(samples);
    const std::uint64_t items = (samples + unit.pool_size - 1) / unit.pool_size;
    const auto round_up = [&](std::uint64_t n) {
        return (n + shape_.local_size - 1) / shape_.local_size * shape_.local_size;
    };

    LaunchCounters counters{};
    std::fill(std::begin(counters.health_first), std::end(counters.health_first), NO_INDEX);
    counters_.write(&counters, 1);
    blocks_.write(blocks);
    block_aovs_.write(aovs);
    scene.launch(path_kernel_, round_up(items), shape_.local_size, unit, results_, sample_aovs_, counters_);
    film_kernel_.launch(pixels, 0, unit, results_, sample_aovs_, blocks_, block_aovs_, counters_);
    blocks_.read(blocks.data(), blocks.size());
    block_aovs_.read(aovs.data(), aovs.size());
    counters_.read(&counters, 1);
    return counters;
}

std::uint32_t Megakernel::accident_code(std::uint32_t flat_index) const
{
    SampleResult result;
    results_.read(&result, 1, flat_index);
    return static_cast<std::uint32_t>(result.radiance.s[3]);
}

void Megakernel::store_in_cache()
{
    path_program_.store_in_cache();
    film_program_.store_in_cache();
}
} // namespace etendue
