// The names of OpenCL's error codes, and what a person can do about some of them.
#include "compute/device.h"

#include <fmt/format.h>

namespace etendue
{
const char* opencl_error_name(int code)
{
    switch (code) {
#define NAME_OF(value, name)                                                                                           \
    case value:                                                                                                        \
        return #name
        NAME_OF(0, CL_SUCCESS);
        NAME_OF(-1, CL_DEVICE_NOT_FOUND);
        NAME_OF(-2, CL_DEVICE_NOT_AVAILABLE);
        NAME_OF(-3, CL_COMPILER_NOT_AVAILABLE);
        NAME_OF(-4, CL_MEM_OBJECT_ALLOCATION_FAILURE);
        NAME_OF(-5, CL_OUT_OF_RESOURCES);
        NAME_OF(-6, CL_OUT_OF_HOST_MEMORY);
        NAME_OF(-7, CL_PROFILING_INFO_NOT_AVAILABLE);
        NAME_OF(-8, CL_MEM_COPY_OVERLAP);
        NAME_OF(-9, CL_IMAGE_FORMAT_MISMATCH);
        NAME_OF(-10, CL_IMAGE_FORMAT_NOT_SUPPORTED);
        NAME_OF(-11, CL_BUILD_PROGRAM_FAILURE);
        NAME_OF(-12, CL_MAP_FAILURE);
        NAME_OF(-13, CL_MISALIGNED_SUB_BUFFER_OFFSET);
        NAME_OF(-14, CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST);
        NAME_OF(-15, CL_COMPILE_PROGRAM_FAILURE);
        NAME_OF(-16, CL_LINKER_NOT_AVAILABLE);
        NAME_OF(-17, CL_LINK_PROGRAM_FAILURE);
        NAME_OF(-18, CL_DEVICE_PARTITION_FAILED);
        NAME_OF(-19, CL_KERNEL_ARG_INFO_NOT_AVAILABLE);
        NAME_OF(-30, CL_INVALID_VALUE);
        NAME_OF(-31, CL_INVALID_DEVICE_TYPE);
        NAME_OF(-32, CL_INVALID_PLATFORM);
        NAME_OF(-33, CL_INVALID_DEVICE);
        NAME_OF(-34, CL_INVALID_CONTEXT);
        NAME_OF(-35, CL_INVALID_QUEUE_PROPERTIES);
        NAME_OF(-36, CL_INVALID_COMMAND_QUEUE);
        NAME_OF(-37, CL_INVALID_HOST_PTR);
        NAME_OF(-38, CL_INVALID_MEM_OBJECT);
        NAME_OF(-39, CL_INVALID_IMAGE_FORMAT_DESCRIPTOR);
        NAME_OF(-40, CL_INVALID_IMAGE_SIZE);
        NAME_OF(-41, CL_INVALID_SAMPLER);
        NAME_OF(-42, CL_INVALID_BINARY);
        NAME_OF(-43, CL_INVALID_BUILD_OPTIONS);
        NAME_OF(-44, CL_INVALID_PROGRAM);
        NAME_OF(-45, CL_INVALID_PROGRAM_EXECUTABLE);
        NAME_OF(-46, CL_INVALID_KERNEL_NAME);
        NAME_OF(-47, CL_INVALID_KERNEL_DEFINITION);
        NAME_OF(-48, CL_INVALID_KERNEL);
        NAME_OF(-49, CL_INVALID_ARG_INDEX);
        NAME_OF(-50, CL_INVALID_ARG_VALUE);
        NAME_OF(-51, CL_INVALID_ARG_SIZE);
        NAME_OF(-52, CL_INVALID_KERNEL_ARGS);
        NAME_OF(-53, CL_INVALID_WORK_DIMENSION);
        NAME_OF(-54, CL_INVALID_WORK_GROUP_SIZE);
        NAME_OF(-55, CL_INVALID_WORK_ITEM_SIZE);
        NAME_OF(-56, CL_INVALID_GLOBAL_OFFSET);
        NAME_OF(-57, CL_INVALID_EVENT_WAIT_LIST);
        NAME_OF(-58, CL_INVALID_EVENT);
        NAME_OF(-59, CL_INVALID_OPERATION);
        NAME_OF(-60, CL_INVALID_GL_OBJECT);
        NAME_OF(-61, CL_INVALID_BUFFER_SIZE);
        NAME_OF(-62, CL_INVALID_MIP_LEVEL);
        NAME_OF(-63, CL_INVALID_GLOBAL_WORK_SIZE);
        NAME_OF(-64, CL_INVALID_PROPERTY);
        NAME_OF(-65, CL_INVALID_IMAGE_DESCRIPTOR);
        NAME_OF(-66, CL_INVALID_COMPILER_OPTIONS);
        NAME_OF(-67, CL_INVALID_LINKER_OPTIONS);
        NAME_OF(-68, CL_INVALID_DEVICE_PARTITION_COUNT);
        NAME_OF(-69, CL_INVALID_PIPE_SIZE);
        NAME_OF(-70, CL_INVALID_DEVICE_QUEUE);
        NAME_OF(-71, CL_INVALID_SPEC_ID);
        NAME_OF(-72, CL_MAX_SIZE_RESTRICTION_EXCEEDED);
        NAME_OF(-1001, CL_PLATFORM_NOT_FOUND_KHR);
#undef NAME_OF
    default:
        return "an error that OpenCL does not define";
    }
}

namespace
{
const char* advice(int code)
{
    switch (code) {
    case CL_OUT_OF_RESOURCES:
        return " The driver may have stopped a launch that took too long, or the device is out of memory: try a "
               "smaller "
               "picture, or another device with --device.";
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
    case CL_OUT_OF_HOST_MEMORY:
        return " There is not enough memory: try a smaller scene or picture, or another device with --device.";
    case CL_DEVICE_NOT_AVAILABLE:
        return " Another program may be using the device.";
    default:
        return "";
    }
}
} // namespace

void throw_device_error(const std::string& device, const cl::Error& error)
{
    throw DeviceError(fmt::format("{}: {} failed: {} ({}).{}", device, error.what(), opencl_error_name(error.err()),
                                  error.err(), advice(error.err())));
}
} // namespace etendue
