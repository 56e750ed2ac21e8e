/* The scalar of every shared struct: float, or double in the fp64 twin (-DREAL_IS_DOUBLE=1). */
#pragma once

#ifndef __cplusplus
#ifndef REAL_IS_DOUBLE
#define REAL_IS_DOUBLE 0
#endif
#if REAL_IS_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double real;
typedef double4 real4;
#else
typedef float real;
typedef float4 real4;
#endif
#endif
