/* Colours for values from 0 to 1. */
#ifndef IMAGE_PALETTE_H
#define IMAGE_PALETTE_H

#include <stddef.h>

typedef struct image_palette image_palette;

/* The palette of that name, or null: Radiance's def, spec, pm3d, hot, eco and tbo, and
 *   viridis    dark blue through green to yellow, brighter in even steps; for any kind of eye, and for paper
 *   gray       black to white, in steps that look even
 *   diverging  blue through white at 1/2 to orange, both sides equally dark; for any kind of eye
 *   vivid      blue through green and yellow to red and pink, all bright: for lines on a picture */
const image_palette *image_palette_find(const char *name);
/* Palette i, counted from 0; null behind the last. */
const image_palette *image_palette_at(int i);
const char *image_palette_name(const image_palette *);
/* The names with commas. */
void image_palette_list(char *text, size_t size);

/* The colour of `at`, cut to 0 .. 1, in 8-bit sRGB. */
void image_palette_color(const image_palette *, double at, unsigned char color[3]);

#endif
