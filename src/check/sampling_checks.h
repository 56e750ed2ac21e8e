// Random numbers, and the maps that turn them into shapes, directions and choices.
#pragma once

#include "check/check.h"

#include <vector>

namespace etendue
{
std::vector<Check> sampling_checks();
} // namespace etendue
