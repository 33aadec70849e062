/* Lines of equal luminance over a picture, as in the paper's Figures 2 and 8. */
#include "image/image.h"

#include <stdbool.h>
#include <stdlib.h>

#include "image/canvas.h"
#include "image/color.h"
#include "image/contour_lines.h"
#include "image/legend.h"
#include "image/value_scale.h"

enum { DECADES = 4 };         /* as many below the maximum, and no more */
enum { SMALLEST_SIDE = 400 }; /* smaller pictures are enlarged, by a whole number */
enum { LARGEST_ZOOM = 32 };

/* Levels first, first + 1, ... are at 10^(level / per_decade). */
typedef struct levels {
    int first, count, per_decade;
} levels;

static double luminance(const image *picture, size_t i) {
    return IMAGE_LUMINOUS_EFFICACY * image_brightness(picture->channels, i);
}

/* log10 of the luminance in cd/m^2, smoothed, times `per_decade`. */
static bool make_field(image_field *f, const image *picture, int per_decade) {
    size_t count = (size_t)picture->width * (size_t)picture->height;
    *f = (image_field){picture->width, picture->height, malloc(count * sizeof(float))};
    if (!f->values)
        return false;
    double brightest = 0;
    for (size_t i = 0; i < count; i++)
        brightest = fmax(brightest, luminance(picture, i));
    /* A little below the lowest level, so that black is below it too. */
    double floor_value = brightest > 0 ? log10(brightest) - DECADES - 0.01 : 0;
    for (size_t i = 0; i < count; i++) {
        double here = luminance(picture, i);
        f->values[i] = (float)(per_decade * (here > 0 ? fmax(log10(here), floor_value) : floor_value));
    }
    image_field_smooth(f);
    return true;
}

static levels choose_levels(const image_field *f, int per_decade) {
    double minimum = HUGE_VAL, maximum = -HUGE_VAL;
    for (size_t i = 0; i < (size_t)f->width * (size_t)f->height; i++) {
        minimum = fmin(minimum, f->values[i]);
        maximum = fmax(maximum, f->values[i]);
    }
    int first = (int)ceil(fmax(minimum, maximum - DECADES * per_decade)), last = (int)floor(maximum);
    return (levels){first, last < first ? 0 : last - first + 1, per_decade};
}

/* Blue at the lowest through green and yellow to red at the highest: all bright, to be seen on the picture. */
static bool level_color(const void *user, int level, unsigned char color[3]) {
    const levels *l = user;
    static const unsigned char stops[][3] = {{80, 110, 255}, {0, 200, 255}, {0, 220, 90},  {255, 235, 0},
                                             {255, 140, 0},  {255, 40, 40}, {255, 90, 220}};
    enum { LAST = sizeof stops / sizeof *stops - 1 };
    double at = l->count > 1 ? LAST * (double)(level - l->first) / (l->count - 1) : LAST / 2.0;
    int stop = at < LAST ? (int)at : LAST - 1;
    for (int c = 0; c < 3; c++)
        color[c] = (unsigned char)(stops[stop][c] + (at - stop) * (stops[stop + 1][c] - stops[stop][c]) + 0.5);
    return true;
}

static image_legend_entry *make_entries(const levels *l) {
    image_legend_entry *entries = calloc((size_t)l->count + 1, sizeof *entries);
    for (int i = 0; entries && i < l->count; i++) {
        entries[i].at = l->count > 1 ? (double)i / (l->count - 1) : 0.5;
        image_three_digits_text(pow(10, (double)(l->first + i) / l->per_decade), entries[i].text);
        level_color(l, l->first + i, entries[i].color);
    }
    return entries;
}

static int choose_zoom(const image *picture) {
    int side = picture->width > picture->height ? picture->width : picture->height;
    int zoom = (SMALLEST_SIDE + side - 1) / side;
    return zoom < LARGEST_ZOOM ? zoom : LARGEST_ZOOM;
}

static bool draw(image_canvas *canvas, const image *picture, const image_field *f, const levels *l) {
    int zoom = choose_zoom(picture);
    image_legend_entry *entries = make_entries(l);
    if (!entries)
        return false;
    image_legend legend = {.label = "cd/m2", .entries = entries, .count = l->count};
    image_legend_size size = image_legend_fit(&legend, picture->height * zoom, -1, -1);
    image_contour_levels lines = {l->first, l->count, level_color, l};
    bool drawn = image_canvas_create(canvas, size.width + picture->width * zoom, size.height) &&
                 image_draw_backdrop(canvas, size.width, picture, zoom);
    if (drawn) {
        image_draw_contour_lines(canvas, size.width, f, zoom, &lines);
        image_legend_draw(&legend, &size, canvas);
    }
    free(entries);
    return drawn;
}

static bool draw_contours(image_canvas *canvas, const image *picture, int per_decade) {
    image_field f;
    if (!make_field(&f, picture, per_decade))
        return false;
    levels l = choose_levels(&f, per_decade);
    bool drawn = draw(canvas, picture, &f, &l);
    free(f.values);
    return drawn;
}

graze_status image_write_contours(const image *picture, const char *file, int per_decade, const graze_report *report) {
    image_canvas canvas = {0};
    if (per_decade < 1 || per_decade > 100)
        return report_error(report, NULL, "contours: %d levels a factor of ten, not 1 to 100", per_decade);
    graze_status status = image_check_writable(file, report);
    if (status == GRAZE_OK)
        status = draw_contours(&canvas, picture, per_decade) ? image_canvas_write(&canvas, picture, file, report)
                                                             : report_out_of_memory(report);
    image_canvas_free(&canvas);
    return status;
}
