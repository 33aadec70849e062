/* Weighted least squares with a plane and with a paraboloid. */
#include "picture/local_fit.h"

#include <math.h>

enum { PLANE = 3, PARABOLOID = 6 };

/* So many more values than coefficients there are at least: else their scatter would say too little. */
#define FEWEST_VALUES (2 * PARABOLOID)
/* Of the values' weight: what a pivot has at least. Less is left where the values are all about on a line. */
#define SMALLEST_PIVOT 1e-5

/* How much of the difference to the plane counts as a standard error. */
#define DIFFERENCE_BELIEVED 0.5

typedef double matrix[PARABOLOID][PARABOLOID];

static void find_terms(const local_fit_value *v, double terms[PARABOLOID]) {
    terms[0] = 1;
    terms[1] = v->x;
    terms[2] = v->y;
    terms[3] = v->x * v->x;
    terms[4] = v->x * v->y;
    terms[5] = v->y * v->y;
}

static void add_product(matrix m, int size, const double terms[PARABOLOID], double weight) {
    for (int j = 0; j < size; j++)
        for (int k = 0; k < size; k++)
            m[j][k] += weight * terms[j] * terms[k];
}

/* Inverts a positive definite matrix in place (Gauss and Jordan). False: it hardly is. */
static bool invert(matrix m, int size) {
    double smallest = SMALLEST_PIVOT * m[0][0];
    for (int i = 0; i < size; i++) {
        double pivot = m[i][i];
        if (!(pivot > smallest))
            return false;
        m[i][i] = 1;
        for (int j = 0; j < size; j++)
            m[i][j] /= pivot;
        for (int k = 0; k < size; k++) {
            double factor = k == i ? 0 : m[k][i];
            m[k][i] = k == i ? m[k][i] : 0;
            for (int j = 0; j < size; j++)
                m[k][j] -= factor * m[i][j];
        }
    }
    return true;
}

/* A surface through the values. */
typedef struct surface_fit {
    matrix inverse;
    rgb coefficients[PARABOLOID];
    double freedom; /* what is left of the weight: of the expectation of the squares below, in a value's variance */
} surface_fit;

static bool fit_surface(const local_fit_value *values, int count, int size, surface_fit *f) {
    *f = (surface_fit){.freedom = 0};
    for (int i = 0; i < count; i++) {
        double terms[PARABOLOID];
        find_terms(&values[i], terms);
        add_product(f->inverse, size, terms, values[i].weight);
    }
    if (!invert(f->inverse, size))
        return false;
    for (int i = 0; i < count; i++) {
        double terms[PARABOLOID], leverage = 0;
        find_terms(&values[i], terms);
        for (int j = 0; j < size; j++) {
            double influence = 0;
            for (int k = 0; k < size; k++)
                influence += f->inverse[j][k] * terms[k];
            f->coefficients[j] = rgb_add_scaled(f->coefficients[j], values[i].weight * influence, values[i].value);
            leverage += influence * terms[j];
        }
        f->freedom += values[i].weight * (1 - values[i].weight * leverage);
    }
    return true;
}

/* Weighted squares of what the surface leaves of the values. */
static rgb squares_left(const local_fit_value *values, int count, const surface_fit *f) {
    rgb squares = {0, 0, 0};
    for (int i = 0; i < count; i++) {
        double terms[PARABOLOID];
        find_terms(&values[i], terms);
        rgb left = values[i].value;
        for (int j = 0; j < PARABOLOID; j++)
            left = rgb_add_scaled(left, -terms[j], f->coefficients[j]);
        squares = rgb_add_scaled(squares, values[i].weight, rgb_multiply(left, left));
    }
    return squares;
}

/* What each value counts for at the point; the sum of the squares of that. */
static double find_shares(const local_fit_value *values, int count, const surface_fit *f, double *shares) {
    double squares = 0;
    for (int i = 0; i < count; i++) {
        double terms[PARABOLOID];
        find_terms(&values[i], terms);
        shares[i] = 0;
        for (int k = 0; k < PARABOLOID; k++)
            shares[i] += values[i].weight * f->inverse[0][k] * terms[k];
        squares += shares[i] * shares[i];
    }
    return squares;
}

bool local_fit_find(const local_fit_value *values, int count, local_fit *found, double *shares) {
    surface_fit plane, paraboloid;
    if (count < FEWEST_VALUES || !fit_surface(values, count, PLANE, &plane) ||
        !fit_surface(values, count, PARABOLOID, &paraboloid) || !(paraboloid.freedom > 0))
        return false;
    /* Values of little weight count little; of those that do count there are about half as many. The variance of
     * Student's distribution widens what few tell. */
    double freedom = (count - PARABOLOID) / 2.0, student = freedom / (freedom - 2);
    double scale = student * find_shares(values, count, &paraboloid, shares) / paraboloid.freedom;
    rgb variance = rgb_scale(scale, squares_left(values, count, &paraboloid));
    rgb difference = rgb_add_scaled(paraboloid.coefficients[0], -1, plane.coefficients[0]);
    difference = rgb_scale(DIFFERENCE_BELIEVED, difference);
    variance = rgb_add(variance, rgb_multiply(difference, difference));
    found->value = paraboloid.coefficients[0];
    found->slope_x = paraboloid.coefficients[1];
    found->slope_y = paraboloid.coefficients[2];
    found->error = (rgb){sqrt(variance.r), sqrt(variance.g), sqrt(variance.b)};
    return true;
}
