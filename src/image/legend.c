/* Drawing legends. */
#include "image/legend.h"

#include <math.h>
#include <stdlib.h>

#include "image/font.h"

/* In dots of the letters. */
enum { MARGIN = 6, BAR = 12, TICK = 3, GAP = 7, ROW = IMAGE_FONT_HEIGHT + 5, LABEL = 2 * ROW };
enum { DASH_ROW = IMAGE_FONT_HEIGHT + 2 }; /* at least, between dashes */
enum { LEAST_ROWS = 5 };
/* A dot of the letters has half a pixel and one more for each so many of the picture's height. */
static const double height_of_dot = 360;
static const double largest_scale = 8;

image_legend_entry *image_legend_entries(const image_levels *l, int decimals, int *count) {
    image_legend_entry *entries = calloc((size_t)l->count + 1, sizeof *entries);
    *count = 0;
    for (int level = l->first; entries && level < l->first + l->count; level++) {
        image_legend_entry *entry = &entries[*count];
        if (!image_level_color(l, level, entry->color))
            continue;
        entry->level = level;
        entry->at = (double)level / l->scale->divisions;
        image_scale_text(l->scale, level, decimals, entry->text);
        ++*count;
    }
    return entries;
}

static int width_in_dots(const image_legend *legend) {
    int text = 0, all = image_text_width(legend->label);
    for (int i = 0; i < legend->count; i++)
        text = image_text_width(legend->entries[i].text) > text ? image_text_width(legend->entries[i].text) : text;
    if (BAR + GAP + text > all)
        all = BAR + GAP + text;
    if (legend->note && BAR + GAP + image_text_width(legend->note) > all)
        all = BAR + GAP + image_text_width(legend->note);
    return all + 2 * MARGIN;
}

/* Whole and half pixels to a dot: others look uneven. */
static double even_scale(double scale) {
    return fmin(fmax(round(2 * scale) / 2, 1), largest_scale);
}

static int top_of(const image_legend_size *size) {
    return (int)lround((MARGIN + LABEL) * size->scale);
}

static int bottom_of(const image_legend *legend, const image_legend_size *size) {
    double below = MARGIN + IMAGE_FONT_HEIGHT / 2. + (legend->note ? LABEL : 0);
    int top = top_of(size), bottom = (int)lround(size->height - below * size->scale);
    return bottom > top ? bottom : top + 1;
}

/* So many levels apart texts have room. */
static int text_step(const image_legend *legend, const image_legend_size *size) {
    if (legend->count < 2)
        return 1;
    const image_legend_entry *low = &legend->entries[0], *high = &legend->entries[legend->count - 1];
    double apart = (high->at - low->at) / (high->level - low->level) * (bottom_of(legend, size) - top_of(size));
    double row = (legend->color ? ROW : DASH_ROW) * size->scale;
    return apart < row ? (int)ceil(row / apart) : 1;
}

static image_legend_size size_of_scale(double scale, int dots, int picture_height, int width, int height) {
    int least = (int)ceil((2 * MARGIN + LABEL + LEAST_ROWS * ROW) * scale);
    return (image_legend_size){.width = width > 0 ? width : (int)ceil(dots * scale),
                               .height = height > 0               ? height
                                         : picture_height > least ? picture_height
                                                                  : least,
                               .scale = scale};
}

image_legend_size image_legend_fit(const image_legend *legend, int picture_height, int width, int height) {
    if (width == 0 || height == 0)
        return (image_legend_size){0, 0, 0};
    int dots = width_in_dots(legend);
    double scale = even_scale(0.5 + (height > 0 ? height : picture_height) / height_of_dot);
    if (width > 0)
        scale = fmin(scale, even_scale((double)width / dots));
    image_legend_size wanted = size_of_scale(scale, dots, picture_height, width, height), size = wanted;
    /* A line without its number tells nothing. */
    while (!legend->color && text_step(legend, &size) > 1 && size.scale > 1)
        size = size_of_scale(size.scale - 0.5, dots, picture_height, width, height);
    return legend->color || text_step(legend, &size) > 1 ? wanted : size;
}

