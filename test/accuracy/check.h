/* The functions of brdf.h and brdf_batch.h against the reference, with what they promise; and the naive formulas. */
#ifndef ACCURACY_CHECK_H
#define ACCURACY_CHECK_H

#include <stdio.h>
#include <string.h>

#include "accuracy/pairs.h"
#include "accuracy/reference.h"
#include "graze/brdf_batch.h"

/* Densities know no model. */
enum { VALUE, WARD_DENSITY, WARD_WEIGHT, PAIR_DENSITY, PAIR_WEIGHT, FUNCTIONS };
enum { ROWS = 14 };
typedef struct accuracy_row {
    int function, model;
    const char *name;
} accuracy_row;
static const accuracy_row accuracy_rows[ROWS] = {
    {VALUE, REFERENCE_GMD, "value, new"},
    {VALUE, REFERENCE_WARD, "value, Ward"},
    {VALUE, REFERENCE_WARD_DUER, "value, Ward-Duer"},
    {VALUE, REFERENCE_WARD_NEUMANN, "value, Ward-Neumann"},
    {WARD_WEIGHT, REFERENCE_GMD, "Ward weight, new"},
    {WARD_WEIGHT, REFERENCE_WARD, "Ward weight, Ward"},
    {WARD_WEIGHT, REFERENCE_WARD_DUER, "Ward weight, Ward-Duer"},
    {WARD_WEIGHT, REFERENCE_WARD_NEUMANN, "Ward weight, Ward-Neumann"},
    {PAIR_WEIGHT, REFERENCE_GMD, "pair weight, new"},
    {PAIR_WEIGHT, REFERENCE_WARD, "pair weight, Ward"},
    {PAIR_WEIGHT, REFERENCE_WARD_DUER, "pair weight, Ward-Duer"},
    {PAIR_WEIGHT, REFERENCE_WARD_NEUMANN, "pair weight, Ward-Neumann"},
    {WARD_DENSITY, REFERENCE_GMD, "Ward density"},
    {PAIR_DENSITY, REFERENCE_GMD, "pair density"},
};

/* What brdf.h and brdf_batch.h promise, in units in the last place, where the true value is a normal number. */
static const double accuracy_bound[FUNCTIONS] = {1.8, 1.8, .51, 1.8, .51};
static const double accuracy_float_bound[FUNCTIONS] = {2.95, .501, .501, .501, .501};
/* Tiny numbers are those below the normal ones, and float values below 2^-124. In double nothing is promised of them;
 * but they are rounded a second time and no worse. Float values below the normal ones may be 0. */
static const double accuracy_tiny_bound[FUNCTIONS] = {1.8, 1.8, 1, 1.8, 1};
static const double accuracy_tiny_float_bound[FUNCTIONS] = {3.31, .501, .501, .501, .501};

/* The true number; it may be overwritten. */
static inline mpfr_ptr accuracy_exact(reference_terms *r, const accuracy_row *row) {
    switch (row->function) {
    case VALUE:
        return r->value[row->model];
    case WARD_DENSITY:
        return r->ward_density;
    case WARD_WEIGHT:
        return r->ward_weight[row->model];
    case PAIR_DENSITY:
        return r->pair_density;
    default:
        return r->pair_weight[row->model];
    }
}

static inline double accuracy_scalar(int function, const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    switch (function) {
    case VALUE:
        return graze_brdf_value(brdf, l, v);
    case WARD_DENSITY:
        return graze_brdf_ward_density(brdf, l, v);
    case WARD_WEIGHT:
        return graze_brdf_ward_weight(brdf, l, v);
    case PAIR_DENSITY:
        return graze_brdf_pair_density(brdf, l, v);
    default:
        return graze_brdf_pair_weight(brdf, l, v);
    }
}

typedef void accuracy_batch(const graze_brdf *, size_t, graze_vec3_arrays, graze_vec3_arrays, double *);
typedef void accuracy_float_batch(const graze_brdf *, size_t, graze_vec3_float_arrays, graze_vec3_float_arrays,
                                  float *);
static accuracy_batch *const accuracy_batches[FUNCTIONS] = {graze_brdf_value_batch, graze_brdf_ward_density_batch,
                                                            graze_brdf_ward_weight_batch, graze_brdf_pair_density_batch,
                                                            graze_brdf_pair_weight_batch};
static accuracy_float_batch *const accuracy_float_batches[FUNCTIONS] = {
    graze_brdf_value_float_batch, graze_brdf_ward_density_float_batch, graze_brdf_ward_weight_float_batch,
    graze_brdf_pair_density_float_batch, graze_brdf_pair_weight_float_batch};

