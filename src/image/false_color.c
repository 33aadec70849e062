/* Drawing false colours. */
#include "image/false_color.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/contour_lines.h"
#include "image/font.h"
#include "image/legend.h"

/* Half a band's width, in divisions. */
static const double band = 0.1;
/* Neither black nor white, nor on the way from blue to orange. */
static const unsigned char missing_color[3] = {112, 112, 112};

/* The colour at a place on the scale; false where the style has none. */
static bool color_at(const void *user, double at, unsigned char color[3]) {
    const image_false_color *f = user;
    int divisions = f->scale.divisions;
    double division = fmin(fmax(at, 0), 1) * divisions;
    switch (f->style) {
    case IMAGE_FALSE_COLOR_SMOOTH:
        break;
    case IMAGE_FALSE_COLOR_POSTER:
        at = (fmin(floor(division), divisions - 1) + 0.5) / divisions;
        break;
    case IMAGE_FALSE_COLOR_BANDS:
        if (!(fabs(at * divisions - round(division)) <= band) || (round(division) < 1 && f->scale.low >= 0))
            return false;
        break;
    case IMAGE_FALSE_COLOR_LINES:
    case IMAGE_FALSE_COLOR_NONE:
        return false;
    }
    image_palette_color(f->palette, at, color);
    return true;
}

/* Lines, bands and their legend begin above the scale's lower end, as Radiance's do, unless values go on below it.
 * Where pictures hardly differ, noise alone would draw lines at 0. */
static image_levels levels_of(const image_false_color *f) {
    bool whole = f->style == IMAGE_FALSE_COLOR_SMOOTH || f->style == IMAGE_FALSE_COLOR_POSTER;
    int first = whole || f->scale.low < 0 ? 0 : 1, divisions = f->scale.divisions;
    bool around_zero = f->style == IMAGE_FALSE_COLOR_LINES && f->scale.low < 0 && divisions % 2 == 0;
    return (image_levels){.scale = &f->scale,
                          .palette = f->palette,
                          .first = first,
                          .count = divisions + 1 - first,
                          .without = around_zero ? divisions / 2 : -1};
}

static void draw_colors(image_canvas *canvas, int left, const image_values *values, const image_false_color *f) {
    bool lines = f->style == IMAGE_FALSE_COLOR_LINES || f->style == IMAGE_FALSE_COLOR_NONE;
    for (int y = 0; y < values->height && !lines; y++)
        for (int x = 0; x < values->width; x++) {
            double value = values->values[(size_t)y * (size_t)values->width + (size_t)x];
            unsigned char color[3];
            if (isnan(value))
                image_fill(canvas, left + x, y, 1, 1, missing_color);
            else if (color_at(f, image_scale_position(&f->scale, value), color))
                image_fill(canvas, left + x, y, 1, 1, color);
        }
}

static bool draw_lines(image_canvas *canvas, int left, const image_values *values, const image_false_color *f) {
    image_field field;
    if (!image_field_of(&field, values, &f->scale))
        return false;
    image_levels levels = levels_of(f);
    image_draw_contour_lines(canvas, left, &field, 1, &levels);
    image_field_free(&field);
    return true;
}

static const double ring_radius = 4; /* in dots of the letters */

/* White with a dark rim; its middle is that of the pixel. */
static void draw_ring(image_canvas *canvas, int left, int pixel_x, int pixel_y, double scale) {
    static const unsigned char black[3] = {0, 0, 0}, white[3] = {255, 255, 255};
    double radius = ring_radius * scale;
    int reach = (int)ceil(radius + 2 * scale);
    for (int dy = -reach; dy <= reach; dy++)
        for (int dx = -reach; dx <= reach; dx++) {
            double off = fabs(hypot(dx, dy) - radius);
            if (pixel_x + dx < left)
                continue;
            image_blend(canvas, pixel_x + dx, pixel_y + dy, fmin(fmax(1.3 * scale + 0.5 - off, 0), 1), black);
            image_blend(canvas, pixel_x + dx, pixel_y + dy, fmin(fmax(0.5 * scale + 0.5 - off, 0), 1), white);
        }
}

/* A ring around the pixel, and its value beside, within the picture as far as there is room. */
static void mark(image_canvas *canvas, int left, const image_values *values, size_t pixel, double scale) {
    int pixel_x = left + (int)(pixel % (size_t)values->width), pixel_y = (int)(pixel / (size_t)values->width);
    char text[IMAGE_SCALE_TEXT];
    image_three_digits_text(values->values[pixel], text);
    double width = image_text_width(text) * scale, height = IMAGE_FONT_HEIGHT * scale, gap = 2 * ring_radius * scale;
    double x = pixel_x + 0.5 + gap, y = pixel_y + 0.5 - height / 2;
    if (x + width + scale > left + values->width)
        x = fmax(pixel_x + 0.5 - gap - width, left + scale);
    y = fmax(fmin(y, values->height - height - scale), scale);
    draw_ring(canvas, left, pixel_x, pixel_y, scale);
    image_draw_rimmed_text(canvas, x, y, scale, text);
}

/* The first of equal ones. */
static void draw_extrema(image_canvas *canvas, int left, const image_values *values, double scale) {
    size_t count = (size_t)values->width * (size_t)values->height, largest = count, smallest = count;
    for (size_t i = 0; i < count; i++) {
        float value = values->values[i];
        if (isnan(value))
            continue;
        if (largest == count || value > values->values[largest])
            largest = i;
        if (smallest == count || value < values->values[smallest])
            smallest = i;
    }
    if (largest == count)
        return;
    mark(canvas, left, values, smallest, scale);
    mark(canvas, left, values, largest, scale);
}

static bool draw_all(image_canvas *canvas, const image_legend *legend, const image_values *values,
                     const image *backdrop, const image_false_color *f) {
    bool none = f->style == IMAGE_FALSE_COLOR_NONE;
    image_legend_size size = image_legend_fit(legend, values->height, none ? 0 : f->legend_width, f->legend_height);
    int height = size.height > values->height ? size.height : values->height;
    if (!image_canvas_create(canvas, size.width + values->width, height))
        return false;
    image_legend_draw(legend, &size, canvas);
    if (backdrop && !image_draw_backdrop(canvas, size.width, backdrop, 1))
        return false;
    draw_colors(canvas, size.width, values, f);
    if (f->style == IMAGE_FALSE_COLOR_LINES && !draw_lines(canvas, size.width, values, f))
        return false;
    if (f->extrema)
        draw_extrema(canvas, size.width, values, size.scale > 0 ? size.scale : 1.5);
    return true;
}

bool image_draw_false_color(image_canvas *canvas, const image_values *values, const image *backdrop,
                            const image_false_color *f) {
    *canvas = (image_canvas){0, 0, NULL};
    image_legend legend = {.label = f->label, .user = f, .centered = f->scale.low < 0};
    image_levels levels = levels_of(f);
    image_legend_entry *entries = image_legend_entries(&levels, f->decimals, &legend.count);
    if (!entries)
        return false;
    legend.entries = entries;
    legend.color = f->style == IMAGE_FALSE_COLOR_LINES ? NULL : color_at;
    legend.note = values->missing > 0 && f->style != IMAGE_FALSE_COLOR_LINES ? f->missing : NULL;
    memcpy(legend.note_color, missing_color, 3);
    bool drawn = draw_all(canvas, &legend, values, backdrop, f);
    if (!drawn)
        image_canvas_free(canvas);
    free(entries);
    return drawn;
}
