/* Residuals of a reflectance fit and their derivatives. */
#include "fit/lobe_problem.h"

#include <math.h>
#include <stdlib.h>

#include "base/angle.h"

int fit_lobe_roughnesses(const fit_settings *s) {
    return s->anisotropic ? 2 : 1;
}

int fit_lobe_reflectances(const fit_settings *s) {
    return s->total ? 1 : 2;
}

/* f and its derivatives by the roughnesses: all models are exp(-(hx/ax)^2/hz^2 - ...)/(ax ay) times what does not
 * depend on them. */
static void evaluate_lobe(fit_lobe_problem *p, const double *parameters, bool derivatives) {
    bool anisotropic = p->settings->anisotropic;
    double ax = parameters[0], ay = parameters[anisotropic];
    const graze_brdf brdf = {p->settings->model, ax, ay};
    for (size_t i = 0; i < p->count; i++) {
        graze_vec3 l = p->pairs[i].l, v = p->pairs[i].v;
        double f = graze_brdf_value(&brdf, l, v);
        p->lobe[i] = f;
        if (!derivatives)
            continue;
        double hz = l.z + v.z, sx = (l.x + v.x) / (ax * hz), sy = (l.y + v.y) / (ay * hz);
        double by_x = f * (2 * sx * sx - 1) / ax, by_y = f * (2 * sy * sy - 1) / ay;
        p->by_x[i] = anisotropic ? by_x : by_x + by_y;
        p->by_y[i] = by_y;
    }
}

/* rs and rd of a channel. */
static void reflectances(const fit_lobe_problem *p, const double *parameters, size_t channel, double *rs, double *rd) {
    const double *at =
        parameters + fit_lobe_roughnesses(p->settings) + channel * (size_t)fit_lobe_reflectances(p->settings);
    *rs = at[0];
    *rd = p->total ? p->total[channel] - at[0] : at[1];
}

/* The residual of one value, and what turns a derivative of the model's value into one of the residual. */
static double residual_of(const fit_settings *s, const fit_pair *pair, double data, double model, double *slope) {
    double root = sqrt(pair->weight), cosine = pair->l.z;
    switch (s->loss) {
    case FIT_LOSS_PLAIN:
        *slope = root;
        return root * (model - data);
    case FIT_LOSS_LOG:
        *slope = root * cosine / (1 + model * cosine);
        return root * (log1p(model * cosine) - log1p(data * cosine));
    default:
        *slope = root * cosine;
        return root * cosine * (model - data);
    }
}

static void residuals(void *user, const double *parameters, double *out) {
    fit_lobe_problem *p = user;
    double slope, rs, rd;
    evaluate_lobe(p, parameters, false);
    for (size_t k = 0; k < p->channels; k++) {
        reflectances(p, parameters, k, &rs, &rd);
        for (size_t i = 0; i < p->count; i++)
            out[k * p->count + i] = residual_of(p->settings, &p->pairs[i], p->values[i * p->channels + k],
                                                rd * INV_PI + rs * p->lobe[i], &slope);
    }
}

static void jacobian(void *user, const double *parameters, double *out) {
    fit_lobe_problem *p = user;
    size_t roughnesses = (size_t)fit_lobe_roughnesses(p->settings), m = p->problem.residual_count;
    size_t each = (size_t)fit_lobe_reflectances(p->settings);
    double slope, rs, rd;
    evaluate_lobe(p, parameters, true);
    for (size_t i = 0; i < m * (size_t)p->problem.parameter_count; i++)
        out[i] = 0;
    for (size_t k = 0; k < p->channels; k++) {
        double *by_rs = out + (roughnesses + k * each) * m, *by_rd = p->total ? NULL : by_rs + m;
        reflectances(p, parameters, k, &rs, &rd);
        for (size_t i = 0; i < p->count; i++) {
            size_t row = k * p->count + i;
            residual_of(p->settings, &p->pairs[i], p->values[i * p->channels + k], rd * INV_PI + rs * p->lobe[i],
                        &slope);
            out[row] = slope * rs * p->by_x[i];
            if (roughnesses == 2)
                out[m + row] = slope * rs * p->by_y[i];
            by_rs[row] = slope * (p->lobe[i] - (p->total ? INV_PI : 0));
            if (by_rd)
                by_rd[row] = slope * INV_PI;
        }
    }
}

static bool takes_part(const fit_settings *s, const fit_pair *pair) {
    double least = cos(s->max_polar);
    return s->max_polar >= PI / 2 || (pair->l.z >= least && pair->v.z >= least);
}

static graze_status allocate(fit_lobe_problem *p, size_t pairs, const graze_report *report) {
    p->pairs = calloc(pairs + 1, sizeof *p->pairs);
    p->values = calloc(pairs + 1, p->channels * sizeof *p->values);
    p->lobe = calloc(pairs + 1, sizeof *p->lobe);
    p->by_x = calloc(pairs + 1, sizeof *p->by_x);
    p->by_y = calloc(pairs + 1, sizeof *p->by_y);
    p->ranges = calloc((size_t)p->problem.parameter_count, sizeof *p->ranges);
    return p->pairs && p->values && p->lobe && p->by_x && p->by_y && p->ranges ? GRAZE_OK
                                                                               : report_out_of_memory(report);
}

static void copy_values(fit_lobe_problem *p, const double *from, size_t channels, bool mean) {
    double *to = p->values + p->count * p->channels;
    if (!mean) {
        for (size_t k = 0; k < channels; k++)
            to[k] = from[k];
        return;
    }
    to[0] = 0;
    for (size_t k = 0; k < channels; k++)
        to[0] += from[k] / (double)channels;
}

