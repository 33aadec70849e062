/* A reflectance fit as a least-squares problem: parameters are the roughness, then rs and, if free, rd of each channel.
 */
#ifndef FIT_LOBE_PROBLEM_H
#define FIT_LOBE_PROBLEM_H

#include "fit/reflectance.h"

#define FIT_ALPHA_MIN 1e-4
#define FIT_ALPHA_MAX GRAZE_ROUGHNESS_MAX

/* The pairs and channels that take part. */
typedef struct fit_lobe_problem {
    const fit_settings *settings;
    size_t count, channels;
    fit_pair *pairs;
    double *values;      /* count x channels */
    double *lobe, *by_x; /* scratch, one a pair: f for rs = 1 and its derivative by the (first) roughness ... */
    double *by_y;        /* ... and by the second */
    const double *total; /* of these channels; null: rd is free */
    double mean_total;
    fit_range *ranges;
    fit_problem problem;
} fit_lobe_problem;

int fit_lobe_roughnesses(const fit_settings *);  /* 1 or 2 */
int fit_lobe_reflectances(const fit_settings *); /* 1 or 2 a channel */

/* Those pairs within the settings' angles: every `stride`th of them, with the channels from `first` on, `channels` of
 * them, or with the mean of these as the only one. */
graze_status fit_lobe_problem_create(fit_lobe_problem *, const fit_measurements *, const fit_settings *, size_t first,
                                     size_t channels, bool mean, size_t stride, const graze_report *);
void fit_lobe_problem_free(fit_lobe_problem *);

/* Starting values: the roughnesses given, and the rs and rd that are best for them in Eq. 20, drawn into the inside of
 * their ranges. */
void fit_lobe_start(fit_lobe_problem *, const double roughness[2], double *parameters);

/* The sum of Eq. 20. */
double fit_lobe_residual(fit_lobe_problem *, const double *parameters);

#endif
