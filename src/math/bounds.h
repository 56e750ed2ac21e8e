// An axis-aligned box in double precision.
#pragma once

#include "math/vector.h"

#include <limits>

namespace etendue
{
struct Bounds {
    Vec3 lower{std::numeric_limits<double>::infinity()};
    Vec3 upper{-std::numeric_limits<double>::infinity()};

    void extend(const Vec3& p)
    {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    void extend(const Bounds& b)
    {
        lower = glm::min(lower, b.lower);
        upper = glm::max(upper, b.upper);
    }
    bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
    Vec3 centre() const { return (lower + upper) * 0.5; }
    Vec3 extent() const { return upper - lower; }
};
} // namespace etendue
