/* MINPACK's Levenberg-Marquardt behind transformed parameters, and the covariance of what it finds. */
#include "fit/least_squares.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cminpack-1/cminpack.h>

/* Steps that lead out of what can be computed must look bad, not infinite. */
#define RESIDUAL_MAX 1e150
/* As close to a bound as that, of the range's width, is at it. */
#define BOUND_MARGIN 1e-6
/* Below this, of the largest, a diagonal element of R counts as 0. */
#define RANK_TOLERANCE 1e-10
/* A parameter takes part in a combination that leaves the residuals alone from this share on. */
#define SHARE_MIN 1e-6
/* Sums of squares that differ by less than this many variances are as good as each other: two standard deviations. */
#define RIVAL_VARIANCES 4.0

/* Within this of a bound, of the range's width, a parameter that the sum's slope drives there is taken to it; a slope
 * is the cosine of an angle, and so much of it is none. */
#define NEAR_BOUND .02
#define SLOPE_MIN  1e-7

/* The calls allowed before bounds are looked at, doubled when they do not suffice. */
enum { CALLS_FIRST = 30, CALLS_MAX = 4000, POINT_ARRAYS = 7, RELEASES_MAX = 4 };

typedef struct solver {
    const fit_problem *problem;
    size_t m, observations;
    int n;
    double *parameters;          /* n, inside their ranges */
    double *residuals, *scratch; /* m each */
    double *jacobian;            /* m x n */
    double *point;               /* POINT_ARRAYS x n: MINPACK's own */
    double *normal;              /* n x n */
    double *lengths;             /* n: of the jacobian's columns */
    int *pivots, *free_columns;  /* n each */
    int free_count;              /* of parameters that are not held at a bound, the first of free_columns */
    int *releases;               /* n: how often each has been let go */
    fit_state *states;           /* n: FIT_DETERMINED, or the bound where it is held */
} solver;

static void solver_free(solver *s) {
    free(s->parameters);
    free(s->residuals);
    free(s->scratch);
    free(s->jacobian);
    free(s->point);
    free(s->normal);
    free(s->lengths);
    free(s->pivots);
    free(s->free_columns);
    free(s->releases);
    free(s->states);
}

static graze_status solver_begin(solver *s, const fit_problem *problem, const graze_report *report) {
    *s = (solver){.problem = problem, .m = problem->residual_count, .n = problem->parameter_count};
    size_t m = s->m, n = (size_t)s->n;
    s->observations = problem->observation_count ? problem->observation_count : m;
    if (s->observations <= n)
        return report_error(report, NULL, "too few values for %zu parameters: %zu", n, s->observations);
    if (m > INT_MAX || m > SIZE_MAX / sizeof(double) / n)
        return report_error(report, NULL, "too many values: %zu", m);
    s->parameters = calloc(n, sizeof *s->parameters);
    s->residuals = calloc(m, sizeof *s->residuals);
    s->scratch = calloc(m, sizeof *s->scratch);
    s->jacobian = calloc(m, n * sizeof *s->jacobian);
    s->point = calloc(n, POINT_ARRAYS * sizeof *s->point);
    s->normal = calloc(n, n * sizeof *s->normal);
    s->lengths = calloc(n, sizeof *s->lengths);
    s->pivots = calloc(n, sizeof *s->pivots);
    s->free_columns = calloc(n, sizeof *s->free_columns);
    s->releases = calloc(n, sizeof *s->releases);
    s->states = calloc(n, sizeof *s->states);
    bool all = s->parameters && s->residuals && s->scratch && s->jacobian && s->point && s->normal && s->lengths &&
               s->pivots && s->free_columns && s->releases && s->states;
    return all ? GRAZE_OK : report_out_of_memory(report);
}

static double clamp(double x, double low, double high) {
    return fmin(fmax(x, low), high);
}

/* The parameter of an unbounded q, and its derivative. */
static double from_unbounded(const fit_range *r, double q, double *derivative) {
    bool logarithmic = r->kind == FIT_RANGE_LOG;
    double low = logarithmic ? log(r->low) : r->low, high = logarithmic ? log(r->high) : r->high, s = sin(q);
    if (r->kind == FIT_RANGE_FREE) {
        *derivative = 1;
        return q;
    }
    double x = low + (high - low) * s * s;
    *derivative = (high - low) * sin(2 * q);
    if (!logarithmic)
        return clamp(x, low, high);
    x = clamp(exp(x), r->low, r->high);
    *derivative *= x;
    return x;
}

