// Hands out the work: passes over the whole picture, cut into units for whichever device is idle.
#pragma once

#include "math/shared.h"
#include "render/film.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>

namespace etendue
{
// One pass: the same samples of every pixel, within one block of SAMPLES_PER_BLOCK.
struct Pass {
    std::uint64_t first_sample = 0;
    std::uint32_t sample_count = 0;
};

// The next pass after `done` samples of `total`: 1, 1, 2, 4, ... samples up to the first block, then block by block, so
// that a first picture is there early and few passes are needed later.
Pass next_pass(std::uint64_t done, std::uint64_t total);

// The units of one pass. Thread-safe.
class Schedule
{
public:
    // So many devices share the pass: there is a unit for each where there are pixels enough.
    Schedule(const PixelRect& crop, const Pass& pass, std::size_t devices = 1);

    // Whole rows, or a part of one, of at most max_samples samples (of one pixel at least); nothing when the pass is
    // handed out. pool_size is left 0.
    std::optional<WorkUnit> next(std::uint32_t max_samples);

    // Give up the rest.
    void cancel();

private:
    std::mutex mutex_;
    PixelRect crop_;
    Pass pass_;
    std::uint64_t pixels_, largest_unit_; // of the crop, and of a unit
    std::uint64_t next_pixel_ = 0;        // row by row within the crop
};
} // namespace etendue
