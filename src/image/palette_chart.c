/* Drawing the chart of palettes. */
#include "image/palette_chart.h"

#include "image/font.h"
#include "image/palette.h"

enum { MARGIN = 12, BAR = 512, ROW = 40, THICK = 28, NAMES = 130, SCALE = 2 };

static void draw_row(image_canvas *canvas, int y, const image_palette *palette) {
    static const unsigned char white[3] = {255, 255, 255};
    double text_y = y + (THICK - SCALE * IMAGE_FONT_HEIGHT) / 2.;
    image_draw_text(canvas, MARGIN, text_y, SCALE, white, image_palette_name(palette));
    for (int x = 0; x < BAR; x++) {
        unsigned char color[3];
        image_palette_color(palette, (x + 0.5) / BAR, color);
        image_fill(canvas, MARGIN + NAMES + x, y, 1, THICK, color);
    }
}

bool image_draw_palettes(image_canvas *canvas) {
    int count = 0;
    while (image_palette_at(count))
        count++;
    if (!image_canvas_create(canvas, 2 * MARGIN + NAMES + BAR, 2 * MARGIN + count * ROW - (ROW - THICK)))
        return false;
    for (int i = 0; i < count; i++)
        draw_row(canvas, MARGIN + i * ROW, image_palette_at(i));
    return true;
}
