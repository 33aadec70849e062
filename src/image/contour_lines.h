/* Lines of equal value, drawn with soft edges. */
#ifndef IMAGE_CONTOUR_LINES_H
#define IMAGE_CONTOUR_LINES_H

#include "image/canvas.h"
#include "image/levels.h"
#include "image/values.h"

/* Where a picture's values lie on a scale, in its divisions: lines run where that is a whole number. */
typedef struct image_field {
    int width, height;
    float *places; /* finite */
} image_field;

/* The field of the values; with so much of the noise smoothed away that lines hold together: the more pixels, the more.
 * False when out of memory. */
bool image_field_of(image_field *, const image_values *, const image_value_scale *);
void image_field_free(image_field *);
/* Draws the levels' lines on the field enlarged to zoom x zoom, from column `left` on. */
void image_draw_contour_lines(image_canvas *, int left, const image_field *, int zoom, const image_levels *);

#endif
