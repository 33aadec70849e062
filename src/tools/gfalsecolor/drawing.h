/* What gfalsecolor draws. */
#ifndef TOOLS_GFALSECOLOR_DRAWING_H
#define TOOLS_GFALSECOLOR_DRAWING_H

#include "tools/gfalsecolor/pictures.h"

/* Draws the pictures as the options say. False when out of memory. */
bool false_color_draw(image_canvas *, const false_color_options *, const false_color_pictures *, const image_palette *);

#endif
