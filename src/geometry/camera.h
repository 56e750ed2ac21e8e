// The camera as the device sees it.
#pragma once

#include "geometry/geometry.h"

namespace etendue
{
// A pinhole camera in normalised coordinates (cl/shared/camera.h) for an image of width x height pixels. Throws
// SceneError at the camera: it looks at its own position, or along its up vector, or a number is not a finite float.
Camera make_camera(const CameraDescription& camera, int width, int height, const Normalisation& normalisation);
} // namespace etendue