static double to_unbounded(const fit_range *r, double x) {
    bool logarithmic = r->kind == FIT_RANGE_LOG;
    if (r->kind == FIT_RANGE_FREE)
        return x;
    double low = logarithmic ? log(r->low) : r->low, high = logarithmic ? log(r->high) : r->high;
    return asin(sqrt(clamp(((logarithmic ? log(x) : x) - low) / (high - low), 0, 1)));
}

/* How far it is from the lower bound to the upper one, 0 to 1. */
static double share_of(const fit_range *r, double x) {
    double s = sin(to_unbounded(r, x));
    return r->kind == FIT_RANGE_FREE ? .5 : s * s;
}

static void make_finite(double *values, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!(fabs(values[i]) <= RESIDUAL_MAX))
            values[i] = RESIDUAL_MAX;
}

/* MINPACK's view: the free parameters alone, unbounded. The Jacobian's memory has room for all columns. */
static int call_back(void *user, int m, int n, const double *q, double *residuals, double *jacobian, int stride,
                     int what) {
    solver *s = user;
    double *derivatives = s->point + (size_t)(POINT_ARRAYS - 1) * (size_t)s->n;
    size_t rows = (size_t)m;
    (void)stride;
    for (int k = 0; k < n; k++)
        s->parameters[s->free_columns[k]] =
            from_unbounded(&s->problem->ranges[s->free_columns[k]], q[k], &derivatives[k]);
    if (what == 1) {
        s->problem->residuals(s->problem->user, s->parameters, residuals);
        make_finite(residuals, rows);
        return 0;
    }
    s->problem->jacobian(s->problem->user, s->parameters, jacobian);
    for (int k = 0; k < n; k++) {
        const double *from = jacobian + (size_t)s->free_columns[k] * rows;
        double *to = jacobian + (size_t)k * rows;
        for (size_t i = 0; i < rows; i++)
            to[i] = from[i] * derivatives[k];
    }
    make_finite(jacobian, rows * (size_t)n);
    return 0;
}

/* Keeps in the Jacobian the columns of free parameters, scaled to length 1. */
static void scale_free_columns(solver *s) {
    for (int k = 0; k < s->free_count; k++) {
        double *from = s->jacobian + (size_t)s->free_columns[k] * s->m, *to = s->jacobian + (size_t)k * s->m;
        double length = enorm((int)s->m, from);
        for (size_t i = 0; i < s->m; i++)
            to[i] = length > 0 ? from[i] / length : 0;
        s->lengths[k] = length;
    }
}

/* The largest sum of absolute values in a column. */
static double norm1(const double *matrix, int n, size_t stride) {
    double most = 0;
    for (int k = 0; k < n; k++) {
        double sum = 0;
        for (int i = 0; i < n; i++)
            sum += fabs(matrix[(size_t)k * stride + (size_t)i]);
        most = fmax(most, sum);
    }
    return most;
}

static double normal_norm(solver *s, int n) {
    for (int a = 0; a < n; a++)
        for (int b = 0; b <= a; b++) {
            double sum = 0;
            for (size_t i = 0; i < s->m; i++)
                sum += s->jacobian[(size_t)a * s->m + i] * s->jacobian[(size_t)b * s->m + i];
            s->normal[a * n + b] = s->normal[b * n + a] = sum;
        }
    return norm1(s->normal, n, (size_t)n);
}

/* Column k of R, beyond its rank, is a combination of those before: all parameters that take part in it are
 * undetermined, for they can change together without the residuals changing. */
static void mark_undetermined(solver *s, fit_estimate *estimates, int rank, int k, double *shares) {
    const double *r = s->jacobian, *column = r + (size_t)k * s->m;
    estimates[s->free_columns[s->pivots[k] - 1]].state = FIT_UNDETERMINED;
    for (int i = rank - 1; i >= 0; i--) {
        shares[i] = column[i];
        for (int j = i + 1; j < rank; j++)
            shares[i] -= r[(size_t)j * s->m + (size_t)i] * shares[j];
        shares[i] /= r[(size_t)i * s->m + (size_t)i];
        if (fabs(shares[i]) > SHARE_MIN)
            estimates[s->free_columns[s->pivots[i] - 1]].state = FIT_UNDETERMINED;
    }
}