/* The equations as one writes them down. */
static inline double accuracy_naive(const accuracy_row *row, const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    double x = l.x + v.x, y = l.y + v.y, z = l.z + v.z, tan2 = (x * x + y * y) / (z * z), hh = x * x + y * y + z * z;
    double e = exp(-(x * x / (brdf->alpha_x * brdf->alpha_x) + y * y / (brdf->alpha_y * brdf->alpha_y)) / (z * z));
    double factor = e / (pi * brdf->alpha_x * brdf->alpha_y), density = factor * hh / (2 * z * z * z);
    const double values[] = {factor * hh / (z * z * z * z), factor / (4 * sqrt(l.z * v.z)), factor / (4 * l.z * v.z),
                             factor / (4 * fmax(l.z, v.z))};
    const double ratios[] = {1, z * z * z * z / (4 * sqrt(l.z * v.z) * hh), z * z * z * z / (4 * l.z * v.z * hh),
                             z * z * z * z / (4 * fmax(l.z, v.z) * hh)}; /* to the new model */
    double u = 1 - tan2, rho = fabs(((1 + tan2) * l.z - v.z * u) / 2) / v.z, weight = 2 * l.z / z;
    double mean = 2 * rho < u ? (u - 2 * rho * rho) / (1 - rho * rho) : (u + 2 * rho) / (2 * (1 + rho));
    switch (row->function) {
    case VALUE:
        return values[row->model];
    case WARD_DENSITY:
        return density;
    case WARD_WEIGHT:
        return weight * ratios[row->model];
    case PAIR_DENSITY:
        return density * weight / mean;
    default:
        return mean * ratios[row->model];
    }
}

/* The largest error so far, and where. */
typedef struct accuracy_worst {
    double ulps, result;
    reference_case in;
} accuracy_worst;

typedef struct accuracy_tally {
    accuracy_worst worst[ROWS], naive[ROWS];
    double tiny[ROWS];                                          /* the largest error of tiny numbers */
    long pairs, results[ROWS], tinies[ROWS], naive_large[ROWS]; /* more than 100 ulp off */
    long broken;                                                /* promises */
    long unlike;                                                /* batch results that are not the scalar's */
    accuracy_worst first_unlike;
} accuracy_tally;

/* Of equal errors, the one whose bytes come first: whatever the order, the same is kept. */
static inline void accuracy_keep_worst(accuracy_worst *worst, double ulps, double result, const reference_case *in) {
    if (ulps > worst->ulps || (ulps > 0 && ulps == worst->ulps && memcmp(in, &worst->in, sizeof *in) < 0))
        *worst = (accuracy_worst){ulps, result, *in};
}

static inline bool accuracy_is_tiny(int row, const reference_format *format, mpfr_t exact) {
    bool float_value = format == &reference_float && accuracy_rows[row].function == VALUE;
    return !reference_is_normal(format, exact) || (float_value && mpfr_cmp_d(exact, 0x1p-124) < 0);
}

/* The exact number is overwritten. */
static inline double accuracy_ulps(int row, const reference_format *format, mpfr_t exact, double result) {
    bool may_be_0 = format == &reference_float && accuracy_rows[row].function == VALUE;
    if (may_be_0 && result == 0 && !reference_is_normal(format, exact))
        return 0;
    return reference_ulps(format, result, exact);
}

/* Exact numbers are overwritten by the comparison, and they are compared twice. */
static inline void accuracy_compare(accuracy_tally *t, int row, const reference_format *format, mpfr_t scratch,
                                    mpfr_t exact, double result, double naive, const reference_case *in) {
    bool in_double = format == &reference_double, tiny = accuracy_is_tiny(row, format, exact);
    if (in_double && !tiny) {
        mpfr_set(scratch, exact, MPFR_RNDN);
        double error = reference_ulps(format, fmin(naive, DBL_MAX), scratch);
        accuracy_keep_worst(&t->naive[row], error, naive, in);
        t->naive_large[row] += error > 100;
    }
    double ulps = accuracy_ulps(row, format, exact, result);
    ++(tiny ? t->tinies : t->results)[row];
    if (tiny)
        t->tiny[row] = fmax(t->tiny[row], ulps);
    else
        accuracy_keep_worst(&t->worst[row], ulps, result, in);
    const double *bounds = tiny ? (in_double ? accuracy_tiny_bound : accuracy_tiny_float_bound)
                                : (in_double ? accuracy_bound : accuracy_float_bound);
    t->broken += !(ulps <= bounds[accuracy_rows[row].function]);
}

static inline reference_case accuracy_case(const pair_group *g, int i) {
    return (reference_case){
        g->alpha_x, g->alpha_y, {g->l[i].x, g->l[i].y, g->l[i].z}, {g->v[i].x, g->v[i].y, g->v[i].z}};
}

