/* One launch: the same samples of every pixel of a tile, and what comes back. */
#ifndef SHARED_WORK_H
#define SHARED_WORK_H
#include "shared/real.h"

/* Sample first_sample + s of the tile's pixel p has flat index s * (tile_width * tile_height) + p, p row by row. */
typedef struct WorkUnit {
    uint tile_x; /* pixels of the whole film */
    uint tile_y;
    uint tile_width;
    uint tile_height;
    uint first_sample; /* low word of the 64-bit sample index; a unit never crosses a 2^32 border */
    uint first_sample_high;
    uint sample_count;
    uint pool_size; /* samples that one work-item traces */
} WorkUnit;

/* One traced sample. radiance.w: 0, or kind + 1 + 16 * vertex of the first accident (HEALTH_*); radiance is 0 then. */
typedef struct SampleResult {
    real4 radiance;
} SampleResult;

/* First hit of the same sample; only with HAS_AOV. Depth is the distance from the camera in normalised units. */
typedef struct SampleAov {
    real4 albedo; /* w = depth; 0 where nothing was hit */
    real4 normal; /* shading normal, towards the camera; w = 1 where something was hit */
} SampleAov;

/* Running sums of one pixel within one block of SAMPLES_PER_BLOCK samples: compensated sum and Welford's M2. */
typedef struct PixelBlock {
    real4 sum;          /* w = number of samples in the block so far */
    real4 compensation; /* w = unused 0 */
    real4 m2;           /* sum of squared deviations from the mean of the block so far; w = number of accidents */
} PixelBlock;

/* Sums over the same samples; only with HAS_AOV. */
typedef struct PixelAov {
    real4 albedo; /* w = sum of depth */
    real4 normal; /* w = number of hits */
} PixelAov;

/* Accidents: nothing non-finite is dropped in silence. */
#define HEALTH_NON_FINITE_RADIANCE 0
#define HEALTH_NEGATIVE_RADIANCE 1
#define HEALTH_NON_FINITE_PDF 2
#define HEALTH_NEGATIVE_PDF 3
#define HEALTH_INVALID_RAY 4
#define HEALTH_STACK_OVERFLOW 5
#define HEALTH_PATH_TOO_LONG 6
#define HEALTH_KINDS 7

/* Rays by kind, and lanes, for the report. */
#define COUNT_CAMERA_RAYS 0
#define COUNT_INDIRECT_RAYS 1
#define COUNT_SHADOW_RAYS 2
#define COUNT_BUSY_LANES 3 /* lanes with a ray, summed over the steps of the loop */
#define COUNT_LANE_SLOTS 4 /* LANES, summed over the same steps */
#define COUNT_KINDS 5

/* Of one launch; zero it before (first: all ones). */
typedef struct LaunchCounters {
    uint health[8];       /* by HEALTH_* */
    uint health_first[8]; /* lowest flat index that had it */
    uint counts[8];       /* by COUNT_*, low words */
    uint counts_high[8];  /* high words */
} LaunchCounters;
#endif
