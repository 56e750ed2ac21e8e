// One kernel of a program, called with its arguments in order. Counts every launch by kernel and device (profile.h).
#pragma once

#include "compute/buffer.h"
#include "compute/profile.h"
#include "compute/program.h"

#include <array>
#include <string>
#include <utility>

namespace etendue
{
// Bytes of local memory, as a kernel argument.
struct LocalMemory {
    std::size_t bytes;
};

class Kernel
{
public:
    Kernel() = default;
    Kernel(const Program& program, const std::string& name);

    // Enqueue over a one-dimensional range; local_size 0 leaves it to the driver and an empty range
    // does nothing. Arguments are Buffers (null pointer when
    // empty), LocalMemory, and plain shared values. Throws DeviceError naming device, kernel and error. Does not wait.
    template<typename... Arguments>
    void launch(std::size_t global_size, std::size_t local_size, const Arguments&... arguments)
    {
        cl_uint index = 0;
        (set(index++, arguments), ...);
        enqueue(global_size, local_size);
    }

    // The same, then wait; returns seconds from enqueue to the end as the host sees them.
    template<typename... Arguments>
    double run(std::size_t global_size, std::size_t local_size, const Arguments&... arguments)
    {
        cl_uint index = 0;
        (set(index++, arguments), ...);
        return enqueue_and_wait(global_size, local_size);
    }

    // Seconds that the device spent in the last launch, by its own clock; 0 where there was none or the driver does not
    // say. Call it when the launch has ended.
    double last_launch_seconds() const;

private:
    template<typename T>
    void set(cl_uint index, const Buffer<T>& buffer)
    {
        set_memory(index, buffer.handle());
    }
    void set(cl_uint index, const LocalMemory& local) { set_bytes(index, local.bytes, nullptr); }
    template<typename T>
    void set(cl_uint index, const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        set_bytes(index, sizeof(T), &value);
    }
    void set_memory(cl_uint index, const cl::Buffer& buffer);
    void set_bytes(cl_uint index, std::size_t size, const void* data);
    void enqueue(std::size_t global_size, std::size_t local_size);
    double enqueue_and_wait(std::size_t global_size, std::size_t local_size);

    const Device* device_ = nullptr;
    std::string name_;
    cl::Kernel kernel_;
    cl::Event last_launch_;
};
} // namespace etendue
