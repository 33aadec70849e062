/* Arrays are worked on a block at a time, so that what is kept between two passes stays in the nearest cache. */
#ifndef BRDF_BLOCKS_H
#define BRDF_BLOCKS_H

#include <stddef.h>

#include "brdf/arithmetic.h"

enum { BRDF_BLOCK = 128, BRDF_BLOCK_ARRAYS = 6 };

/* Arguments of float functions widened, or results before they are rounded. */
typedef struct brdf_block {
    double numbers[BRDF_BLOCK_ARRAYS][BRDF_BLOCK];
} brdf_block;

/* How many elements the block that begins at `start` has. */
BRDF_INLINE size_t block_length(size_t start, size_t count) {
    return count - start < BRDF_BLOCK ? count - start : BRDF_BLOCK;
}

#endif
