/* Letters for legends: printable ASCII, made of round strokes, at any size. */
#ifndef IMAGE_FONT_H
#define IMAGE_FONT_H

#include "image/canvas.h"

/* In dots. Letters stand on a base line HEIGHT below their top; some go DEPTH below it. */
enum { IMAGE_FONT_WIDTH = 5, IMAGE_FONT_HEIGHT = 7, IMAGE_FONT_DEPTH = 2, IMAGE_FONT_ADVANCE = 6 };

/* The width of the text, in dots. */
int image_text_width(const char *text);
/* Draws the text with its upper left corner at x, y, each dot `scale` pixels wide; what lies off the canvas is left
 * out. What is not printable ASCII is blank. */
void image_draw_text(image_canvas *, double x, double y, double scale, const unsigned char color[3], const char *text);
/* White text with a dark rim, to be read on any ground. */
void image_draw_rimmed_text(image_canvas *, double x, double y, double scale, const char *text);

#endif
