// Single lights seen from a point, with their solid angles in closed form.
#pragma once

#include "check/device_lights.h"

#include <string>
#include <vector>

namespace etendue
{
inline const Point LIGHT_RADIANCE{1, 2, 3};

struct LightCase {
    std::string name;
    Primitive primitive;
    Point from{0, 0, 0};
    uint surface_flags = 0;
    enum class Kind {
        plain,
        typical, // looked at most finely
        tiny,    // floats have too few directions towards it for some questions
        lopsided // densities differ so much over it that a mean of them needs more samples than there is time for
    };
    Kind kind = Kind::plain;
    bool by_area = false; // a sphere seen from outside
};

// Triangles, disks and spheres seen from the side that emits: of all sizes and distances, aslant, a sphere from inside.
std::vector<LightCase> light_cases();

Primitive disk_light(const Point& centre, const Point& normal, double radius);
// A triangle in the plane y = height whose geometric normal points down.
Primitive ceiling_light(double height, double size);
Primitive sphere_light(const Point& centre, double radius);

// Only that light.
LightScene light_of(const Primitive& primitive, uint light_flags = 0, uint surface_flags = 0);

// In steradians: Van Oosterom and Strackee 1983 for triangles, a fan of them for a disk.
double solid_angle(const Primitive& primitive, const Point& from);

Point point_of(const real4& v);
} // namespace etendue
