/* Rows of a least-squares problem reduced to few that say the same: the triangle R of the rows' QR decomposition. */
#ifndef FIT_TRIANGLE_H
#define FIT_TRIANGLE_H

#include <stddef.h>

enum { FIT_TRIANGLE_COLUMNS_MAX = 5 };

typedef struct fit_triangle {
    int columns;
    double r[FIT_TRIANGLE_COLUMNS_MAX][FIT_TRIANGLE_COLUMNS_MAX]; /* [row][column], 0 below the diagonal */
} fit_triangle;                                                   /* begins as {columns}, of no rows */

/* Adds `count` rows to those that the triangle stands for: any sum of columns keeps the length that it has in all the
 * rows. The rows, an array a column, are used up. Numbers of up to 1e150 in up to 1e8 rows. */
void fit_triangle_add(fit_triangle *, double *const *columns, size_t count);

#endif
