// OpenCL devices: what there is, which one a user means, and one opened for work. Only src/compute includes
// <CL/opencl.hpp>; cl::Error is translated here and never leaves.
#pragma once

#include "util/error.h"

#include <CL/opencl.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace etendue
{
// One device as it describes itself. Sizes in bytes.
struct DeviceInfo {
    std::size_t platform_index = 0;
    std::size_t device_index = 0; // within the platform
    std::size_t index = 0;        // over all platforms
    std::string platform_name, platform_vendor, platform_version;
    std::string name, vendor, driver_version, device_version, opencl_c_version;
    std::string type; // "cpu", "gpu", "accelerator", "other"
    std::uint32_t compute_units = 0;
    std::uint32_t native_float_width = 1;
    std::uint64_t global_memory = 0, max_allocation = 0, local_memory = 0, constant_memory = 0;
    std::size_t max_work_group_size = 0;
    std::uint32_t max_clock_mhz = 0;
    bool has_double = false;
    bool correctly_rounded_divide = false; // CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT
    bool available = false, compiler_available = false;
    std::string extensions;
};

struct DeviceList {
    std::vector<DeviceInfo> devices;
    std::vector<std::string> warnings; // one sentence per platform without a device, dead driver and so on
};

// Ask every platform. Never throws for a broken driver: that is a warning.
DeviceList list_devices();

// Which devices SPEC means: an index, platform:device, part of a name, cpu, gpu, all, a comma list, or auto (a GPU if
// there is one, else the CPU with most compute units). Each item but `all` is one device: the largest of its type, the
// first of its name; each half of platform:device may be a part of a name too. Throws DeviceError: no usable device
// (with the package to install), or none of that name (with the list of what exists).
std::vector<DeviceInfo> select_devices(const DeviceList& list, const std::string& spec);

// Why select_devices(list, "auto") takes what it takes, as a sentence.
std::string explain_choice(const DeviceList& list);

// A device opened for work: one context and one in-order queue with profiling.
class Device
{
public:
    // threads > 0: a sub-device of that many compute units. Throws DeviceError.
    explicit Device(const DeviceInfo& info, std::uint32_t threads = 0);

    const DeviceInfo& info() const { return info_; }
    std::uint32_t compute_units() const { return compute_units_; } // of the sub-device if there is one
    bool is_cpu() const { return info_.type == "cpu"; }

    // Paths per work-item that suit the device: native float width on a CPU (1, 4, 8 or 16), 1 elsewhere.
    std::uint32_t preferred_lanes() const;

    // Throws DeviceError unless the device knows double precision.
    void require_double() const;

    // The driver keeps compiled kernels itself. PoCL does, and compiles everything again when it is asked for a binary.
    bool caches_kernels() const { return info_.platform_name == "Portable Computing Language"; }

    const cl::Context& context() const { return context_; }
    const cl::CommandQueue& queue() const { return queue_; }
    const cl::Device& handle() const { return handle_; }

    // Wait for everything enqueued. Throws DeviceError.
    void finish() const;

    // Bytes of all Buffers now and at most, and whether a further allocation fits; throws DeviceError with the numbers
    // when `bytes` exceed CL_DEVICE_MAX_MEM_ALLOC_SIZE or what is left of the global memory.
    void check_allocation(const std::string& what, std::uint64_t bytes) const;
    void note_allocation(const std::string& what, std::uint64_t bytes) const;
    void note_release(std::uint64_t bytes) const;
    struct Memory {
        std::uint64_t current = 0, peak = 0;
        std::vector<std::pair<std::string, std::uint64_t>> buffers; // every allocation so far: name, bytes
    };
    Memory memory() const;

private:
    DeviceInfo info_;
    std::uint32_t compute_units_ = 0;
    cl::Device handle_;
    cl::Context context_;
    cl::CommandQueue queue_;
    std::shared_ptr<struct DeviceMemoryLedger> ledger_; // shared, thread-safe
};

// "CL_OUT_OF_RESOURCES" for -5.
const char* opencl_error_name(int code);

// Throw DeviceError "<device>: <call> failed: <error name>", with advice where there is some.
[[noreturn]] void throw_device_error(const std::string& device, const cl::Error& error);
} // namespace etendue