/* From row `top` to row `bottom`, both within the scale. */
static void draw_bar(const image_legend *legend, image_canvas *canvas, double scale, int top, int bottom) {
    int x = (int)lround(MARGIN * scale), width = (int)lround(BAR * scale);
    for (int y = top; y < bottom; y++) {
        unsigned char color[3];
        if (legend->color(legend->user, (bottom - y - 0.5) / (bottom - top), color))
            image_fill(canvas, x, y, width, 1, color);
    }
}

static void draw_entry(const image_legend *legend, const image_legend_entry *entry, const image_legend_size *size,
                       image_canvas *canvas, double y) {
    static const unsigned char pale[3] = {225, 225, 225};
    double scale = size->scale, right = size->width - MARGIN * scale;
    int left = (int)lround(MARGIN * scale), width = (int)lround(BAR * scale), thick = (int)lround(scale);
    if (legend->color)
        image_fill(canvas, left + width, (int)lround(y - thick / 2.), (int)lround(TICK * scale), thick, pale);
    else
        image_fill(canvas, left, (int)lround(y - thick), width, 2 * thick, entry->color);
    image_draw_text(canvas, right - image_text_width(entry->text) * scale, y - IMAGE_FONT_HEIGHT / 2. * scale, scale,
                    pale, entry->text);
}

static void draw_note(const image_legend *legend, const image_legend_size *size, image_canvas *canvas) {
    static const unsigned char pale[3] = {225, 225, 225};
    double scale = size->scale, y = size->height - (MARGIN + IMAGE_FONT_HEIGHT) * scale;
    int left = (int)lround(MARGIN * scale), width = (int)lround(BAR * scale);
    image_fill(canvas, left, (int)lround(y), width, (int)lround(IMAGE_FONT_HEIGHT * scale), legend->note_color);
    image_draw_text(canvas, left + width + GAP * scale, y, scale, pale, legend->note);
}

/* Around 0, which has an entry itself if `zero`: whether the level has a text, among those `step` apart. */
static bool has_text_around_zero(int level, int levels, bool zero, int step) {
    int across = abs(2 * level - levels); /* to the level of the other sign */
    int from_end = (levels - across) / 2;
    if (zero && levels / 2 < step)
        return across == 0;
    if (zero)
        return from_end == 0 || (across / 2 % step == 0 && from_end >= step);
    return level == levels || (from_end % step == 0 && across >= step);
}

static bool has_text(const image_legend *legend, int i, int step) {
    int level = legend->entries[i].level, highest = legend->entries[legend->count - 1].level;
    /* Entries are for levels 0 to `highest`; one is missing where lines leave out 0. */
    bool zero = highest % 2 == 0 && legend->count == highest + 1;
    return legend->centered ? has_text_around_zero(level, highest, zero, step) : (highest - level) % step == 0;
}

/* Half a dash, for a line whose number has no room. */
static void draw_short_dash(const image_legend_entry *entry, const image_legend_size *size, image_canvas *canvas,
                            double y) {
    double scale = size->scale;
    image_fill(canvas, (int)lround(MARGIN * scale), (int)lround(y - lround(scale)), (int)lround(BAR / 2. * scale),
               2 * (int)lround(scale), entry->color);
}

static void draw_entries(const image_legend *legend, const image_legend_size *size, image_canvas *canvas) {
    int top = top_of(size), bottom = bottom_of(legend, size), step = text_step(legend, size);
    for (int i = 0; i < legend->count; i++) {
        double y = bottom - legend->entries[i].at * (bottom - top);
        if (has_text(legend, i, step))
            draw_entry(legend, &legend->entries[i], size, canvas, y);
        else if (!legend->color)
            draw_short_dash(&legend->entries[i], size, canvas, y);
    }
}

void image_legend_draw(const image_legend *legend, const image_legend_size *size, image_canvas *canvas) {
    static const unsigned char white[3] = {255, 255, 255};
    if (size->width == 0)
        return;
    double scale = size->scale;
    image_draw_text(canvas, MARGIN * scale, MARGIN * scale, scale, white, legend->label);
    if (legend->color)
        draw_bar(legend, canvas, scale, top_of(size), bottom_of(legend, size));
    if (legend->note)
        draw_note(legend, size, canvas);
    draw_entries(legend, size, canvas);
}
