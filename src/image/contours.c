/* Lines of equal luminance over a picture, as in the paper's Figures 2 and 8. */
#include "image/image.h"

#include <stdlib.h>

#include "image/color.h"
#include "image/contour_lines.h"
#include "image/legend.h"

static const double decades = 4; /* as many below the maximum, and no more */
/* What is darker counts as lying a little below the lowest line. */
static const double margin = 0.01;
enum { SMALLEST_SIDE = 400 }; /* smaller pictures are enlarged, by a whole number */
enum { LARGEST_ZOOM = 32 };

/* A line for each division. */
static image_value_scale scale_between(int lowest, int highest, int per_decade) {
    return (image_value_scale){.high = pow(10, (double)highest / per_decade),
                               .decades = (double)(highest - lowest) / per_decade,
                               .divisions = highest - lowest};
}

/* The powers of 10^(1 / per_decade) around all that may have lines. */
static image_value_scale widest_scale(const image_values *values, int per_decade, int *lowest) {
    double largest = image_values_largest(values), top = largest > 0 ? log10(largest) : 0;
    *lowest = (int)floor(per_decade * (top - decades - margin));
    return scale_between(*lowest, (int)ceil(per_decade * top), per_decade);
}

static void raise_dark_values(image_values *values) {
    double least = image_values_largest(values) * pow(10, -decades - margin);
    for (size_t i = 0; i < (size_t)values->width * (size_t)values->height; i++)
        values->values[i] = (float)fmax(values->values[i], least);
}

/* Numbers the field's places anew, on a scale from the lowest line that it has to the highest, which it gives. A single
 * line is in the middle. */
static image_value_scale fit_scale(image_field *f, int lowest, int per_decade, image_levels *levels) {
    size_t count = (size_t)f->width * (size_t)f->height;
    double minimum = HUGE_VAL, maximum = -HUGE_VAL;
    for (size_t i = 0; i < count; i++) {
        minimum = fmin(minimum, f->places[i]);
        maximum = fmax(maximum, f->places[i]);
    }
    int first = (int)ceil(fmax(minimum, maximum - decades * per_decade)), last = (int)floor(maximum);
    levels->count = last < first ? 0 : last - first + 1;
    levels->first = levels->count > 1 ? 0 : 1;
    int bottom = first - levels->first, top = levels->count > 1 ? last : bottom + 2;
    for (size_t i = 0; i < count; i++)
        f->places[i] -= (float)bottom;
    return scale_between(lowest + bottom, lowest + top, per_decade);
}

static int choose_zoom(const image *picture) {
    int side = picture->width > picture->height ? picture->width : picture->height;
    int zoom = (SMALLEST_SIDE + side - 1) / side;
    return zoom < LARGEST_ZOOM ? zoom : LARGEST_ZOOM;
}

static bool draw(image_canvas *canvas, const image *picture, const image_field *f, const image_levels *levels) {
    int zoom = choose_zoom(picture);
    image_legend legend = {.label = "cd/m2"};
    image_legend_entry *entries = image_legend_entries(levels, -1, &legend.count);
    if (!entries)
        return false;
    legend.entries = entries;
    image_legend_size size = image_legend_fit(&legend, picture->height * zoom, -1, -1);
    bool drawn = image_canvas_create(canvas, size.width + picture->width * zoom, size.height) &&
                 image_draw_backdrop(canvas, size.width, picture, zoom);
    if (drawn) {
        image_draw_contour_lines(canvas, size.width, f, zoom, levels);
        image_legend_draw(&legend, &size, canvas);
    }
    free(entries);
    return drawn;
}

static bool draw_values(image_canvas *canvas, const image *picture, const image_values *values, int per_decade) {
    int lowest;
    image_value_scale scale = widest_scale(values, per_decade, &lowest);
    image_field f;
    if (!image_field_of(&f, values, &scale))
        return false;
    image_levels levels = {.scale = &scale, .palette = image_palette_find("vivid"), .without = -1};
    scale = fit_scale(&f, lowest, per_decade, &levels);
    bool drawn = draw(canvas, picture, &f, &levels);
    image_field_free(&f);
    return drawn;
}

static bool draw_contours(image_canvas *canvas, const image *picture, int per_decade) {
    image_values values;
    if (!image_values_of(&values, picture, IMAGE_LUMINOUS_EFFICACY))
        return false;
    raise_dark_values(&values);
    bool drawn = draw_values(canvas, picture, &values, per_decade);
    image_values_free(&values);
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
