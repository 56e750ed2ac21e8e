/* Perspective camera without a lens. */
#pragma once
#include "geometry/ray.h"
#include "shared/camera.h"

/* Ray through film position (x, y), in pixels from the top left corner; unit direction. */
STATIC Ray pinhole_ray(global const Camera* camera, Float x, Float y, uint width, uint height)
{
    Float right = 2.0 * x / (Float)((real)width) - 1.0;
    Float up = 1.0 - 2.0 * y / (Float)((real)height);
    Vec3 direction =
        fma3(broadcast3(camera->right), right, fma3(broadcast3(camera->up), up, broadcast3(camera->forward)));
    Ray ray;
    ray.origin = broadcast3(camera->position);
    ray.direction = normalize3(direction);
    ray.t_max = (Float)(INFINITE);
    ray.from = (Uint)(NO_INDEX);
    ray.to = (Uint)(NO_INDEX);
    return ray;
}
