/* False colour: what a picture's values are, to be read off its colours, in the manner of Radiance's falsecolor. */
#ifndef IMAGE_FALSE_COLOR_H
#define IMAGE_FALSE_COLOR_H

#include <stdbool.h>

#include "image/canvas.h"
#include "image/palette.h"
#include "image/value_scale.h"
#include "image/values.h"

typedef enum image_false_color_style {
    IMAGE_FALSE_COLOR_SMOOTH, /* every value has its colour */
    IMAGE_FALSE_COLOR_LINES,  /* lines where the scale's divisions lie */
    IMAGE_FALSE_COLOR_BANDS,  /* bands there, a fifth of the way from one to the next wide */
    IMAGE_FALSE_COLOR_POSTER, /* one colour from each division to the next */
    IMAGE_FALSE_COLOR_NONE,   /* no colours, no legend */
} image_false_color_style;

typedef struct image_false_color {
    image_false_color_style style;
    const image_palette *palette;
    image_value_scale scale;
    const char *label;
    int decimals;                    /* at most, in the legend; negative: what suits */
    int legend_width, legend_height; /* 0: no legend; negative: what suits */
    bool extrema;                    /* mark the largest and the smallest value */
    const char *missing;             /* what the colour of missing values means */
} image_false_color;

/* Draws it. The backdrop, of the values' size, is what is seen where there is no colour; null: black. False when out of
 * memory. */
bool image_draw_false_color(image_canvas *, const image_values *, const image *backdrop, const image_false_color *);

#endif
