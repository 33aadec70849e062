/* Least squares around a point: what many values say of the one in their midst, and how wrong that is. */
#ifndef PICTURE_LOCAL_FIT_H
#define PICTURE_LOCAL_FIT_H

#include <stdbool.h>

#include "base/vector.h"

/* A value that was found at (x, y), beside the point that is asked about, which is (0, 0). */
typedef struct local_fit_value {
    double x, y;   /* in units of about the largest of them */
    double weight; /* > 0 */
    rgb value;
} local_fit_value;

typedef struct local_fit {
    rgb value, error;     /* at the point, and its standard error */
    rgb slope_x, slope_y; /* how the value changes there */
} local_fit;

/* Lays a paraboloid through values whose errors are independent and alike. Their scatter about it tells how far chance
 * has led it astray; how much it differs at the point from a plane through the same values, how far its being no more
 * than a paraboloid may have. `shares[i]` becomes what value i counts for at the point. False: they are too few, or all
 * about on a line. */
bool local_fit_find(const local_fit_value *, int count, local_fit *, double *shares);

#endif
