/* A reflectance fit as a least-squares problem: parameters are the roughness, then rs and, if free, rd of each channel.
 *
 * What the optimiser sees are not the residuals, a million of them for a MERL table, but as few as there are parameters
 * and one: residuals and derivatives times the same orthogonal matrix, Q' of the QR decomposition of both. All lengths
 * and angles stay, and so does every step of Levenberg and Marquardt's. */
#ifndef FIT_LOBE_PROBLEM_H
#define FIT_LOBE_PROBLEM_H

#include "fit/reflectance.h"
#include "fit/triangle.h"

#define FIT_ALPHA_MIN 1e-4
#define FIT_ALPHA_MAX GRAZE_ROUGHNESS_MAX

/* What does not change with the parameters: arrays with an element a pair. */
typedef struct fit_lobe_pairs {
    double *l[3], *v[3];
    double *slope_x, *slope_y; /* (hx/hz)^2, (hy/hz)^2 of the half vector */
    double *root;              /* of the weight */
} fit_lobe_pairs;

/* The pairs and channels that take part. */
typedef struct fit_lobe_problem {
    const fit_settings *settings;
    size_t count, capacity, channels;
    double *memory; /* of all the arrays */
    fit_lobe_pairs pairs;
    double *values;      /* channels x capacity */
    double *logarithms;  /* log(1 + d cos theta_l), as the values; null but for FIT_LOSS_LOG */
    const double *total; /* of these channels; null: rd is free */
    double mean_total;
    fit_range *ranges;
    fit_triangle *triangles; /* a channel each: by rs, by rd, by the roughnesses, residuals */
    fit_triangle common;     /* by the roughnesses, residuals */
    double *at;              /* the parameters that the triangles are for, if there are any */
    bool has_triangles;
    fit_problem problem;
} fit_lobe_problem;

int fit_lobe_roughnesses(const fit_settings *);  /* 1 or 2 */
int fit_lobe_reflectances(const fit_settings *); /* 1 or 2 a channel */

/* Those pairs within the settings' angles, or about one in `thinning` of them, always the same; with the channels from
 * `first` on, `channels` of them, or with the mean of these as the only one. */
graze_status fit_lobe_problem_create(fit_lobe_problem *, const fit_measurements *, const fit_settings *, size_t first,
                                     size_t channels, bool mean, size_t thinning, const graze_report *);
void fit_lobe_problem_free(fit_lobe_problem *);

/* Starting values: the roughnesses given, and the rs and rd that are best for them in Eq. 20, drawn into the inside of
 * their ranges. */
void fit_lobe_start(fit_lobe_problem *, const double roughness[2], double *parameters);

/* The sum of Eq. 20. */
double fit_lobe_residual(fit_lobe_problem *, const double *parameters);

#endif
