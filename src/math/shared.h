// The structs of cl/shared as the host sees them: in namespace etendue with float reals, and once more in
// etendue::fp64 with double ones.
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

namespace fp64
{
using real = cl_double;
using real4 = cl_double4;
#include "shared/again.h"
#include "shared/structs.h"

// A file whose guard is not forgotten would leave its structs out.
#define FP64_STRUCT_EXISTS(name) static_assert(sizeof(fp64::name) >= sizeof(etendue::name));
SHARED_STRUCTS(FP64_STRUCT_EXISTS)
#undef FP64_STRUCT_EXISTS
} // namespace fp64
} // namespace etendue
