/* Pinhole camera. The direction through film position (x, y) in [0,1]^2, y down from the top, is
 * forward + (2x - 1) right + (1 - 2y) up, where right and up are already scaled to half the extent of the image. */
#ifndef SHARED_CAMERA_H
#define SHARED_CAMERA_H
#include "shared/real.h"

typedef struct Camera {
    real4 position; /* w = 0 */
    real4 forward;  /* unit */
    real4 right;
    real4 up;
} Camera;
#endif
