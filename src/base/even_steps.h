/* Steps round a circle that spread evenly, however many are taken: of the golden section, and of its like. */
#ifndef BASE_EVEN_STEPS_H
#define BASE_EVEN_STEPS_H

#include <math.h>

#define GOLDEN_SECTION 0.6180339887498949

/* Lengths of steps round two circles at once, which spread evenly in a square: 1/g and 1/g^2 with g^3 = g + 1. */
#define EVEN_STEP_X 0.7548776662
#define EVEN_STEP_Y 0.5698402910

/* Where the step of this number ends on a circle of length 1: in 0 .. 1. */
static inline double even_step(double number, double length) {
    double turn = number * length;
    return turn - floor(turn);
}

#endif
