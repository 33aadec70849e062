/* Numbers for a picture's pixels: luminances, or how two pictures differ. */
#ifndef IMAGE_VALUES_H
#define IMAGE_VALUES_H

#include <stdbool.h>

#include "image/image.h"

/* NaN where there is none. */
typedef struct image_values {
    int width, height;
    float *values;
    int missing; /* how many are NaN */
} image_values;

/* Brightness times `multiplier` (IMAGE_LUMINOUS_EFFICACY: luminance in cd/m^2). False when out of memory. */
bool image_values_of(image_values *, const image *, double multiplier);
/* (A - B) / B, in brightness; NaN where B is black. The pictures have the same size. False when out of memory. */
bool image_relative_difference(image_values *, const image *a, const image *b);
void image_values_free(image_values *);
/* The largest value, and 0 at least. */
double image_values_largest(const image_values *);
/* What 99 of 100 values are below, up to their sign: a few stray pixels must not hide the rest. False when out of
 * memory. */
bool image_values_usual_size(const image_values *, double *size);

#endif
