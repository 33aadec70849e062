/* Blocks of floats to doubles and back: to be compiled once for each instruction set. */
#ifndef BRDF_FLOAT_CONVERSION_H
#define BRDF_FLOAT_CONVERSION_H

#include <float.h>

#include "brdf/blocks.h"

BRDF_INLINE void widen_array(double *restrict to, const float *restrict from, size_t length) {
    for (size_t i = 0; i < length; ++i)
        to[i] = from[i];
}

static void widen(brdf_block *to, const float *const *from, int arrays, size_t start, size_t length) {
    for (int k = 0; k < arrays; ++k)
        widen_array(to->numbers[k], from[k] + start, length);
}

/* What is too large for a float is FLT_MAX. */
BRDF_INLINE void narrow_array(float *restrict to, const double *restrict from, size_t length) {
    for (size_t i = 0; i < length; ++i)
        to[i] = (float)(from[i] < FLT_MAX ? from[i] : FLT_MAX);
}

static void narrow(float *const *to, const brdf_block *from, int arrays, size_t start, size_t length) {
    for (int k = 0; k < arrays; ++k)
        narrow_array(to[k] + start, from->numbers[k], length);
}

#endif