/* Standard errors in the parameters' own scale, from J scaled = Q R and the inverse of R'R. */
static void find_errors(solver *s, fit_minimum *minimum) {
    s->problem->jacobian(s->problem->user, s->parameters, s->jacobian);
    make_finite(s->jacobian, s->m * (size_t)s->n);
    int n = s->free_count;
    scale_free_columns(s);
    minimum->degrees = s->observations - (size_t)n;
    minimum->condition = n == 0;
    if (n == 0)
        return;
    double normal = normal_norm(s, n), *diagonal = s->point, *norms = s->point + n, *work = s->point + 2 * n;
    qrfac((int)s->m, n, s->jacobian, (int)s->m, 1, s->pivots, n, diagonal, norms, work);
    for (int k = 0; k < n; k++)
        s->jacobian[(size_t)k * s->m + (size_t)k] = diagonal[k];
    int rank = 0;
    while (rank < n && fabs(diagonal[rank]) > RANK_TOLERANCE * fabs(diagonal[0]))
        rank++;
    for (int k = rank; k < n; k++)
        mark_undetermined(s, minimum->estimates, rank, k, work);
    covar(n, s->jacobian, (int)s->m, s->pivots, RANK_TOLERANCE, work);
    double variance = minimum->degrees > 0 ? minimum->sum / (double)minimum->degrees : 0;
    for (int k = 0; k < n; k++) {
        fit_estimate *estimate = &minimum->estimates[s->free_columns[k]];
        double share = s->jacobian[(size_t)k * s->m + (size_t)k];
        if (estimate->state == FIT_DETERMINED)
            estimate->error = sqrt(fmax(variance * share, 0)) / s->lengths[k];
    }
    minimum->condition = rank < n ? 0 : fmax(sqrt(normal * norm1(s->jacobian, n, s->m)), 1);
}

/* Levenberg and Marquardt's way from where the parameters are, with so many calls at most. */
static int descend(solver *s, int calls_max) {
    size_t n = (size_t)s->n;
    double *q = s->point, *diagonal = q + n, *qtf = q + 2 * n, *w1 = q + 3 * n, *w2 = q + 4 * n, *w3 = q + 5 * n;
    double derivative;
    int calls = 0, jacobians = 0;
    s->free_count = 0;
    for (int k = 0; k < s->n; k++)
        if (s->states[k] == FIT_DETERMINED)
            s->free_columns[s->free_count++] = k;
    for (int k = 0; k < s->free_count; k++)
        q[k] = to_unbounded(&s->problem->ranges[s->free_columns[k]], s->parameters[s->free_columns[k]]);
    if (s->free_count == 0) {
        call_back(s, (int)s->m, 0, q, s->residuals, s->jacobian, (int)s->m, 1);
        return 1;
    }
    int outcome =
        lmder(call_back, s, (int)s->m, s->free_count, q, s->residuals, s->jacobian, (int)s->m, DBL_EPSILON, DBL_EPSILON,
              0, calls_max, diagonal, 1, 1, 0, &calls, &jacobians, s->pivots, qtf, w1, w2, w3, s->scratch);
    for (int k = 0; k < s->free_count; k++)
        s->parameters[s->free_columns[k]] = from_unbounded(&s->problem->ranges[s->free_columns[k]], q[k], &derivative);
    return outcome;
}

/* Which way the sum falls with a parameter: the cosine between the residuals and the parameter's column. */
static double slope_of(const solver *s, int k) {
    const double *column = s->jacobian + (size_t)k * s->m;
    double lengths = enorm((int)s->m, column) * enorm((int)s->m, s->residuals), sum = 0;
    if (!(lengths > 0))
        return 0;
    for (size_t i = 0; i < s->m; i++)
        sum += column[i] / lengths * s->residuals[i];
    return sum;
}

/* Holds parameters at a bound that they run into: near it the transformation makes steps ever smaller, and the way
 * long. Lets those go that lead downhill from their bound, though not for ever. Whether anything has changed. */
