/* Lines of equal luminance over a picture, as in the paper's Figures 2 and 8. */
#include "image/image.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "image/color.h"
#include "image/font.h"
#include "image/formats.h"

enum { DECADES = 4 };         /* as many below the maximum, and no more */
enum { SMALLEST_SIDE = 400 }; /* smaller pictures are enlarged, by a whole number */
enum { LARGEST_ZOOM = 32 };
static const double line_width = 1.6; /* in pixels */

/* log10 of the luminance in cd/m^2, smoothed, at the picture's pixels. */
typedef struct field {
    int width, height;
    float *values;
    double minimum, maximum;
} field;

/* Levels first, first + 1, ... are at 10^(level / per_decade). */
typedef struct levels {
    int first, count, per_decade;
} levels;

static double luminance(const image *picture, size_t i) {
    return IMAGE_LUMINOUS_EFFICACY * image_brightness(picture->channels, i);
}

/* Smooths one line of values, `stride` apart, with weights 1 2 1; the ends count themselves twice. */
static void smooth_line(float *values, int count, size_t stride) {
    float before = values[0];
    for (int i = 0; i < count; i++) {
        float here = values[(size_t)i * stride];
        float after = i + 1 < count ? values[(size_t)(i + 1) * stride] : here;
        values[(size_t)i * stride] = (before + 2 * here + after) / 4;
        before = here;
    }
}

static int longer_side(const image *picture) {
    return picture->width > picture->height ? picture->width : picture->height;
}

/* The more pixels, the more their noise hides the picture's large forms; a pass widens the blur's variance by 1/2. */
static int smoothing_passes(const image *picture) {
    int passes = 1 + longer_side(picture) / 160;
    return passes < 16 ? passes : 16;
}

static bool make_field(field *f, const image *picture) {
    size_t width = (size_t)picture->width, height = (size_t)picture->height;
    *f = (field){picture->width, picture->height, malloc(width * height * sizeof(float)), HUGE_VAL, -HUGE_VAL};
    if (!f->values)
        return false;
    double brightest = 0;
    for (size_t i = 0; i < width * height; i++)
        brightest = fmax(brightest, luminance(picture, i));
    /* A little below the lowest level, so that black is below it too. */
    double floor_value = brightest > 0 ? log10(brightest) - DECADES - 0.01 : 0;
    for (size_t i = 0; i < width * height; i++) {
        double here = luminance(picture, i);
        f->values[i] = (float)(here > 0 ? fmax(log10(here), floor_value) : floor_value);
    }
    for (int pass = 0; pass < smoothing_passes(picture); pass++) {
        for (size_t y = 0; y < height; y++)
            smooth_line(f->values + y * width, picture->width, 1);
        for (size_t x = 0; x < width; x++)
            smooth_line(f->values + x, picture->height, width);
    }
    for (size_t i = 0; i < width * height; i++) {
        f->minimum = fmin(f->minimum, f->values[i]);
        f->maximum = fmax(f->maximum, f->values[i]);
    }
    return true;
}

static levels choose_levels(const field *f, int per_decade) {
    double lowest = fmax(f->minimum, f->maximum - DECADES);
    int first = (int)ceil(lowest * per_decade), last = (int)floor(f->maximum * per_decade);
    return (levels){first, last < first ? 0 : last - first + 1, per_decade};
}

/* Blue at the lowest through green and yellow to red at the highest: all bright, to be seen on the picture. */
static void level_color(const levels *l, int level, unsigned char color[3]) {
    static const unsigned char stops[][3] = {{80, 110, 255}, {0, 200, 255}, {0, 220, 90},  {255, 235, 0},
                                             {255, 140, 0},  {255, 40, 40}, {255, 90, 220}};
    enum { LAST = sizeof stops / sizeof *stops - 1 };
    double at = l->count > 1 ? LAST * (double)(level - l->first) / (l->count - 1) : LAST / 2.0;
    int stop = at < LAST ? (int)at : LAST - 1;
    for (int c = 0; c < 3; c++)
        color[c] = (unsigned char)(stops[stop][c] + (at - stop) * (stops[stop + 1][c] - stops[stop][c]) + 0.5);
}

