/* Adaptive quadrature of functions that are smooth between known points and no worse than a square root at those. */
#ifndef BRDF_QUADRATURE_H
#define BRDF_QUADRATURE_H

/* A function, nowhere negative, of x and of what else it needs. */
typedef double brdf_integrand(const void *context, double x);

enum { BRDF_MOST_POINTS = 13 };

/* Where an integrand is not smooth, in ascending order. What lies outside of an integral's range has no effect on it.
 */
typedef struct brdf_points {
    int count;
    double at[BRDF_MOST_POINTS];
} brdf_points;

static const brdf_points brdf_no_points = {.count = 0};

/* Adds one, in its place. Nothing is checked: whoever adds them knows that there are no more than BRDF_MOST_POINTS,
 * which is what brdf_slope_mean adds where there is a kink. */
void brdf_points_add(brdf_points *, double x);

/* How an integrand is at those points, and at the ends: like any function that is smooth up to there, or like one of a
 * square root's kind. */
typedef enum brdf_ends { BRDF_ENDS_SMOOTH, BRDF_ENDS_ROOTS } brdf_ends;

/* The integral from `low` to `high`, good to a relative 1e-10 in all that this folder integrates. */
double brdf_integrate(brdf_integrand *function, const void *context, double low, double high, const brdf_points *points,
                      brdf_ends ends);

#endif
