/* Divisions of a scale that lines and legends show, in a palette's colours. */
#ifndef IMAGE_LEVELS_H
#define IMAGE_LEVELS_H

#include <stdbool.h>

#include "image/palette.h"
#include "image/value_scale.h"

/* Level i is division i of the scale. */
typedef struct image_levels {
    const image_value_scale *scale;
    const image_palette *palette;
    int first, count;
    int without; /* one that is left out after all; negative: none */
} image_levels;

/* The level's colour; false where it is not one of these. */
bool image_level_color(const image_levels *, int level, unsigned char color[3]);

#endif
