// Unit vectors as device functions take and return them.
#pragma once

#include <array>

namespace etendue
{
using Direction = std::array<float, 3>;
} // namespace etendue