static double value_at(const field *f, int x, int y) {
    x = x < 0 ? 0 : x >= f->width ? f->width - 1 : x;
    y = y < 0 ? 0 : y >= f->height ? f->height - 1 : y;
    return f->values[(size_t)y * (size_t)f->width + (size_t)x];
}

/* Weights of the uniform cubic B-spline, whose contours have no kinks, between the second and third of four points. */
static void spline_weights(double t, double weights[4]) {
    double s = 1 - t;
    weights[0] = s * s * s / 6;
    weights[1] = (4 - 6 * t * t + 3 * t * t * t) / 6;
    weights[2] = (4 - 6 * s * s + 3 * s * s * s) / 6;
    weights[3] = t * t * t / 6;
}

/* The field at a point in pixels; pixel centres are at halves. An unmagnified picture has its own values. */
static double interpolate(const field *f, double x, double y, int zoom) {
    int left = (int)floor(x - 0.5), top = (int)floor(y - 0.5);
    if (zoom == 1)
        return value_at(f, left, top);
    double across[4], down[4], sum = 0;
    spline_weights(x - 0.5 - left, across);
    spline_weights(y - 0.5 - top, down);
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 4; i++)
            sum += down[j] * across[i] * value_at(f, left - 1 + i, top - 1 + j);
    return sum;
}

/* The level whose line passes nearest to the middle one of 3 x 3 values, by the field's slope there, and how much of
 * the pixel it covers, from 0 to 1. Lines pass only where the values lie on both sides of the level. */
static double nearest_line(const levels *l, double values[3][3], int *level) {
    double low = values[1][1], high = low;
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) {
            low = fmin(low, values[j][i]);
            high = fmax(high, values[j][i]);
        }
    *level = (int)lround(values[1][1] * l->per_decade);
    double at = (double)*level / l->per_decade;
    if (!(low < at && at <= high) || *level < l->first || *level >= l->first + l->count)
        return 0;
    double slope = hypot((values[1][2] - values[1][0]) / 2, (values[2][1] - values[0][1]) / 2);
    /* At a crest or a saddle the slope vanishes; the spread of the values takes its place. */
    slope = fmax(slope, (high - low) / 4);
    double distance = fabs(values[1][1] - at) / slope;
    return fmin(fmax((line_width + 1) / 2 - distance, 0), 1);
}

static void draw_lines(image_canvas *canvas, int left, const field *f, const levels *l, int zoom) {
    for (int y = 0; y < f->height * zoom; y++)
        for (int x = 0; x < f->width * zoom; x++) {
            double values[3][3];
            for (int j = 0; j < 3; j++)
                for (int i = 0; i < 3; i++)
                    values[j][i] = interpolate(f, (x + i - 0.5) / zoom, (y + j - 0.5) / zoom, zoom);
            int level;
            double cover = nearest_line(l, values, &level);
            if (cover <= 0)
                continue;
            unsigned char color[3];
            level_color(l, level, color);
            unsigned char *pixel = canvas->bytes + 3 * ((size_t)y * (size_t)canvas->width + (size_t)(left + x));
            for (int c = 0; c < 3; c++)
                pixel[c] = (unsigned char)(pixel[c] + cover * (color[c] - pixel[c]) + 0.5);
        }
}

/* The exposed picture, enlarged, a little darker than usual so that the lines stand out. */
static bool draw_background(image_canvas *canvas, int left, const image *picture, int zoom) {
    unsigned char *bytes = malloc(3 * (size_t)picture->width * (size_t)picture->height);
    if (!bytes)
        return false;
    image_expose(picture, bytes);
    for (int y = 0; y < picture->height * zoom; y++)
        for (int x = 0; x < picture->width * zoom; x++)
            for (int c = 0; c < 3; c++)
                canvas->bytes[3 * ((size_t)y * (size_t)canvas->width + (size_t)(left + x)) + (size_t)c] =
                    (unsigned char)(bytes[3 * ((size_t)(y / zoom) * (size_t)picture->width + (size_t)(x / zoom)) +
                                          (size_t)c] *
                                    3 / 4);
    free(bytes);
    return true;
}

enum { LEGEND_LETTERS = 13, LEGEND_MARGIN = 6 };
enum { ROW = IMAGE_FONT_HEIGHT + 5 };

