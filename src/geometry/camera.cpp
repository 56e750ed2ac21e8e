// The frame of a pinhole camera.
#include "geometry/camera.h"

#include "math/transform.h"

#include <cmath>

namespace etendue
{
namespace
{
// The sine of the angle between up and the view below which the camera's roll would be rounding errors of a scene file.
constexpr double PARALLEL_SINE = 1e-9;

real4 to_real4(const Vec3& v, const SourceLocation& where)
{
    const real4 rounded = make_real4(v.x, v.y, v.z);
    if (!std::isfinite(rounded.s[0]) || !std::isfinite(rounded.s[1]) || !std::isfinite(rounded.s[2]))
        throw SceneError(where, "the camera is too far away from the geometry, or its angle is too wide.");
    return rounded;
}
} // namespace

Camera make_camera(const CameraDescription& camera, int width, int height, const Normalisation& normalisation)
{
    const Vec3 forward = unit_or_zero(camera.look_at - camera.position);
    if (forward == Vec3(0.0)) throw SceneError(camera.location, "the camera looks at its own position.");
    const Vec3 sideways = glm::cross(forward, unit_or_zero(camera.up));
    if (!(glm::length(sideways) > PARALLEL_SINE))
        throw SceneError(camera.location, "the camera's up vector is zero or parallel to its view direction.");

    const Vec3 right = glm::normalize(sideways);
    const Vec3 up = glm::cross(right, forward);
    const double half_height = std::tan(glm::radians(camera.vertical_fov) / 2.0) * camera.focal_length;
    const double half_width = half_height * width / height;
    const Vec3 position = (camera.position - normalisation.centre) * normalisation.scale;
    return {to_real4(position, camera.location), to_real4(forward, camera.location),
            to_real4(right * half_width, camera.location), to_real4(up * half_height, camera.location)};
}
} // namespace etendue
