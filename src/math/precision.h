// The reals that kernels count in.
#pragma once

namespace etendue
{
// fp64 is the twin of single: the same kernels, scene and random numbers with double in place of float.
enum class Precision { single, fp64 };

inline const char* precision_name(Precision precision)
{
    return precision == Precision::fp64 ? "fp64" : "single";
}
} // namespace etendue
