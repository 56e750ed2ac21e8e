// Form factors in closed form and double precision: the share F of the light leaving a small patch by Lambert's law
// that reaches a shape. A patch of albedo rho that sees a shape of uniform radiance L, and nothing else that is bright,
// has the radiance rho L F, so these are exact pictures of diffuse surfaces under area lights.
#pragma once

#include "math/vector.h"

#include <vector>

namespace etendue
{
// A flat or spatial polygon seen from point p with unit normal n, in any orientation; the part below the horizon is cut
// off. Lambert's formula, J. H. Lambert, Photometria (1760); see also J. Arvo, Analytic Methods (1995), section 2.
double polygon_form_factor(const Vec3& p, const Vec3& n, const std::vector<Vec3>& vertices);

// A rectangle a x b parallel to the patch at distance c, one corner straight above it.
double parallel_rectangle_form_factor(double a, double b, double c);

// A rectangle perpendicular to the patch's plane and touching it along its edge b: height a along the patch's normal,
// distance c, one corner straight in front of the patch.
double perpendicular_rectangle_form_factor(double a, double b, double c);

// A disk parallel to the patch at height h, its axis at distance offset from the patch.
double disk_form_factor(double radius, double h, double offset);

// A sphere whose centre is at distance > radius from the patch, theta radians off its normal; cut at the horizon.
double sphere_form_factor(double radius, double distance, double theta);
} // namespace etendue