static bool revise_bounds(solver *s) {
    bool changed = false;
    s->problem->jacobian(s->problem->user, s->parameters, s->jacobian);
    make_finite(s->jacobian, s->m * (size_t)s->n);
    for (int k = 0; k < s->n; k++) {
        const fit_range *r = &s->problem->ranges[k];
        double slope = slope_of(s, k), share = share_of(r, s->parameters[k]);
        if (s->states[k] == FIT_DETERMINED) {
            double near = s->releases[k] ? BOUND_MARGIN : NEAR_BOUND;
            bool down = share < BOUND_MARGIN || (share < near && slope > SLOPE_MIN);
            bool up = share > 1 - BOUND_MARGIN || (share > 1 - near && slope < -SLOPE_MIN);
            if (r->kind == FIT_RANGE_FREE || (!down && !up))
                continue;
            s->states[k] = down ? FIT_AT_LOW : FIT_AT_HIGH;
            s->parameters[k] = down ? r->low : r->high;
        } else {
            bool inside = s->states[k] == FIT_AT_LOW ? slope < -SLOPE_MIN : slope > SLOPE_MIN;
            if (!inside || s->releases[k]++ >= RELEASES_MAX)
                continue;
            /* Ever closer to the bound: steps from farther away may lead right back to it. */
            double away = NEAR_BOUND * pow(.1, s->releases[k] - 1), derivative;
            double q = asin(sqrt(s->states[k] == FIT_AT_LOW ? away : 1 - away));
            s->parameters[k] = from_unbounded(r, q, &derivative);
            s->states[k] = FIT_DETERMINED;
        }
        changed = true;
    }
    return changed;
}

static graze_status solve(solver *s, const double *start, fit_minimum *minimum, const graze_report *report) {
    int outcome = 5, first = CALLS_MAX;
    memcpy(s->parameters, start, (size_t)s->n * sizeof *start);
    for (int k = 0; k < s->n; k++) {
        s->states[k] = FIT_DETERMINED;
        s->releases[k] = 0;
        if (s->problem->ranges[k].kind != FIT_RANGE_FREE)
            first = CALLS_FIRST;
    }
    /* 1 to 4: converged; 5: too many calls; 6 to 8: no further progress is possible in double precision. */
    for (int calls = first; calls <= CALLS_MAX; calls += outcome == 5 ? calls : 0) {
        outcome = descend(s, calls);
        if (outcome < 1 || outcome > 8)
            return report_error(report, NULL, "MINPACK refuses the problem with code %d", outcome);
        if (!revise_bounds(s) && outcome != 5)
            break;
    }
    minimum->converged = outcome != 5;
    double length = enorm((int)s->m, s->residuals);
    minimum->sum = length * length;
    for (int k = 0; k < s->n; k++)
        minimum->estimates[k] = (fit_estimate){s->parameters[k], 0, s->states[k]};
    find_errors(s, minimum);
    return GRAZE_OK;
}

/* Whether a parameter differs by more than its errors and rounding explain. */
static bool is_elsewhere(const fit_minimum *a, const fit_minimum *b, int n) {
    for (int k = 0; k < n; k++) {
        const fit_estimate *p = &a->estimates[k], *q = &b->estimates[k];
        if (fabs(p->value - q->value) > 3 * (p->error + q->error) + 1e-4 * (fabs(p->value) + fabs(q->value)))
            return true;
    }
    return false;
}

static bool is_as_good(const fit_minimum *best, const fit_minimum *other) {
    double variance = best->degrees > 0 ? best->sum / (double)best->degrees : 0;
    return other->sum - best->sum <= RIVAL_VARIANCES * variance;
}

static void copy_minimum(fit_minimum *to, const fit_minimum *from, fit_estimate *room, int n) {
    *to = *from;
    to->estimates = memcpy(room, from->estimates, (size_t)n * sizeof *room);
}

graze_status fit_minimise(const fit_problem *problem, const double *starts, size_t start_count, fit_minimum *best,
                          fit_minimum *rival, fit_estimate *rival_estimates, const graze_report *report) {
    solver s;
    int n = problem->parameter_count;
    size_t size = (size_t)n;
    fit_estimate *best_room = best->estimates, *all = calloc(start_count, size * sizeof *all);
    fit_minimum *found = calloc(start_count, sizeof *found);
    graze_status status = solver_begin(&s, problem, report);
    if (status == GRAZE_OK && (!all || !found))
        status = report_out_of_memory(report);
    size_t least = 0;
    for (size_t i = 0; i < start_count && status == GRAZE_OK; i++) {
        found[i] = (fit_minimum){.start = i, .estimates = all + i * size};
        status = solve(&s, starts + i * size, &found[i], report);
        if (found[i].sum < found[least].sum)
            least = i;
    }
    rival->estimates = NULL;
    for (size_t i = 0; i < start_count && status == GRAZE_OK; i++)
        if (i != least && is_as_good(&found[least], &found[i]) && is_elsewhere(&found[least], &found[i], n) &&
            (!rival->estimates || found[i].sum < rival->sum))
            copy_minimum(rival, &found[i], rival_estimates, n);
    if (status == GRAZE_OK)
        copy_minimum(best, &found[least], best_room, n);
    solver_free(&s);
    free(all);
    free(found);
    return status;
}
