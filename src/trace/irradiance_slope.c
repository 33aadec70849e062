/* Planes through what paths from a cell have found. */
#include "trace/irradiance_slope.h"

#include <math.h>

/* Added to the places' variance, which is 1/12 where they fill the cell: no slope is read off a spot or a line. */
#define PLACE_VARIANCE 0.005

void irradiance_add_place(irradiance_place_sums *s, irradiance_place at, rgb value) {
    double brightness = rgb_brightness(value);
    s->x += at.x;
    s->y += at.y;
    s->xx += at.x * at.x;
    s->xy += at.x * at.y;
    s->yy += at.y * at.y;
    s->value = rgb_add(s->value, value);
    s->x_value = rgb_add_scaled(s->x_value, at.x, value);
    s->y_value = rgb_add_scaled(s->y_value, at.y, value);
    s->brightness += brightness;
    s->squares += brightness * brightness;
    s->x_brightness += at.x * brightness;
    s->y_brightness += at.y * brightness;
}

irradiance_slope irradiance_find_slope(const irradiance_place_sums *s, size_t count) {
    double n = (double)count, x = s->x / n, y = s->y / n;
    double xx = s->xx / n - x * x + PLACE_VARIANCE, yy = s->yy / n - y * y + PLACE_VARIANCE, xy = s->xy / n - x * y;
    double bx = (s->x_brightness - x * s->brightness) / n, by = (s->y_brightness - y * s->brightness) / n;
    double determinant = xx * yy - xy * xy;
    double told = n * (yy * bx * bx - 2 * xy * bx * by + xx * by * by) / determinant;
    double rest = fmax(s->squares - s->brightness * s->brightness / n - told, 0) / (n - 3);
    double believed = told > 2 * rest ? (1 - 2 * rest / told) / determinant : 0;
    rgb vx = rgb_scale(believed / n, rgb_add_scaled(s->x_value, -x, s->value));
    rgb vy = rgb_scale(believed / n, rgb_add_scaled(s->y_value, -y, s->value));
    return (irradiance_slope){.middle = {x, y},
                              .x = rgb_add_scaled(rgb_scale(yy, vx), -xy, vy),
                              .y = rgb_add_scaled(rgb_scale(xx, vy), -xy, vx)};
}

static double limited(double change, double mean) {
    double limit = fmax(mean, 0);
    return fmax(fmin(change, limit), -limit);
}

rgb irradiance_at(const irradiance_slope *s, rgb mean, irradiance_place at) {
    rgb change = rgb_add_scaled(rgb_scale(at.x - s->middle.x, s->x), at.y - s->middle.y, s->y);
    return rgb_add(mean, (rgb){limited(change.r, mean.r), limited(change.g, mean.g), limited(change.b, mean.b)});
}
