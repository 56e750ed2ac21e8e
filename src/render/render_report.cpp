// Sums over a report.
#include "render/render_report.h"

namespace etendue
{
const char* health_name(std::size_t kind)
{
    static constexpr std::array<const char*, HEALTH_KINDS> names{
        "non_finite_radiance", "negative_radiance", "non_finite_pdf", "negative_pdf",
        "invalid_ray",         "stack_overflow",    "path_too_long"};
    return names.at(kind);
}

std::uint64_t RenderReport::rays() const
{
    return counts[COUNT_CAMERA_RAYS] + counts[COUNT_INDIRECT_RAYS] + counts[COUNT_SHADOW_RAYS];
}

std::uint64_t RenderReport::accidents() const
{
    std::uint64_t sum = 0;
    for (const HealthRecord& record : health) sum += record.count;
    return sum;
}

double RenderReport::busy_lanes() const
{
    if (counts[COUNT_LANE_SLOTS] == 0) return 1.0;
    return static_cast<double>(counts[COUNT_BUSY_LANES]) / static_cast<double>(counts[COUNT_LANE_SLOTS]);
}

double RenderReport::rays_per_second() const
{
    double seconds = render_seconds, share = 1.0;
    const double steady = render_seconds - first_launch_seconds;
    std::uint64_t samples = 0, first_samples = 0;
    for (const DeviceReport& device : devices) {
        samples += device.samples;
        first_samples += device.first_launch_samples;
    }
    // The first launches' rays are taken to be in proportion to their samples.
    if (samples > first_samples && steady > 0.0) {
        seconds = steady;
        share = static_cast<double>(samples - first_samples) / static_cast<double>(samples);
    }
    return seconds > 0.0 ? share * static_cast<double>(rays()) / seconds : 0.0;
}
} // namespace etendue
