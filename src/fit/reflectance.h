/* The fit of a reflectance model to measurements: Eq. 19 and 20 of the paper, and their relatives. */
#ifndef FIT_REFLECTANCE_H
#define FIT_REFLECTANCE_H

#include "fit/least_squares.h"
#include "fit/measurements.h"
#include "graze/brdf.h"

/* What is summed in squares, with d the value measured and m the model's, rd/pi + f: */
typedef enum fit_loss {
    FIT_LOSS_COSINE, /* (d - m) cos theta_l: Eq. 20 */
    FIT_LOSS_PLAIN,  /* d - m */
    FIT_LOSS_LOG,    /* log(1 + d cos theta_l) - log(1 + m cos theta_l) */
} fit_loss;

typedef struct fit_settings {
    graze_brdf_model model;
    bool anisotropic;
    bool shared; /* one roughness for all channels; else each channel is a fit of its own */
    fit_loss loss;
    double max_polar;    /* in radians: pairs with a direction farther from the normal are left out */
    const double *total; /* total reflectance of each channel, in 0 < r <= 1: rd = total - rs; null: rd is free */
} fit_settings;

typedef struct fit_channel {
    fit_estimate alpha_x, alpha_y, rs, rd;
} fit_channel;

/* How well the minimum of one fit is determined. */
typedef struct fit_quality {
    bool converged;
    double condition; /* of the Jacobian with columns of length 1; 0: some parameter is undetermined */
    size_t degrees;   /* of freedom */
    double loss;      /* the sum that was minimised */
    bool has_rival;   /* another minimum is as good within the noise: */
    double rival_alpha_x, rival_alpha_y;
} fit_quality;

/* Above this, parameters are hardly told from each other. */
#define FIT_CONDITION_MAX 100.0

typedef struct fit_result {
    graze_brdf_model model;
    size_t pairs;            /* that took part */
    double residual;         /* the sum of Eq. 20, over all channels, whatever the loss */
    double root_mean_square; /* of what that sum adds up the squares of */
    size_t channel_count;
    fit_channel *channels;
    size_t fit_count; /* 1 if the roughness is shared, else channel_count */
    fit_quality *qualities;
} fit_result;

graze_status fit_reflectance(fit_result *, const fit_measurements *, const fit_settings *, const graze_report *);
void fit_result_free(fit_result *); /* also of {0} */

/* The BRDF of a channel of the result. */
double fit_result_value(const fit_result *, size_t channel, graze_vec3 l, graze_vec3 v);

#endif
