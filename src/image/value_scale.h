/* A scale for values: linear or logarithmic, in round steps, with its numbers as text. */
#ifndef IMAGE_VALUE_SCALE_H
#define IMAGE_VALUE_SCALE_H

#include "base/number.h"

typedef struct image_value_scale {
    double low, high; /* a logarithmic scale has no use for `low` */
    double decades;   /* that a logarithmic scale spans below `high`; 0: linear */
    int divisions;
} image_value_scale;

/* Where on the scale the value lies: 0 at its lower end, 1 at the upper one, beyond these for values beyond. */
double image_scale_position(const image_value_scale *, double value);
/* The value at division i, from 0 to `divisions`. */
double image_scale_value(const image_value_scale *, int i);
/* The smallest round step, 1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8 or 10 times a power of ten, of which `divisions` reach
 * `value`, times `divisions`; 0 for what is not positive. */
double image_scale_round_up(double value, int divisions);

enum { IMAGE_SCALE_TEXT = NUMBER_TEXT_SIZE + 1 };
/* The value at division i: on a linear scale with as many decimals as its steps need, but no more than tell three
 * digits of a step; on a logarithmic one with three digits. Never more decimals than `decimals`, unless that is
 * negative. On a scale with negative values positive ones have a sign. */
void image_scale_text(const image_value_scale *, int i, int decimals, char text[IMAGE_SCALE_TEXT]);
/* The value in three digits. */
void image_three_digits_text(double value, char text[IMAGE_SCALE_TEXT]);

#endif
