/* A tiny font for legends: digits and the few letters that luminances need. */
#ifndef IMAGE_FONT_H
#define IMAGE_FONT_H

enum { IMAGE_FONT_WIDTH = 5, IMAGE_FONT_HEIGHT = 7, IMAGE_FONT_ADVANCE = 6 };

/* A canvas of 8-bit RGB. */
typedef struct image_canvas {
    int width, height;
    unsigned char *bytes;
} image_canvas;

/* Draws the text with its upper left corner at x, y, each dot `scale` pixels wide; what lies off the canvas is left
 * out. Known are 0-9 . - + e c d m / and blank; others are blank too. */
void image_draw_text(image_canvas *, int x, int y, int scale, const unsigned char color[3], const char *text);
/* Fills a rectangle, cut to the canvas. */
void image_fill(image_canvas *, int x, int y, int width, int height, const unsigned char color[3]);

#endif
