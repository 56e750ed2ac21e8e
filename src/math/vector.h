// The vector types of the host: double precision everywhere that a scene is read, placed and measured.
#pragma once

#include <glm/glm.hpp>

namespace etendue
{
using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;
using Mat4 = glm::dmat4;
} // namespace etendue
