// Random numbers, and the maps that turn them into shapes, directions and choices.
#pragma once

#include "check/check.h"

#include <vector>

namespace etendue
{
std::vector<Check> sampling_checks();

// Its part about the evenness of samplers.
std::vector<Check> sampler_checks();
} // namespace etendue
