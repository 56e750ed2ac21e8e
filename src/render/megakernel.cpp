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

// Launches take and give sums in the precision of their buffers, the film's are in float.
template<typename Block>
void write_sums(Buffer<Block>& buffer, const std::vector<Block>& sums)
{
    buffer.write(sums);
}
template<typename Wide, typename Block>
void write_sums(Buffer<Wide>& buffer, const std::vector<Block>& sums)
{
    buffer.write(widen(sums));
}
template<typename Block>
void read_sums(const Buffer<Block>& buffer, std::vector<Block>& sums)
{
    buffer.read(sums.data(), sums.size());
}
template<typename Wide, typename Block>
void read_sums(const Buffer<Wide>& buffer, std::vector<Block>& sums)
{
    std::vector<Wide> wide(sums.size());
    buffer.read(wide.data(), wide.size());
    sums = narrow(wide);
}

std::string joined(const std::string& options, const std::string& more)
{
    return more.empty() ? options : options + ' ' + more;
}
} // namespace

template<typename Reals>
Megakernel::LaunchBuffers<Reals> Megakernel::make_buffers(const Device& device, std::size_t count, bool has_aov)
{
    LaunchBuffers<Reals> buffers;
    buffers.results = {device, "sample results", count};
    buffers.blocks = {device, "pixel sums", count};
    if (!has_aov) return buffers;
    buffers.sample_aovs = {device, "sample AOVs", count};
    buffers.block_aovs = {device, "pixel AOVs", count};
    return buffers;
}

Megakernel::Megakernel(const Device& device, bool normals, const Specialization& specialization,
                       const KernelCache& cache, const LaunchShape& shape, const std::string& path_options)
    : device_(&device), specialization_(specialization), shape_(complete_shape(shape, device, specialization)),
      path_program_(device, normals ? "normals.cl" : "path_megakernel.cl",
                    joined(specialization.build_options(), path_options), cache),
      film_program_(device, "film.cl",
                    film_features(specialization.has(Feature::AOV), specialization.precision).build_options(), cache),
      path_kernel_(path_program_, normals ? "normals" : "path_megakernel"),
      film_kernel_(film_program_, "film_accumulate"), counters_(device, "counters", 1)
{
    const bool has_aov = specialization.has(Feature::AOV);
    if (specialization.precision == Precision::fp64)
        buffers_ = make_buffers<DoubleReals>(device, shape_.max_samples, has_aov);
    else
        buffers_ = make_buffers<SingleReals>(device, shape_.max_samples, has_aov);
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
    std::visit(
        [&](auto& b) {
            write_sums(b.blocks, blocks);
            write_sums(b.block_aovs, aovs);
            scene.launch(path_kernel_, round_up(items), shape_.local_size, unit, b.results, b.sample_aovs, counters_);
            film_kernel_.launch(pixels, 0, unit, b.results, b.sample_aovs, b.blocks, b.block_aovs, counters_);
            read_sums(b.blocks, blocks);
            read_sums(b.block_aovs, aovs);
        },
        buffers_);
    counters_.read(&counters, 1);
    return counters;
}

std::uint32_t Megakernel::accident_code(std::uint32_t flat_index) const
{
    return std::visit(
        [&]<typename Reals>(const LaunchBuffers<Reals>& b) {
            typename Reals::Result result;
            b.results.read(&result, 1, flat_index);
            return static_cast<std::uint32_t>(result.radiance.s[3]);
        },
        buffers_);
}

void Megakernel::store_in_cache()
{
    path_program_.store_in_cache();
    film_program_.store_in_cache();
}
} // namespace etendue
