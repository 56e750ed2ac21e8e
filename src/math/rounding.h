// Rounding to float.
#pragma once

namespace etendue
{
// Half the distance from 1 to the next float.
inline constexpr double FLOAT_ROUNDING = 0x1p-24;

// What float arithmetic along a path, and sums of a film in another order, may add to a mean, in roundings.
inline constexpr double MEAN_ROUNDINGS = 16.0;

// A double as float holds it.
// volatile: with -O2 g++ 12 takes vectors of doubles that are converted to float and back for unchanged.
inline double rounded_to_float(double x)
{
    const volatile float rounded = static_cast<float>(x);
    return static_cast<double>(rounded);
}
} // namespace etendue
