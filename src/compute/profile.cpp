// Counts launches by device and kernel.
#include "compute/profile.h"

#include <mutex>

namespace etendue
{
namespace
{
struct LaunchCounts {
    std::mutex mutex;
    std::map<std::string, std::map<std::string, std::uint64_t>> by_device;
};

LaunchCounts& launch_counts()
{
    static LaunchCounts counts;
    return counts;
}
} // namespace

void count_launch(const std::string& device, const std::string& kernel)
{
    LaunchCounts& counts = launch_counts();
    const std::lock_guard lock(counts.mutex);
    ++counts.by_device[device][kernel];
}

std::map<std::string, std::map<std::string, std::uint64_t>> launches()
{
    LaunchCounts& counts = launch_counts();
    const std::lock_guard lock(counts.mutex);
    return counts.by_device;
}
} // namespace etendue
