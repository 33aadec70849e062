/* Householder's reflections of a triangle and the rows below it. */
#include "fit/triangle.h"

#include <math.h>

/* Shorter columns count as 0: their squares would not be exact. */
#define LENGTH_MIN 1e-150

/* In four sums, which can be added up side by side. */
static double dot(const double *a, const double *b, size_t count) {
    double sums[4] = {0};
    size_t i = 0;
    for (; i + 4 <= count; i += 4)
        for (size_t k = 0; k < 4; k++)
            sums[k] += a[i + k] * b[i + k];
    for (; i < count; i++)
        sums[0] += a[i] * b[i];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/* The mirror vector of column k is `head` on the diagonal, the column below; I - v v'/(head length) takes the column to
 * -+length on the diagonal. */
void fit_triangle_add(fit_triangle *t, double *const *columns, size_t count) {
    for (int k = 0; k < t->columns; k++) {
        const double *mirror = columns[k];
        double diagonal = t->r[k][k], length = sqrt(diagonal * diagonal + dot(mirror, mirror, count));
        if (!(length > LENGTH_MIN))
            continue;
        double image = diagonal > 0 ? -length : length, head = diagonal - image;
        for (int j = k + 1; j < t->columns; j++) {
            double share = (head * t->r[k][j] + dot(mirror, columns[j], count)) / (head * image);
            t->r[k][j] += share * head;
            for (size_t i = 0; i < count; i++)
                columns[j][i] += share * mirror[i];
        }
        t->r[k][k] = image;
    }
}
