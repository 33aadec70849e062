/* Nonlinear least squares within bounds: Levenberg-Marquardt (MINPACK's) from several starting points, and what the
 * minimum says of the parameters' uncertainty. */
#ifndef FIT_LEAST_SQUARES_H
#define FIT_LEAST_SQUARES_H

#include <stdbool.h>
#include <stddef.h>

#include "base/report.h"

typedef enum fit_range_kind {
    FIT_RANGE_FREE,     /* any number */
    FIT_RANGE_INTERVAL, /* low to high, by x = low + (high - low) sin^2 q */
    FIT_RANGE_LOG,      /* the same for the logarithms; low > 0 */
} fit_range_kind;

typedef struct fit_range {
    fit_range_kind kind;
    double low, high;
} fit_range;

typedef struct fit_problem {
    size_t residual_count;
    size_t observation_count; /* what the residuals stand for, if that is more; 0: each for one */
    int parameter_count;
    const fit_range *ranges; /* one a parameter */
    void *user;
    /* The residuals at the parameters, which are within their ranges. */
    void (*residuals)(void *user, const double *parameters, double *residuals);
    /* Their derivatives: jacobian[k * residual_count + i] is that of residual i by parameter k. */
    void (*jacobian)(void *user, const double *parameters, double *jacobian);
} fit_problem;

typedef enum fit_state {
    FIT_DETERMINED,
    FIT_AT_LOW, /* at a bound: the error is 0, and those of the others are for it held there */
    FIT_AT_HIGH,
    FIT_UNDETERMINED, /* the residuals do not depend on it, or not otherwise than on others; the error is 0 */
} fit_state;

typedef struct fit_estimate {
    double value, error; /* the standard error, the residuals' variance being taken from their own size */
    fit_state state;
} fit_estimate;

typedef struct fit_minimum {
    double sum;              /* of the squared residuals */
    size_t degrees;          /* of freedom: observations less parameters that are not at a bound; may be 0 */
    double condition;        /* of the Jacobian with columns of length 1: 1 is best; 0: some are undetermined */
    bool converged;          /* false: MINPACK gave up after thousands of steps */
    size_t start;            /* the number of the starting point that led here */
    fit_estimate *estimates; /* parameter_count, the caller's memory */
} fit_minimum;

/* Parameters that run into a bound are set on it and held there, unless the sum falls away from it.
 *
 * The least of the minima that the starting points (parameter_count numbers each, inside their ranges) lead to. Minima
 * that are as good within the noise, but elsewhere, are looked for too: the next best of them goes into `rival`, whose
 * `estimates` is null if there is none; `rival_estimates` is room for it. */
graze_status fit_minimise(const fit_problem *, const double *starts, size_t start_count, fit_minimum *,
                          fit_minimum *rival, fit_estimate *rival_estimates, const graze_report *);

#endif