static graze_status copy_pairs(fit_lobe_problem *p, const fit_measurements *m, size_t first, size_t channels, bool mean,
                               size_t stride, const graze_report *report) {
    size_t seen = 0;
    for (size_t i = 0; i < m->count; i++) {
        if (!takes_part(p->settings, &m->pairs[i]) || seen++ % stride != 0)
            continue;
        copy_values(p, m->values + i * m->channel_count + first, channels, mean);
        for (size_t k = 0; k < p->channels && p->settings->loss == FIT_LOSS_LOG; k++)
            if (!(p->values[p->count * p->channels + k] * m->pairs[i].l.z > -1))
                return report_error(report, NULL, "the logarithmic loss needs values above -1/cos");
        p->pairs[p->count++] = m->pairs[i];
    }
    return GRAZE_OK;
}

static void set_ranges(fit_lobe_problem *p) {
    int roughnesses = fit_lobe_roughnesses(p->settings), each = fit_lobe_reflectances(p->settings);
    for (int k = 0; k < p->problem.parameter_count; k++) {
        int channel = (k - roughnesses) / each;
        p->ranges[k] = k < roughnesses ? (fit_range){FIT_RANGE_LOG, FIT_ALPHA_MIN, FIT_ALPHA_MAX}
                                       : (fit_range){FIT_RANGE_INTERVAL, 0, p->total ? p->total[channel] : 1};
    }
}

graze_status fit_lobe_problem_create(fit_lobe_problem *p, const fit_measurements *m, const fit_settings *settings,
                                     size_t first, size_t channels, bool mean, size_t stride,
                                     const graze_report *report) {
    *p = (fit_lobe_problem){.settings = settings,
                            .channels = mean ? 1 : channels,
                            .total = settings->total ? settings->total + first : NULL};
    for (size_t k = 0; mean && settings->total && k < channels; k++)
        p->mean_total += settings->total[first + k] / (double)channels;
    if (mean && settings->total)
        p->total = &p->mean_total;
    p->problem.parameter_count = fit_lobe_roughnesses(settings) + (int)p->channels * fit_lobe_reflectances(settings);
    graze_status status = allocate(p, m->count / stride + 1, report);
    if (status == GRAZE_OK)
        status = copy_pairs(p, m, first, channels, mean, stride, report);
    if (status == GRAZE_OK && p->count == 0)
        status = report_error(report, NULL, "no measurement is within the angle that is left in");
    if (status != GRAZE_OK)
        return status;
    set_ranges(p);
    p->problem.residual_count = p->count * p->channels;
    p->problem.ranges = p->ranges;
    p->problem.user = p;
    p->problem.residuals = residuals;
    p->problem.jacobian = jacobian;
    return GRAZE_OK;
}

void fit_lobe_problem_free(fit_lobe_problem *p) {
    free(p->pairs);
    free(p->values);
    free(p->lobe);
    free(p->by_x);
    free(p->by_y);
    free(p->ranges);
    *p = (fit_lobe_problem){0};
}

static double inside(double value, double high) {
    return fmin(fmax(value, .01 * high), .99 * high);
}

/* Linear least squares in rs, or in rs and rd, from the normal equations. */
static void solve_reflectances(const fit_lobe_problem *p, size_t channel, double *out) {
    double ff = 0, fo = 0, oo = 0, fd = 0, od = 0;
    for (size_t i = 0; i < p->count; i++) {
        double c = p->pairs[i].l.z * sqrt(p->pairs[i].weight), f = p->lobe[i] * c, one = INV_PI * c;
        double d = p->values[i * p->channels + channel] * c;
        if (p->total) {
            f -= one;
            d -= p->total[channel] * one;
        }
        ff += f * f;
        fo += f * one;
        oo += one * one;
        fd += f * d;
        od += one * d;
    }
    if (p->total) {
        out[0] = inside(ff > 0 ? fd / ff : 0, p->total[channel]);
        return;
    }
    /* A lobe that no pair has seen tells nothing of rs, nor does one as even as the diffuse term. */
    double determinant = ff * oo - fo * fo;
    bool singular = !(ff > 1e-12 * oo && determinant > 1e-12 * ff * oo);
    out[0] = inside(singular ? 0 : (fd * oo - od * fo) / determinant, 1);
    out[1] = inside(singular ? od / oo : (od * ff - fd * fo) / determinant, 1);
}

void fit_lobe_start(fit_lobe_problem *p, const double roughness[2], double *parameters) {
    int roughnesses = fit_lobe_roughnesses(p->settings), each = fit_lobe_reflectances(p->settings);
    for (int k = 0; k < roughnesses; k++)
        parameters[k] = fmin(fmax(roughness[k], 2 * FIT_ALPHA_MIN), FIT_ALPHA_MAX / 2);
    evaluate_lobe(p, parameters, false);
    for (size_t k = 0; k < p->channels; k++)
        solve_reflectances(p, k, parameters + roughnesses + k * (size_t)each);
}

double fit_lobe_residual(fit_lobe_problem *p, const double *parameters) {
    double sum = 0, rs, rd;
    evaluate_lobe(p, parameters, false);
    for (size_t k = 0; k < p->channels; k++) {
        reflectances(p, parameters, k, &rs, &rd);
        for (size_t i = 0; i < p->count; i++) {
            double d = rd * INV_PI + rs * p->lobe[i] - p->values[i * p->channels + k];
            sum += d * d * p->pairs[i].l.z * p->pairs[i].l.z;
        }
    }
    return sum;
}
