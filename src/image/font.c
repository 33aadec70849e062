/* Text as strokes from dot to neighbouring dot, with soft edges. */
#include "image/font.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "image/glyphs.h"

enum { ROWS = IMAGE_FONT_HEIGHT + IMAGE_FONT_DEPTH, COLUMNS = IMAGE_FONT_WIDTH };
/* A dot has four neighbours that it does not share with one before it. */
enum { STROKE_LIMIT = 4 * ROWS * COLUMNS };
static const double stroke_width = 0.9; /* in dots; at least a pixel */

/* A line between the centres of two dots, in dots from the letter's upper left corner. */
typedef struct stroke {
    double x, y, dx, dy;
} stroke;

static bool is_dot(const char *const *rows, int row, int column) {
    return row >= 0 && row < ROWS && column >= 0 && column < COLUMNS && rows[row] && rows[row][column] == '#';
}

static bool is_alone(const char *const *rows, int row, int column) {
    for (int i = 0; i < 9; i++)
        if (i != 4 && is_dot(rows, row + i / 3 - 1, column + i % 3 - 1))
            return false;
    return true;
}

/* Strokes to the dots right and below, and aslant where no dot beside them makes the corner already. */
static int add_strokes(const char *const *rows, int row, int column, stroke *strokes) {
    static const int directions[4][2] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};
    int count = 0;
    for (int d = 0; d < 4; d++) {
        int dx = directions[d][0], dy = directions[d][1];
        bool aslant = dx != 0 && dy != 0;
        bool corner = aslant && (is_dot(rows, row, column + dx) || is_dot(rows, row + dy, column));
        if (is_dot(rows, row + dy, column + dx) && !corner)
            strokes[count++] = (stroke){column + 0.5, row + 0.5, dx, dy};
    }
    if (is_alone(rows, row, column))
        strokes[count++] = (stroke){column + 0.5, row + 0.5, 0, 0};
    return count;
}

static int strokes_of(const char *const *rows, stroke strokes[STROKE_LIMIT]) {
    int count = 0;
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++)
            if (is_dot(rows, row, column))
                count += add_strokes(rows, row, column, strokes + count);
    return count;
}

static double distance_to(const stroke *s, double x, double y) {
    double along = (x - s->x) * s->dx + (y - s->y) * s->dy, length2 = s->dx * s->dx + s->dy * s->dy;
    double t = length2 > 0 ? fmin(fmax(along / length2, 0), 1) : 0;
    return hypot(x - s->x - t * s->dx, y - s->y - t * s->dy);
}

/* `width` of the strokes in pixels. */
static void draw_glyph(image_canvas *canvas, const char *const *rows, double left, double top, double scale,
                       double width, const unsigned char color[3]) {
    stroke strokes[STROKE_LIMIT];
    int count = strokes_of(rows, strokes);
    int x0 = (int)floor(left - width), x1 = (int)ceil(left + COLUMNS * scale + width);
    int y0 = (int)floor(top - width), y1 = (int)ceil(top + ROWS * scale + width);
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++) {
            double nearest = HUGE_VAL;
            for (int i = 0; i < count; i++)
                nearest = fmin(nearest, distance_to(&strokes[i], (x + 0.5 - left) / scale, (y + 0.5 - top) / scale));
            double cover = (width + 1) / 2 - nearest * scale;
            if (cover > 0)
                image_blend(canvas, x, y, fmin(cover, 1), color);
        }
}

static void draw(image_canvas *canvas, double x, double y, double scale, double width, const unsigned char color[3],
                 const char *text) {
    static const int glyph_count = sizeof image_glyphs / sizeof *image_glyphs;
    for (int i = 0; text[i]; i++) {
        int glyph = (unsigned char)text[i] - '!';
        if (glyph >= 0 && glyph < glyph_count)
            draw_glyph(canvas, image_glyphs[glyph], x + i * IMAGE_FONT_ADVANCE * scale, y, scale, width, color);
    }
}

int image_text_width(const char *text) {
    int length = (int)strlen(text);
    return length > 0 ? IMAGE_FONT_ADVANCE * length - (IMAGE_FONT_ADVANCE - IMAGE_FONT_WIDTH) : 0;
}

void image_draw_text(image_canvas *canvas, double x, double y, double scale, const unsigned char color[3],
                     const char *text) {
    draw(canvas, x, y, scale, fmax(stroke_width * scale, 1), color, text);
}

void image_draw_rimmed_text(image_canvas *canvas, double x, double y, double scale, const char *text) {
    static const unsigned char black[3] = {0, 0, 0}, white[3] = {255, 255, 255};
    draw(canvas, x, y, scale, fmax(stroke_width * scale, 1) + 2 * scale, black, text);
    image_draw_text(canvas, x, y, scale, white, text);
}
