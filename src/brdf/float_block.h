/* Arrays in single precision, a block at a time on the stack: arguments widened to double precision, results rounded.
 */
#ifndef BRDF_FLOAT_BLOCK_H
#define BRDF_FLOAT_BLOCK_H

#include <float.h>
#include <stddef.h>

#include "brdf/arithmetic.h"

enum { FLOAT_BLOCK = 128 };

/* How many numbers the block that begins at `from` holds. */
BRDF_INLINE size_t float_block_length(size_t from, size_t count) {
    return count - from < FLOAT_BLOCK ? count - from : FLOAT_BLOCK;
}

BRDF_INLINE void float_block_widen(double *restrict to, const float *restrict from, size_t count) {
    for (size_t i = 0; i < count; ++i)
        to[i] = from[i];
}

/* What is too large for a float is FLT_MAX. */
BRDF_INLINE void float_block_round(float *restrict to, const double *restrict from, size_t count) {
    for (size_t i = 0; i < count; ++i)
        to[i] = (float)(from[i] < FLT_MAX ? from[i] : FLT_MAX);
}

#endif
