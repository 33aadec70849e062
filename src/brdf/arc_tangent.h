/* A series, for the type `numbers`, a double or several, that is defined where this is included. */
#ifndef BRDF_ARC_TANGENT_H
#define BRDF_ARC_TANGENT_H

/* Squared tangents up to this, that of 15 degrees and a little more, are small enough for it. */
#define BRDF_SMALL_TANGENT2 .0725

/* atan(t) / t for the square of t; the rest of the series is below 2^-54. */
static inline __attribute__((always_inline)) numbers arc_tangent_over(numbers t2) {
    numbers x = -t2, x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    numbers low = (1 + x * (1. / 3)) + x2 * (1. / 5 + x * (1. / 7));
    numbers middle = (1. / 9 + x * (1. / 11)) + x2 * (1. / 13 + x * (1. / 15));
    numbers high = (1. / 17 + x * (1. / 19)) + x2 * (1. / 21 + x * (1. / 23));
    numbers last = 1. / 25 + x * (1. / 27);
    return (low + x4 * middle) + x8 * (high + x4 * last);
}

#endif
