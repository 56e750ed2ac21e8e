// Random numbers, and the maps that turn them into shapes, directions and choices.
#pragma once

#include "check/check.h"

#include <cstdint>
#include <vector>

namespace etendue
{
std::vector<Check> sampling_checks();

// The samples whose places in the sequence of a replicate are 0, 1, ..., count - 1.
std::vector<std::uint32_t> samples_of_replicate(std::uint32_t replicate, std::uint32_t replicates, std::uint32_t count);

// Its part about the evenness of samplers.
std::vector<Check> sampler_checks();
} // namespace etendue
