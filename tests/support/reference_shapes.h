// A scene as a plain list of shapes in world space and double precision, for the reference tracer.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace etendue
{
struct ReferenceShape {
    enum class Kind { triangle, disk, sphere } kind;
    const ShapeDescription* description; // material and emission
    Vec3 a{0.0};                         // vertex of the triangle, or centre
    Vec3 edge1{0.0}, edge2{0.0};         // of the triangle, from a
    Vec3 normal{0.0};                    // unit, out of the surface; not of a sphere
    double radius = 0.0;
    double area = 0.0;

    // Unit normal at a point of the shape, out of the surface.
    Vec3 normal_at(const Vec3& p) const;
    // Radiance towards a direction at this cosine to the normal.
    Vec3 emitted(double cosine) const;
    // A point of the shape, uniform by area for u uniform in [0, 1)^2.
    Vec3 sample_point(const Vec2& u) const;
    // Distance along a unit direction, for a sphere the first over `least`; infinity or NaN where there is none.
    double intersect(const Vec3& origin, const Vec3& direction, double least) const;
};

// A point of the unit sphere, uniform by area.
Vec3 unit_sphere_point(const Vec2& u);

// Flatten a scene, which must outlive the list. Throws FileError for a mesh that cannot be read.
std::vector<ReferenceShape> make_reference_shapes(const Scene& scene);
} // namespace etendue
