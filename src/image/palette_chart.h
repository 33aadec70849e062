/* A chart of all palettes. */
#ifndef IMAGE_PALETTE_CHART_H
#define IMAGE_PALETTE_CHART_H

#include "image/canvas.h"

/* All palettes with their names, from top to bottom. False when out of memory. */
bool image_draw_palettes(image_canvas *);

#endif
