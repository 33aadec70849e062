/* A canvas for pictures with lines, letters and legends: 8-bit sRGB. */
#ifndef IMAGE_CANVAS_H
#define IMAGE_CANVAS_H

#include <stdbool.h>
#include <stdio.h>

#include "image/image.h"

typedef struct image_canvas {
    int width, height;
    unsigned char *bytes;
} image_canvas;

/* All black. False when out of memory. */
bool image_canvas_create(image_canvas *, int width, int height);
void image_canvas_free(image_canvas *);

/* Fills a rectangle, cut to the canvas. */
void image_fill(image_canvas *, int x, int y, int width, int height, const unsigned char color[3]);
/* Lays the colour over a pixel, which it covers in part, from 0 to 1; nothing off the canvas. */
void image_blend(image_canvas *, int x, int y, double cover, const unsigned char color[3]);
/* The picture from column `left` on, exposed for the eye, each pixel enlarged to zoom x zoom, cut to the canvas; a
 * little darker than usual so that lines over it stand out. False when out of memory. */
bool image_draw_backdrop(image_canvas *, int left, const image *, int zoom);

/* Writes the canvas as image_write does, with the shape of pixels, command and software of `header`: the very bytes in
 * 8-bit formats, the linear values that they stand for in the others. */
graze_status image_canvas_write(const image_canvas *, const image *header, const char *file, const graze_report *);
/* The linear values as Radiance HDR. */
graze_status image_canvas_write_hdr(const image_canvas *, const image *header, FILE *, const char *name,
                                    const graze_report *);

#endif