/* The first `count` pairs of a group: all functions of all models, scalar and batch. */
static inline void accuracy_check(reference *r, const pair_group *g, int count, accuracy_tally *t) {
    double lx[PAIRS], ly[PAIRS], lz[PAIRS], vx[PAIRS], vy[PAIRS], vz[PAIRS], batch[ROWS][PAIRS];
    for (int i = 0; i < count; ++i) {
        lx[i] = g->l[i].x, ly[i] = g->l[i].y, lz[i] = g->l[i].z;
        vx[i] = g->v[i].x, vy[i] = g->v[i].y, vz[i] = g->v[i].z;
    }
    for (int row = 0; row < ROWS; ++row) {
        const graze_brdf brdf = {(graze_brdf_model)accuracy_rows[row].model, g->alpha_x, g->alpha_y};
        accuracy_batches[accuracy_rows[row].function](&brdf, (size_t)count, (graze_vec3_arrays){lx, ly, lz},
                                                      (graze_vec3_arrays){vx, vy, vz}, batch[row]);
    }
    for (int i = 0; i < count; ++i) {
        reference_case in = accuracy_case(g, i);
        reference_terms *terms = reference_evaluate(r, &in);
        for (int row = 0; row < ROWS; ++row) {
            const graze_brdf brdf = {(graze_brdf_model)accuracy_rows[row].model, g->alpha_x, g->alpha_y};
            double result = accuracy_scalar(accuracy_rows[row].function, &brdf, g->l[i], g->v[i]);
            double naive = accuracy_naive(&accuracy_rows[row], &brdf, g->l[i], g->v[i]);
            if (memcmp(&result, &batch[row][i], sizeof result) != 0 && t->unlike++ == 0)
                t->first_unlike = (accuracy_worst){row, batch[row][i], in};
            accuracy_compare(t, row, &reference_double, terms->a, accuracy_exact(terms, &accuracy_rows[row]), result,
                             naive, &in);
        }
        ++t->pairs;
    }
}

/* The group's directions, rounded to float. Their cosines stay above the surface. */
static inline void accuracy_round(pair_group *g) {
    for (int i = 0; i < PAIRS; ++i) {
        g->l[i] = (graze_vec3){(float)g->l[i].x, (float)g->l[i].y, (float)g->l[i].z};
        g->v[i] = (graze_vec3){(float)g->v[i].x, (float)g->v[i].y, (float)g->v[i].z};
    }
}

/* The same in float, for directions that are floats. */
static inline void accuracy_check_float(reference *r, const pair_group *g, int count, accuracy_tally *t) {
    float lx[PAIRS], ly[PAIRS], lz[PAIRS], vx[PAIRS], vy[PAIRS], vz[PAIRS], batch[ROWS][PAIRS];
    for (int i = 0; i < count; ++i) {
        lx[i] = (float)g->l[i].x, ly[i] = (float)g->l[i].y, lz[i] = (float)g->l[i].z;
        vx[i] = (float)g->v[i].x, vy[i] = (float)g->v[i].y, vz[i] = (float)g->v[i].z;
    }
    for (int row = 0; row < ROWS; ++row) {
        const graze_brdf brdf = {(graze_brdf_model)accuracy_rows[row].model, g->alpha_x, g->alpha_y};
        accuracy_float_batches[accuracy_rows[row].function](&brdf, (size_t)count, (graze_vec3_float_arrays){lx, ly, lz},
                                                            (graze_vec3_float_arrays){vx, vy, vz}, batch[row]);
    }
    for (int i = 0; i < count; ++i) {
        reference_case in = accuracy_case(g, i);
        reference_terms *terms = reference_evaluate(r, &in);
        for (int row = 0; row < ROWS; ++row)
            accuracy_compare(t, row, &reference_float, terms->a, accuracy_exact(terms, &accuracy_rows[row]),
                             (double)batch[row][i], 0, &in);
        ++t->pairs;
    }
}

enum { CASE_TEXT = 300 };
static inline const char *accuracy_text(const reference_case *in, char text[CASE_TEXT]) {
    snprintf(text, CASE_TEXT, "%a %a %a %a %a %a %a %a", in->alpha_x, in->alpha_y, in->l[0], in->l[1], in->l[2],
             in->v[0], in->v[1], in->v[2]);
    return text;
}

/* A line of worst.txt or hard.txt; false for a comment. What stands after the eighth number is for the reader. */
static inline bool accuracy_read_case(const char *line, pair_group *g) {
    graze_vec3 *l = g->l, *v = g->v;
    return sscanf(line, "%la %la %la %la %la %la %la %la", &g->alpha_x, &g->alpha_y, &l->x, &l->y, &l->z, &v->x, &v->y,
                  &v->z) == 8;
}

/* Whether the float functions can be asked about this pair. */
static inline bool accuracy_is_float(const pair_group *g) {
    const double c[] = {g->l->x, g->l->y, g->l->z, g->v->x, g->v->y, g->v->z};
    for (int k = 0; k < 6; ++k)
        if (!(fabs(c[k]) <= (double)FLT_MAX && (double)(float)c[k] == c[k]))
            return false;
    return true;
}

#endif
