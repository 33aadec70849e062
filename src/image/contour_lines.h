/* Lines of equal value, drawn with soft edges. */
#ifndef IMAGE_CONTOUR_LINES_H
#define IMAGE_CONTOUR_LINES_H

#include "image/canvas.h"

/* Values at a picture's pixels, in such units that lines run where they are whole numbers. */
typedef struct image_field {
    int width, height;
    float *values; /* finite */
} image_field;

/* Which lines are drawn, and their colours; false for one that is left out after all. */
typedef struct image_contour_levels {
    int first, count;
    bool (*color)(const void *user, int level, unsigned char color[3]);
    const void *user;
} image_contour_levels;

/* Smooths away so much of the noise that lines hold together: the more pixels, the more. */
void image_field_smooth(image_field *);
/* Draws the lines on the field enlarged to zoom x zoom, from column `left` on. */
void image_draw_contour_lines(image_canvas *, int left, const image_field *, int zoom, const image_contour_levels *);

#endif
