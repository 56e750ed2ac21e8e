// A report of how one driver conforms: floating point, functions, sort and tree, closed meshes, committed bits, speed.
#pragma once

#include "check/check.h"

#include <vector>

namespace etendue
{
std::vector<Check> device_checks();

// Parts of device_checks(): the accuracy of functions, and bits that no device may change.
std::vector<Check> accuracy_checks();
std::vector<Check> bits_checks();
} // namespace etendue
