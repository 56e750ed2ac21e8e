// Asks every OpenCL platform for its devices; whatever is broken becomes a warning.
#include "compute/device.h"
#include "compute/driver_files.h"

#include <fmt/format.h>

namespace etendue
{
namespace
{
std::string type_name(cl_device_type type)
{
    if (type & CL_DEVICE_TYPE_CPU) return "cpu";
    if (type & CL_DEVICE_TYPE_GPU) return "gpu";
    if (type & CL_DEVICE_TYPE_ACCELERATOR) return "accelerator";
    return "other";
}

// What the device says about itself; throws cl::Error when it does not answer.
DeviceInfo describe(const cl::Platform& platform, const cl::Device& device)
{
    DeviceInfo info;
    info.platform_name = platform.getInfo<CL_PLATFORM_NAME>();
    info.platform_vendor = platform.getInfo<CL_PLATFORM_VENDOR>();
    info.platform_version = platform.getInfo<CL_PLATFORM_VERSION>();
    info.name = device.getInfo<CL_DEVICE_NAME>();
    info.vendor = device.getInfo<CL_DEVICE_VENDOR>();
    info.driver_version = device.getInfo<CL_DRIVER_VERSION>();
    info.device_version = device.getInfo<CL_DEVICE_VERSION>();
    info.opencl_c_version = device.getInfo<CL_DEVICE_OPENCL_C_VERSION>();
    info.type = type_name(device.getInfo<CL_DEVICE_TYPE>());
    info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    info.native_float_width = device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>();
    info.global_memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.max_allocation = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    info.local_memory = device.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
    info.constant_memory = device.getInfo<CL_DEVICE_MAX_CONSTANT_BUFFER_SIZE>();
    info.max_work_group_size = device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    info.max_clock_mhz = device.getInfo<CL_DEVICE_MAX_CLOCK_FREQUENCY>();
    info.extensions = device.getInfo<CL_DEVICE_EXTENSIONS>();
    info.has_double = info.extensions.find("cl_khr_fp64") != std::string::npos;
    info.correctly_rounded_divide =
        (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    info.available = device.getInfo<CL_DEVICE_AVAILABLE>() == CL_TRUE;
    info.compiler_available = device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>() == CL_TRUE;
    return info;
}

void add_devices(DeviceList& list, const cl::Platform& platform, std::size_t platform_index)
{
    const std::string platform_name = platform.getInfo<CL_PLATFORM_NAME>();
    if (platform_name == "Portable Computing Language")
        if (const std::string warning = ensure_pocl_cache(); !warning.empty()) list.warnings.push_back(warning);

    std::vector<cl::Device> devices;
    platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    if (devices.empty())
        list.warnings.push_back(fmt::format("OpenCL platform {} ({}) has no device.", platform_index, platform_name));

    for (std::size_t i = 0; i < devices.size(); ++i) {
        try {
            DeviceInfo info = describe(platform, devices[i]);
            info.platform_index = platform_index;
            info.device_index = i;
            info.index = list.devices.size();
            list.devices.push_back(info);
        } catch (const cl::Error& e) {
            list.warnings.push_back(fmt::format("Device {} of OpenCL platform {} ({}) is left out: {} failed: {}.", i,
                                                platform_index, platform_name, e.what(), opencl_error_name(e.err())));
        }
    }
}
} // namespace

DeviceList list_devices()
{
    DeviceList list;
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error& e) {
        if (e.err() != CL_PLATFORM_NOT_FOUND_KHR)
            list.warnings.push_back(
                fmt::format("OpenCL does not answer: {} failed: {}.", e.what(), opencl_error_name(e.err())));
    }
    for (std::size_t i = 0; i < platforms.size(); ++i) {
        try {
            add_devices(list, platforms[i], i);
        } catch (const cl::Error& e) {
            list.warnings.push_back(
                fmt::format("OpenCL platform {} is left out: {} failed: {}.", i, e.what(), opencl_error_name(e.err())));
        }
    }
    for (std::string& warning : unloadable_drivers()) list.warnings.push_back(std::move(warning));
    return list;
}
} // namespace etendue
