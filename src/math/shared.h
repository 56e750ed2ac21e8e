// The structs of cl/shared as the host sees them, in namespace etendue.
#pragma once

#include <CL/cl_platform.h>

namespace etendue
{
using uint = cl_uint;
using uint4 = cl_uint4;
using real = cl_float;
using real4 = cl_float4;
#include "shared/structs.h"

inline real4 make_real4(double x, double y, double z, double w = 0.0)
{
    return {{static_cast<real>(x), static_cast<real>(y), static_cast<real>(z), static_cast<real>(w)}};
}
} // namespace etendue
