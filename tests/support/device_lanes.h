// A device function at every number of lanes: the bits must be those of one lane.
#pragma once

#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace etendue
{
// The results with one lane, checked against 4, 8 and 16.
inline DeviceResults evaluate_in_all_lanes(const DeviceFunctions& functions, const Device& device,
                                           const std::string& name, const std::vector<DeviceArgument>& arguments)
{
    const DeviceResults scalar = functions.evaluate(device, name, arguments, 1);
    for (const std::uint32_t lanes : LANE_COUNTS) {
        const bool same_bits = functions.evaluate(device, name, arguments, lanes).outputs == scalar.outputs;
        CAPTURE(device.info().name, name, lanes);
        CHECK(same_bits);
    }
    return scalar;
}
} // namespace etendue
