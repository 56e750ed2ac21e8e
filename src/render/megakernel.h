// One device at work: whole paths in one kernel, then the film's sums.
#pragma once

#include "compute/kernel.h"
#include "compute/specialization.h"
#include "math/shared.h"
#include "render/device_scene.h"
#include "render/precision.h"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace etendue
{
// How a device is given its work. None of it changes a bit of the picture.
struct LaunchShape {
    std::uint32_t max_samples = 1u << 19; // of one launch: the size of the result buffers
    std::uint32_t pool_size = 0;          // samples of one work-item; 0: as suits device and launch
    std::uint32_t local_size = 0;         // 0: 1 on a CPU or with several lanes, 64 on a GPU
};

class Megakernel
{
public:
    // Builds path_megakernel.cl (or normals.cl) with the specialization and further options, and film.cl. The scenes it
    // traces have its precision. Throws BuildError, DeviceError.
    Megakernel(const Device& device, bool normals, const Specialization& specialization, const KernelCache& cache,
               const LaunchShape& shape, const std::string& path_options = "");

    // Trace a unit and add its samples to the blocks of its pixels (row by row; aovs empty without AOVs). Returns the
    // launch's counters. Waits for the end. Throws DeviceError.
    LaunchCounters trace(const DeviceScene& scene, WorkUnit unit, std::vector<PixelBlock>& blocks,
                         std::vector<PixelAov>& aovs);

    // Seconds of the device in the kernels of the last trace, by its own clock.
    double kernel_seconds() const { return path_kernel_.last_launch_seconds() + film_kernel_.last_launch_seconds(); }

    // The accident code of the sample with this flat index in the last launch (see cl/shared/work.h).
    std::uint32_t accident_code(std::uint32_t flat_index) const;

    const Specialization& specialization() const { return specialization_; }
    const LaunchShape& shape() const { return shape_; }
    const BuildReport& path_report() const { return path_program_.report(); }
    const BuildReport& film_report() const { return film_program_.report(); }
    void store_in_cache();

private:
    // What a launch writes.
    template<typename Reals>
    struct LaunchBuffers {
        Buffer<typename Reals::Result> results;
        Buffer<typename Reals::ResultAov> sample_aovs;
        Buffer<typename Reals::Block> blocks;
        Buffer<typename Reals::BlockAov> block_aovs;
    };
    template<typename Reals>
    static LaunchBuffers<Reals> make_buffers(const Device& device, std::size_t count, bool has_aov);
    std::uint32_t pool_size(std::uint64_t samples) const;

    const Device* device_;
    Specialization specialization_;
    LaunchShape shape_;
    Program path_program_, film_program_;
    Kernel path_kernel_, film_kernel_;
    std::variant<LaunchBuffers<SingleReals>, LaunchBuffers<DoubleReals>> buffers_;
    Buffer<LaunchCounters> counters_;
};
} // namespace etendue
