/* Making a field, and where lines of its whole numbers pass. */
#include "image/contour_lines.h"

#include <math.h>
#include <stdlib.h>

static const double line_width = 1.6; /* in pixels */

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

/* The more pixels, the more their noise hides the picture's large forms; a pass widens the blur's variance by 1/2. */
static int smoothing_passes(const image_field *f) {
    int passes = 1 + (f->width > f->height ? f->width : f->height) / 160;
    return passes < 16 ? passes : 16;
}

static void smooth(image_field *f) {
    size_t width = (size_t)f->width, height = (size_t)f->height;
    for (int pass = 0; pass < smoothing_passes(f); pass++) {
        for (size_t y = 0; y < height; y++)
            smooth_line(f->places + y * width, f->width, 1);
        for (size_t x = 0; x < width; x++)
            smooth_line(f->places + x, f->height, width);
    }
}

bool image_field_of(image_field *f, const image_values *values, const image_value_scale *scale) {
    size_t count = (size_t)values->width * (size_t)values->height;
    *f = (image_field){values->width, values->height, malloc(count * sizeof(float))};
    if (!f->places)
        return false;
    for (size_t i = 0; i < count; i++) {
        /* What is far off the scale must not blur the lines at its ends, nor what is missing make lines of its own. */
        double at = isnan(values->values[i]) ? 0.5 : image_scale_position(scale, values->values[i]);
        f->places[i] = (float)fmin(fmax(at * scale->divisions, -1), scale->divisions + 1);
    }
    smooth(f);
    return true;
}

void image_field_free(image_field *f) {
    free(f->places);
    f->places = NULL;
}

static double place_at(const image_field *f, int x, int y) {
    x = x < 0 ? 0 : x >= f->width ? f->width - 1 : x;
    y = y < 0 ? 0 : y >= f->height ? f->height - 1 : y;
    return f->places[(size_t)y * (size_t)f->width + (size_t)x];
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
static double interpolate(const image_field *f, double x, double y, int zoom) {
    int left = (int)floor(x - 0.5), top = (int)floor(y - 0.5);
    if (zoom == 1)
        return place_at(f, left, top);
    double across[4], down[4], sum = 0;
    spline_weights(x - 0.5 - left, across);
    spline_weights(y - 0.5 - top, down);
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 4; i++)
            sum += down[j] * across[i] * place_at(f, left - 1 + i, top - 1 + j);
    return sum;
}

/* The level whose line passes nearest to the middle one of 3 x 3 values, by the field's slope there, and how much of
 * the pixel it covers, from 0 to 1. Lines pass only where the values lie on both sides of the level. */
static double nearest_line(double values[3][3], int *level) {
    double low = values[1][1], high = low;
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) {
            low = fmin(low, values[j][i]);
            high = fmax(high, values[j][i]);
        }
    *level = (int)lround(values[1][1]);
    double at = *level;
    if (!(low < at && at <= high))
        return 0;
    double slope = hypot((values[1][2] - values[1][0]) / 2, (values[2][1] - values[0][1]) / 2);
    /* At a crest or a saddle the slope vanishes; the spread of the values takes its place. */
    slope = fmax(slope, (high - low) / 4);
    double distance = fabs(values[1][1] - at) / slope;
    return fmin(fmax((line_width + 1) / 2 - distance, 0), 1);
}

void image_draw_contour_lines(image_canvas *canvas, int left, const image_field *f, int zoom, const image_levels *l) {
    for (int y = 0; y < f->height * zoom; y++)
        for (int x = 0; x < f->width * zoom; x++) {
            double values[3][3];
            for (int j = 0; j < 3; j++)
                for (int i = 0; i < 3; i++)
                    values[j][i] = interpolate(f, (x + i - 0.5) / zoom, (y + j - 0.5) / zoom, zoom);
            int level;
            double cover = nearest_line(values, &level);
            if (cover <= 0)
                continue;
            unsigned char color[3];
            if (image_level_color(l, level, color))
                image_blend(canvas, left + x, y, cover, color);
        }
}
