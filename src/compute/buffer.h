// A typed array on a device.
#pragma once

#include "compute/device.h"

#include <cstring>
#include <string>
#include <vector>

namespace etendue
{
template<typename T>
class Buffer
{
public:
    Buffer() = default; // no buffer: kernels get a null pointer

    // `name` is what messages and the memory report call it. Contents are undefined. A count of 0 gives no buffer.
    Buffer(const Device& device, const std::string& name, std::size_t count) : device_(&device), count_(count)
    {
        if (count == 0) return;
        device.check_allocation(name, bytes());
        try {
            buffer_ = cl::Buffer(device.context(), CL_MEM_READ_WRITE, bytes());
        } catch (const cl::Error& e) {
            throw_device_error(device.info().name, e);
        }
        device.note_allocation(name, bytes());
    }
    Buffer(const Device& device, const std::string& name, const std::vector<T>& data)
        : Buffer(device, name, data.size())
    {
        write(data);
    }
    ~Buffer() { release(); }
    Buffer(Buffer&& other) noexcept { swap(other); }
    Buffer& operator=(Buffer&& other) noexcept
    {
        if (this != &other) {
            release();
            swap(other);
        }
        return *this;
    }
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;

    std::size_t size() const { return count_; }
    std::size_t bytes() const { return count_ * sizeof(T); }
    const cl::Buffer& handle() const { return buffer_; }

    // Blocking copies of `count` elements from `offset` on.
    void write(const T* data, std::size_t count, std::size_t offset = 0)
    {
        if (count == 0) return;
        try {
            device_->queue().enqueueWriteBuffer(buffer_, CL_TRUE, offset * sizeof(T), count * sizeof(T), data);
        } catch (const cl::Error& e) {
            throw_device_error(device_->info().name, e);
        }
    }
    void write(const std::vector<T>& data) { write(data.data(), data.size()); }
    void read(T* data, std::size_t count, std::size_t offset = 0) const
    {
        if (count == 0) return;
        try {
            device_->queue().enqueueReadBuffer(buffer_, CL_TRUE, offset * sizeof(T), count * sizeof(T), data);
        } catch (const cl::Error& e) {
            throw_device_error(device_->info().name, e);
        }
    }
    std::vector<T> read() const
    {
        std::vector<T> data(count_);
        read(data.data(), count_);
        return data;
    }

private:
    void release()
    {
        if (device_ && count_ && buffer_()) device_->note_release(bytes());
        buffer_ = cl::Buffer();
    }
    void swap(Buffer& other) noexcept
    {
        std::swap(device_, other.device_);
        std::swap(count_, other.count_);
        std::swap(buffer_, other.buffer_);
    }

    const Device* device_ = nullptr; // outlives the buffer
    std::size_t count_ = 0;
    cl::Buffer buffer_;
};
} // namespace etendue
