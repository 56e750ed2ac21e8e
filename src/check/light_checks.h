// What lights of every kind have to satisfy: samples lie on them with the density and the radiance that a ray to them
// finds; densities integrate to 1 and one over them to the solid angle; chi-square; dark from behind and in their
// plane; solid angles from 1e-12 to all directions.
#pragma once

#include "check/check.h"

#include <vector>

namespace etendue
{
std::vector<Check> light_checks();
} // namespace etendue
