/* Random numbers for tests: the same everywhere. */
#ifndef TEST_SUPPORT_DICE_H
#define TEST_SUPPORT_DICE_H

#include <math.h>
#include <stdint.h>

#include "base/angle.h"
#include "base/vector.h"

/* Xorshift64*: any state but 0. */
typedef struct dice {
    uint64_t state;
} dice;

static inline uint64_t roll_bits(dice *d) {
    d->state ^= d->state >> 12;
    d->state ^= d->state << 25;
    d->state ^= d->state >> 27;
    return d->state * 0x2545F4914F6CDD1Du;
}

/* In [0,1). */
static inline double roll(dice *d) {
    return (double)(roll_bits(d) >> 11) * 0x1p-53;
}

static inline double roll_between(dice *d, double low, double high) {
    return low + (high - low) * roll(d);
}

/* Evenly over orders of magnitude. */
static inline double roll_size(dice *d, double low, double high) {
    return low * pow(high / low, roll(d));
}

static inline int roll_below(dice *d, int count) {
    return (int)(roll(d) * count);
}

static inline vec3 roll_direction(dice *d) {
    double z = roll_between(d, -1, 1), phi = 2 * PI * roll(d), r = sqrt(1 - z * z);
    return vec3_normalize(vec3_make(r * cos(phi), r * sin(phi), z));
}

static inline vec3 roll_in_box(dice *d, vec3 lower, vec3 upper) {
    double x = roll_between(d, lower.x, upper.x), y = roll_between(d, lower.y, upper.y);
    return vec3_make(x, y, roll_between(d, lower.z, upper.z));
}

static inline vec3 roll_in_cube(dice *d, double half) {
    return roll_in_box(d, vec3_make(-half, -half, -half), vec3_make(half, half, half));
}

#endif
