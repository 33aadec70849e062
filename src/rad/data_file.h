/* Radiance's data files: numbers over a grid of up to six dimensions, and what is between them. */
#ifndef RAD_DATA_FILE_H
#define RAD_DATA_FILE_H

#include <stddef.h>

#include "base/arena.h"
#include "base/report.h"

enum { RAD_DATA_DIMENSIONS = 6 };

typedef struct rad_data_axis {
    double begin, length; /* of the evenly spaced places; length < 0 where they go down */
    size_t count;         /* of places, at least 2 */
    const double *places; /* null: evenly spaced */
} rad_data_axis;

typedef struct rad_data {
    int dimensions;
    rad_data_axis axes[RAD_DATA_DIMENSIONS];
    const float *values; /* of the last dimension next to each other */
} rad_data;

/* Reads the file into the arena. Messages call it `name`, and say where it was asked for. */
graze_status rad_data_read(rad_data *, arena *, const char *path, const char *name, const place *where,
                           const graze_report *);

/* The same of a text, which need not last. */
graze_status rad_data_parse(rad_data *, arena *, const char *text, size_t length, const char *name, const place *where,
                            const graze_report *);

/* The values at a point, one coordinate a dimension, of each of `count` planes over the grid (of a data file: its
 * `values`): linear in each coordinate. Up to one step outside of the grid they go on linearly, and beyond that fall
 * off as Radiance's do: by the reciprocal of the distance. Finite for finite coordinates below 1e150. */
void rad_data_values(const rad_data *grid, const float *const *planes, int count, const double *point, double *values);

#endif
