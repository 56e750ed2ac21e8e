// A double as float holds it.
#pragma once

namespace etendue
{
// volatile: with -O2 g++ 12 takes vectors of doubles that are converted to float and back for unchanged.
inline double rounded_to_float(double x)
{
    const volatile float rounded = static_cast<float>(x);
    return static_cast<double>(rounded);
}
} // namespace etendue
