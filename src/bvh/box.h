// The padded box of one primitive, on the host.
#pragma once

#include "math/shared.h"

#include <array>
#include <limits>

namespace etendue
{
// An axis-aligned box in the precision of the device; by default the box of nothing, which changes no union.
struct Box {
    std::array<float, 3> lower{INFINITE, INFINITE, INFINITE};
    std::array<float, 3> upper{-INFINITE, -INFINITE, -INFINITE};

    bool empty() const { return lower[0] > upper[0]; }
    void extend(const Box& other);
    std::array<float, 3> centre() const;

    // Half the surface area; 0 for the box of nothing.
    float half_area() const;

    static constexpr float INFINITE = std::numeric_limits<float>::infinity();
};

// PRIMITIVE_*, whatever number is stored.
uint primitive_kind(const Primitive& primitive);

// The box of a primitive pushed outwards: a triangle's by eight units in the last place of its largest |coordinate|, a
// sphere's or disk's (the box of the sphere around it) by eight units of that or of 1, whichever is more. The
// derivation is in cl/bvh/primitive_box.h. The box of nothing when anything in it is not finite.
Box primitive_box(const Primitive& primitive);
} // namespace etendue
