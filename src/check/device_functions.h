// Calls functions of cl/ on a device, for checks and tests of them.
//
//     const DeviceFunctions functions({"sampling/warp.h"}, {
//         {"spacing", "float -> float", "next_float_up(in0) - in0"},
//         {"cosine", "float float -> float float float",
//          "Vec3 w = cosine_hemisphere_sample(in0, in1); out0 = w.x; out1 = w.y; out2 = w.z;"},
//     });
//
//     std::vector<float> spacing = functions.evaluate<float>(device, "spacing", {x});
//
// One such table at the top of a file is one program for all its checks: a program costs PoCL half a second. It is
// built at the first evaluation for a device and a number of lanes, and kept until release_device_functions().
#pragma once

#include "compute/device.h"
#include "compute/specialization.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace etendue
{
// Drop every program that was built. To be called before a device that functions ran on goes, and before main() ends.
void release_device_functions();

// Lanes that kernels are written for.
inline constexpr std::uint32_t LANE_COUNTS[] = {1, 4, 8, 16};

// An argument of a device function: one 32-bit value per element, or an array of structs.
struct DeviceArgument {
    template<typename T>
    DeviceArgument(const std::vector<T>& values) : count(values.size()), words(values.size() * sizeof(T) / 4)
    {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0);
        std::memcpy(words.data(), values.data(), values.size() * sizeof(T));
    }

    std::size_t count;
    std::vector<std::uint32_t> words;
};

// What a function returned, by output and element.
struct DeviceResults {
    // Output i. T is float, or an integer of 32 bits; a mask is 0 or 1.
    template<typename T>
    std::vector<T> get(std::size_t i) const
    {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) == 4);
        std::vector<T> values(outputs.at(i).size());
        std::memcpy(values.data(), outputs[i].data(), values.size() * 4);
        return values;
    }

    std::vector<std::vector<std::uint32_t>> outputs;
};

// OpenCL C in lanes with inputs in0, in1, ... and outputs out0, out1, ...
struct DeviceFunction {
    std::string name;
    // "float uint mask int -> float": types of the inputs and the outputs, Float Uint Mask Int in the body. An input
    // `Light*` is an array that all elements share: `global const Light*`.
    std::string signature;
    // An expression for out0, or statements (if there is a semicolon).
    std::string body;
};

class DeviceFunctions
{
public:
    // `parts` are included in order after math/lanes.h and shared/structs.h. `definitions` is OpenCL C before the
    // functions; `features` is everything unless given (its lanes are ignored). In double precision, which has one
    // lane, values are still passed as float and `real*` is an array of doubles.
    DeviceFunctions(std::vector<std::string> parts, std::vector<DeviceFunction> functions, std::string definitions = "",
                    Specialization features = Specialization::everything(1, 64));
    ~DeviceFunctions();
    DeviceFunctions(const DeviceFunctions&) = delete;
    DeviceFunctions& operator=(const DeviceFunctions&) = delete;

    // Call the function for every element of the inputs. lanes 0: as many as suit the device. Throws BuildError,
    // DeviceError, and std::logic_error for arguments that do not fit the signature.
    DeviceResults evaluate(const Device& device, const std::string& name, const std::vector<DeviceArgument>& arguments,
                           std::uint32_t lanes = 0) const;

    // The same; output 0 only.
    template<typename T>
    std::vector<T> evaluate(const Device& device, const std::string& name, const std::vector<DeviceArgument>& arguments,
                            std::uint32_t lanes = 0) const
    {
        return evaluate(device, name, arguments, lanes).template get<T>(0);
    }

    // The program's text.
    std::string source() const;

private:
    std::vector<std::string> parts_;
    std::vector<DeviceFunction> functions_;
    std::string definitions_;
    Specialization features_;
};
} // namespace etendue
