/* A small font for legends. */
#include "image/font.h"

#include <stddef.h>
#include <string.h>

typedef struct glyph {
    char letter;
    const char *rows[IMAGE_FONT_HEIGHT];
} glyph;

static const glyph glyphs[] = {
    {'0', {" ### ", "#   #", "#   #", "#   #", "#   #", "#   #", " ### "}},
    {'1', {"  #  ", " ##  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "}},
    {'2', {" ### ", "#   #", "    #", "   # ", "  #  ", " #   ", "#####"}},
    {'3', {" ### ", "#   #", "    #", "  ## ", "    #", "#   #", " ### "}},
    {'4', {"   # ", "  ## ", " # # ", "#  # ", "#####", "   # ", "   # "}},
    {'5', {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "}},
    {'6', {"  ## ", " #   ", "#    ", "#### ", "#   #", "#   #", " ### "}},
    {'7', {"#####", "    #", "   # ", "   # ", "  #  ", "  #  ", "  #  "}},
    {'8', {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "}},
    {'9', {" ### ", "#   #", "#   #", " ####", "    #", "   # ", " ##  "}},
    {'.', {"     ", "     ", "     ", "     ", "     ", " ##  ", " ##  "}},
    {'-', {"     ", "     ", "     ", " ### ", "     ", "     ", "     "}},
    {'+', {"     ", "  #  ", "  #  ", "#####", "  #  ", "  #  ", "     "}},
    {'/', {"    #", "    #", "   # ", "  #  ", " #   ", "#    ", "#    "}},
    {'c', {"     ", "     ", " ### ", "#   #", "#    ", "#   #", " ### "}},
    {'d', {"    #", "    #", " ####", "#   #", "#   #", "#   #", " ####"}},
    {'e', {"     ", "     ", " ### ", "#   #", "#####", "#    ", " ### "}},
    {'m', {"     ", "     ", "## # ", "# # #", "# # #", "# # #", "# # #"}},
};

void image_fill(image_canvas *canvas, int x, int y, int width, int height, const unsigned char color[3]) {
    for (int row = y < 0 ? 0 : y; row < y + height && row < canvas->height; row++)
        for (int column = x < 0 ? 0 : x; column < x + width && column < canvas->width; column++)
            memcpy(canvas->bytes + 3 * ((size_t)row * (size_t)canvas->width + (size_t)column), color, 3);
}

static const glyph *find_glyph(char letter) {
    for (size_t i = 0; i < sizeof glyphs / sizeof *glyphs; i++)
        if (glyphs[i].letter == letter)
            return &glyphs[i];
    return NULL;
}

void image_draw_text(image_canvas *canvas, int x, int y, int scale, const unsigned char color[3], const char *text) {
    for (; *text; text++, x += IMAGE_FONT_ADVANCE * scale) {
        const glyph *g = find_glyph(*text);
        for (int row = 0; g && row < IMAGE_FONT_HEIGHT; row++)
            for (int column = 0; column < IMAGE_FONT_WIDTH; column++)
                if (g->rows[row][column] == '#')
                    image_fill(canvas, x + column * scale, y + row * scale, scale, scale, color);
    }
}
