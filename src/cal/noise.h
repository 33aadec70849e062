/* Noise over space, with the values that Radiance's textures and patterns are made for. */
#ifndef CAL_NOISE_H
#define CAL_NOISE_H

#include <stdbool.h>

typedef enum cal_noise_kind {
    CAL_NOISE_X, /* the derivatives of the value, as differences */
    CAL_NOISE_Y,
    CAL_NOISE_Z,
    CAL_NOISE_VALUE,
    CAL_NOISE_FRACTAL
} cal_noise_kind;

/* What is known of the point that was last asked for: textures ask for the value and all derivatives there. */
typedef struct cal_noise_memory {
    double point[3];
    double values[4]; /* those whose bit is set in `known` */
    unsigned known;
} cal_noise_memory;

/* Values are within [-1, 1]. The memory must begin with known = 0. NaN for points that are not finite. */
double cal_noise(cal_noise_kind, const double point[3], cal_noise_memory *);

#endif
