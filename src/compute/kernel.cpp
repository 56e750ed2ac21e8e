// Sets arguments, enqueues and counts.
#include "compute/kernel.h"

#include "util/stopwatch.h"

#include <fmt/format.h>

namespace etendue
{
namespace
{
// Translate what `call` throws into a DeviceError that names device and kernel.
template<typename Call>
auto named(const Device& device, const std::string& kernel, Call&& call)
{
    try {
        return call();
    } catch (const cl::Error& e) {
        throw_device_error(fmt::format("{}, kernel {}", device.info().name, kernel), e);
    }
}
} // namespace

Kernel::Kernel(const Program& program, const std::string& name) : device_(&program.device()), name_(name)
{
    kernel_ = named(*device_, name_, [&] { return cl::Kernel(program.handle(), name.c_str()); });
}

void Kernel::set_memory(cl_uint index, const cl::Buffer& buffer)
{
    const cl_mem memory = buffer();
    set_bytes(index, sizeof(cl_mem), &memory);
}

void Kernel::set_bytes(cl_uint index, std::size_t size, const void* data)
{
    named(*device_, fmt::format("{}, argument {}", name_, index), [&] { return kernel_.setArg(index, size, data); });
}

void Kernel::enqueue(std::size_t global_size, std::size_t local_size)
{
    if (global_size == 0) return;
    const cl::NDRange local = local_size ? cl::NDRange(local_size) : cl::NullRange;
    named(*device_, name_, [&] {
        return device_->queue().enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(global_size), local, nullptr,
                                                     &last_launch_);
    });
    count_launch(device_->info().name, name_);
}

double Kernel::last_launch_seconds() const
{
    if (last_launch_() == nullptr) return 0.0;
    try {
        const cl_ulong begin = last_launch_.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        const cl_ulong end = last_launch_.getProfilingInfo<CL_PROFILING_COMMAND_END>();
        return end > begin ? static_cast<double>(end - begin) * 1e-9 : 0.0;
    } catch (const cl::Error&) {
        return 0.0;
    }
}

double Kernel::enqueue_and_wait(std::size_t global_size, std::size_t local_size)
{
    const Stopwatch stopwatch;
    enqueue(global_size, local_size);
    named(*device_, name_, [&] { return device_->queue().finish(); });
    return stopwatch.seconds();
}
} // namespace etendue
