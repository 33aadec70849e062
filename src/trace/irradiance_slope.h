/* How irradiance changes over a cell of the irradiance cache. */
#ifndef TRACE_IRRADIANCE_SLOPE_H
#define TRACE_IRRADIANCE_SLOPE_H

#include <stddef.h>

#include "base/vector.h"

/* Where in a cell, from its middle, in edges; the axis that the normal is nearest to does not count. */
typedef struct irradiance_place {
    double x, y;
} irradiance_place;

typedef struct irradiance_slope {
    irradiance_place middle; /* of the places that it is from */
    rgb x, y;                /* per edge */
} irradiance_slope;

/* Sums over paths from places in a cell. */
typedef struct irradiance_place_sums {
    double x, y, xx, xy, yy;
    rgb value, x_value, y_value;
    double brightness, squares, x_brightness, y_brightness;
} irradiance_place_sums;

void irradiance_add_place(irradiance_place_sums *, irradiance_place, rgb value);

/* The slope of a plane laid through `count` (more than 3) values by least squares; as much of it as their scatter lets
 * believe (as James and Stein shrink means). A mean alone would bring light from a cell's bright side to its dark one,
 * and what is dark would be too bright by it. */
irradiance_slope irradiance_find_slope(const irradiance_place_sums *, size_t count);

/* At a place, what is `mean` in the slope's middle. What is more than twice the mean, or less than nothing, no slope
 * tells. */
rgb irradiance_at(const irradiance_slope *, rgb mean, irradiance_place);

#endif
