/* Numbers both sides agree on. */
#pragma once

/* Samples of one pixel that are summed on the device before the host adds the sum in double. */
#define SAMPLES_PER_BLOCK 64

/* "No such thing" wherever an index is stored. */
#define NO_INDEX 0xffffffffu

/* A path with no other limit ends here and is counted in Health. */
#define MAX_PATH_VERTICES 65536u

/* The leaves of the tree: at most so many primitives. */
#define MAX_LEAF_PRIMITIVES 4u

/* Set in a child reference of a BvhNode that is a leaf. */
#define LEAF_BIT 0x80000000u

/* Bits of the Morton code per axis. */
#define MORTON_BITS 21u

/* The radix sort looks at 8 bits a pass. */
#define RADIX_BITS 8u
#define RADIX_SIZE 256u
