// Passes and units.
#include "render/schedule.h"

#include <algorithm>

namespace etendue
{
Pass next_pass(std::uint64_t done, std::uint64_t total)
{
    const std::uint64_t in_block = done % SAMPLES_PER_BLOCK;
    const std::uint64_t to_border = SAMPLES_PER_BLOCK - in_block;
    const std::uint64_t doubled = done < SAMPLES_PER_BLOCK ? std::max<std::uint64_t>(done, 1) : to_border;
    return {done, static_cast<std::uint32_t>(std::min({doubled, to_border, total - done}))};
}

Schedule::Schedule(const PixelRect& crop, const Pass& pass, std::size_t devices)
    : crop_(crop), pass_(pass),
      pixels_(static_cast<std::uint64_t>(crop.width) * static_cast<std::uint64_t>(crop.height)),
      largest_unit_((pixels_ + devices - 1) / devices)
{
}

std::optional<WorkUnit> Schedule::next(std::uint32_t max_samples)
{
    const std::lock_guard lock(mutex_);
    const auto width = static_cast<std::uint64_t>(crop_.width), height = static_cast<std::uint64_t>(crop_.height);
    if (next_pixel_ >= pixels_) return {};
    const std::uint64_t pixels = std::clamp<std::uint64_t>(max_samples / pass_.sample_count, 1, largest_unit_);
    const std::uint64_t column = next_pixel_ % width, row = next_pixel_ / width;
    WorkUnit unit{};
    if (column == 0 && pixels >= width) {
        unit.tile_width = static_cast<uint>(width);
        unit.tile_height = static_cast<uint>(std::min(pixels / width, height - row));
    } else {
        unit.tile_width = static_cast<uint>(std::min(pixels, width - column));
        unit.tile_height = 1;
    }
    unit.tile_x = static_cast<uint>(static_cast<std::uint64_t>(crop_.x) + column);
    unit.tile_y = static_cast<uint>(static_cast<std::uint64_t>(crop_.y) + row);
    unit.first_sample = static_cast<uint>(pass_.first_sample);
    unit.first_sample_high = static_cast<uint>(pass_.first_sample >> 32);
    unit.sample_count = pass_.sample_count;
    next_pixel_ += std::uint64_t{unit.tile_width} * unit.tile_height;
    return unit;
}

void Schedule::cancel()
{
    const std::lock_guard lock(mutex_);
    next_pixel_ = pixels_;
}
} // namespace etendue
