// A device opened for work, and the ledger of the memory that its buffers take.
#include "compute/device.h"

#include <algorithm>
#include <map>
#include <mutex>

#include <fmt/format.h>

namespace etendue
{
struct DeviceMemoryLedger {
    std::mutex mutex;
    Device::Memory memory;
};

namespace
{
cl::Device find_device(const DeviceInfo& info)
{
    std::vector<cl::Platform> platforms;
    cl::Platform::get(&platforms);
    std::vector<cl::Device> devices;
    if (info.platform_index < platforms.size()) platforms[info.platform_index].getDevices(CL_DEVICE_TYPE_ALL, &devices);
    if (info.device_index >= devices.size())
        throw DeviceError(fmt::format("{}: the device is not there any more.", info.name));
    return devices[info.device_index];
}

// A sub-device of `threads` compute units; the device itself when that is all of them.
cl::Device restrict_threads(const cl::Device& device, const DeviceInfo& info, std::uint32_t threads)
{
    if (threads == info.compute_units) return device;
    if (threads > info.compute_units)
        throw DeviceError(fmt::format("{}: {} threads were asked for, but the device has {} compute units.", info.name,
                                      threads, info.compute_units));
    const auto kinds = device.getInfo<CL_DEVICE_PARTITION_PROPERTIES>();
    if (std::find(kinds.begin(), kinds.end(), CL_DEVICE_PARTITION_BY_COUNTS) == kinds.end())
        throw DeviceError(fmt::format("{}: this device cannot be restricted to a number of threads.", info.name));
    const cl_device_partition_property properties[] = {CL_DEVICE_PARTITION_BY_COUNTS,
                                                       static_cast<cl_device_partition_property>(threads),
                                                       CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
    std::vector<cl::Device> parts;
    cl::Device(device).createSubDevices(properties, &parts);
    return parts.at(0);
}

// One context for each whole device of the process, so that programs can be used again. It is never released: drivers
// are unloaded in an order of their own.
cl::Context shared_context(const cl::Device& device)
{
    static std::mutex mutex;
    static auto& contexts = *new std::map<cl_device_id, cl::Context>;
    const std::lock_guard lock(mutex);
    const auto found = contexts.find(device());
    return found != contexts.end() ? found->second : contexts.emplace(device(), cl::Context(device)).first->second;
}
} // namespace

Device::Device(const DeviceInfo& info, std::uint32_t threads)
    : info_(info), ledger_(std::make_shared<DeviceMemoryLedger>())
{
    try {
        handle_ = find_device(info);
        if (threads > 0) handle_ = restrict_threads(handle_, info, threads);
        compute_units_ = handle_.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
        // A part of a device is no longer there when it is released.
        context_ = threads > 0 ? cl::Context(handle_) : shared_context(handle_);
        queue_ = cl::CommandQueue(context_, handle_, CL_QUEUE_PROFILING_ENABLE);
    } catch (const cl::Error& e) {
        throw_device_error(info.name, e);
    }
}

std::uint32_t Device::preferred_lanes() const
{
    if (!is_cpu()) return 1;
    for (const std::uint32_t lanes : {16u, 8u, 4u})
        if (info_.native_float_width >= lanes) return lanes;
    return 1;
}

void Device::require_double() const
{
    if (info_.has_double) return;
    throw DeviceError(fmt::format("{}: this device has no double precision (cl_khr_fp64), which fp64 needs; `etendue "
                                  "devices` tells which devices have it.",
                                  info_.name));
}

void Device::finish() const
{
    try {
        queue_.finish();
    } catch (const cl::Error& e) {
        throw_device_error(info_.name, e);
    }
}

void Device::check_allocation(const std::string& what, std::uint64_t bytes) const
{
    if (bytes > info_.max_allocation)
        throw DeviceError(fmt::format("{}: the buffer \"{}\" needs {} bytes, but the largest buffer that the device "
                                      "allows is {} bytes.",
                                      info_.name, what, bytes, info_.max_allocation));
    const std::lock_guard lock(ledger_->mutex);
    const std::uint64_t used = ledger_->memory.current;
    if (used > info_.global_memory || bytes > info_.global_memory - used)
        throw DeviceError(fmt::format("{}: the buffer \"{}\" needs {} bytes, but of the device's {} bytes of memory "
                                      "{} are taken by other buffers.",
                                      info_.name, what, bytes, info_.global_memory, used));
}

void Device::note_allocation(const std::string& what, std::uint64_t bytes) const
{
    const std::lock_guard lock(ledger_->mutex);
    Memory& memory = ledger_->memory;
    memory.current += bytes;
    memory.peak = std::max(memory.peak, memory.current);
    memory.buffers.emplace_back(what, bytes);
}

void Device::note_release(std::uint64_t bytes) const
{
    const std::lock_guard lock(ledger_->mutex);
    ledger_->memory.current -= bytes;
}

Device::Memory Device::memory() const
{
    const std::lock_guard lock(ledger_->mutex);
    return ledger_->memory;
}
} // namespace etendue