static int legend_width(int scale) {
    return (2 * LEGEND_MARGIN + LEGEND_LETTERS * IMAGE_FONT_ADVANCE) * scale;
}

/* Rounded to three significant digits, so that 17783 reads 17800. */
static double three_digits(double value) {
    double unit = pow(10, floor(log10(value)) - 2);
    return round(value / unit) * unit;
}

/* From the highest level at the top to the lowest; where there is not room for all, every second, third ... */
static void draw_legend(image_canvas *canvas, const levels *l, int scale) {
    static const unsigned char white[3] = {255, 255, 255};
    int margin = LEGEND_MARGIN * scale, row = ROW * scale, y = margin;
    image_draw_text(canvas, margin, y, scale, white, "cd/m2");
    int room = (canvas->height - 2 * margin) / row - 1;
    int step = room > 0 ? (l->count + room - 1) / room : l->count;
    if (step < 1)
        step = 1;
    for (int i = 0; i < l->count; i += step) {
        int level = l->first + l->count - 1 - i;
        unsigned char color[3];
        char number[NUMBER_TEXT_SIZE];
        level_color(l, level, color);
        number_print(number, 6, three_digits(pow(10, (double)level / l->per_decade)));
        y += row;
        int dash = 2 * IMAGE_FONT_ADVANCE * scale;
        image_fill(canvas, margin, y + IMAGE_FONT_HEIGHT / 2 * scale - scale / 2, dash, 2 * scale, color);
        image_draw_text(canvas, margin + dash + IMAGE_FONT_ADVANCE * scale, y, scale, white, number);
    }
}

static int choose_zoom(const image *picture) {
    int side = longer_side(picture);
    int zoom = (SMALLEST_SIDE + side - 1) / side;
    return zoom < LARGEST_ZOOM ? zoom : LARGEST_ZOOM;
}

static bool draw(image_canvas *canvas, const image *picture, int per_decade) {
    int zoom = choose_zoom(picture);
    int scale = picture->height * zoom >= 1000 ? 2 : 1;
    int left = legend_width(scale);
    field f;
    if (!make_field(&f, picture))
        return false;
    levels l = choose_levels(&f, per_decade);
    int least_height = (2 * LEGEND_MARGIN + 4 * ROW) * scale;
    canvas->width = left + picture->width * zoom;
    canvas->height = picture->height * zoom > least_height ? picture->height * zoom : least_height;
    canvas->bytes = calloc((size_t)canvas->width * (size_t)canvas->height, 3);
    bool drawn = canvas->bytes && draw_background(canvas, left, picture, zoom);
    if (drawn) {
        draw_lines(canvas, left, &f, &l, zoom);
        draw_legend(canvas, &l, scale);
    }
    free(f.values);
    return drawn;
}

/* The drawing as a picture of linear values, for formats that hold such. */
static image *linear_picture(const image_canvas *canvas) {
    image *picture = image_create(canvas->width, canvas->height, 3, NULL);
    size_t count = (size_t)canvas->width * (size_t)canvas->height;
    for (size_t i = 0; picture && i < 3 * count; i++)
        picture->channels[i % 3][i / 3] = (float)image_srgb_decode(canvas->bytes[i] / 255.);
    return picture;
}

static graze_status write_canvas(const image_canvas *canvas, const image *picture, const char *file,
                                 const graze_report *report) {
    if (image_format_of(file) == IMAGE_FORMAT_OTHER)
        return image_write_bytes(picture, canvas->width, canvas->height, canvas->bytes, file, report);
    image *drawing = linear_picture(canvas);
    if (!drawing)
        return report_out_of_memory(report);
    drawing->command = picture->command;
    drawing->software = picture->software;
    graze_status status = image_write(drawing, file, report);
    image_destroy(drawing);
    return status;
}

graze_status image_write_contours(const image *picture, const char *file, int per_decade, const graze_report *report) {
    image_canvas canvas = {0};
    if (per_decade < 1 || per_decade > 100)
        return report_error(report, NULL, "contours: %d levels a factor of ten, not 1 to 100", per_decade);
    graze_status status = image_check_writable(file, report);
    if (status == GRAZE_OK)
        status = draw(&canvas, picture, per_decade) ? write_canvas(&canvas, picture, file, report)
                                                    : report_out_of_memory(report);
    free(canvas.bytes);
    return status;
}
