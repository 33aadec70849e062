/* From measurements to a model's parameters: many starting points on few numbers, then one on all. */
#include "fit/reflectance.h"

#include <math.h>
#include <stdlib.h>

#include "fit/lobe_problem.h"

/* The starting points are tried on about so many pairs at most, and on the mean of the channels. */
enum { SEARCH_PAIRS = 4096, PARAMETERS_MAX = 4 };

static const double start_roughness[] = {.01, .03, .1, .3, 1};
static const double start_ratio[] = {1, 4, .25};
enum { ROUGHNESSES = sizeof start_roughness / sizeof *start_roughness, RATIOS = 3 };

/* Finds the roughness: the best minimum for the mean of the channels, and its rival. */
static graze_status search(const fit_measurements *m, const fit_settings *settings, size_t first, size_t channels,
                           double roughness[2], fit_quality *quality, const graze_report *report) {
    fit_lobe_problem p;
    fit_estimate estimates[PARAMETERS_MAX], rival_estimates[PARAMETERS_MAX];
    fit_minimum best = {.estimates = estimates}, rival;
    double starts[ROUGHNESSES * RATIOS * PARAMETERS_MAX];
    size_t count = 0, thinning = m->count / SEARCH_PAIRS + 1;
    graze_status status = fit_lobe_problem_create(&p, m, settings, first, channels, channels > 1, thinning, report);
    for (int i = 0; i < ROUGHNESSES && status == GRAZE_OK; i++)
        for (int k = 0; k < (settings->anisotropic ? RATIOS : 1); k++) {
            double root = sqrt(start_ratio[k]);
            const double start[2] = {start_roughness[i] * root, start_roughness[i] / root};
            fit_lobe_start(&p, start, starts + count++ * (size_t)p.problem.parameter_count);
        }
    if (status == GRAZE_OK)
        status = fit_minimise(&p.problem, starts, count, &best, &rival, rival_estimates, report);
    fit_lobe_problem_free(&p);
    if (status != GRAZE_OK)
        return status;
    roughness[0] = best.estimates[0].value;
    roughness[1] = best.estimates[settings->anisotropic].value;
    quality->has_rival = rival.estimates != NULL;
    if (quality->has_rival) {
        quality->rival_alpha_x = rival.estimates[0].value;
        quality->rival_alpha_y = rival.estimates[settings->anisotropic].value;
    }
    return GRAZE_OK;
}

/* What follows rs as total - rs. */
static fit_estimate remainder_of(const fit_estimate *rs, double total) {
    static const fit_state mirrored[] = {FIT_DETERMINED, FIT_AT_HIGH, FIT_AT_LOW, FIT_UNDETERMINED};
    return (fit_estimate){total - rs->value, rs->error, mirrored[rs->state]};
}

static void take_estimates(fit_result *r, const fit_lobe_problem *p, const fit_minimum *minimum, size_t first) {
    const fit_settings *s = p->settings;
    const fit_estimate *at = minimum->estimates + fit_lobe_roughnesses(s);
    for (size_t k = 0; k < p->channels; k++, at += fit_lobe_reflectances(s))
        r->channels[first + k] = (fit_channel){.alpha_x = minimum->estimates[0],
                                               .alpha_y = minimum->estimates[s->anisotropic],
                                               .rs = at[0],
                                               .rd = p->total ? remainder_of(&at[0], p->total[k]) : at[1]};
}

static graze_status finish(fit_result *r, fit_lobe_problem *p, const double roughness[2], size_t first,
                           fit_quality *quality, const graze_report *report) {
    size_t n = (size_t)p->problem.parameter_count;
    double *start = calloc(n, sizeof *start);
    fit_estimate *estimates = calloc(2 * n, sizeof *estimates);
    fit_minimum best = {.estimates = estimates}, rival;
    graze_status status = start && estimates ? GRAZE_OK : report_out_of_memory(report);
    if (status == GRAZE_OK) {
        fit_lobe_start(p, roughness, start);
        status = fit_minimise(&p->problem, start, 1, &best, &rival, estimates + n, report);
    }
    if (status == GRAZE_OK) {
        take_estimates(r, p, &best, first);
        quality->converged = best.converged;
        quality->condition = best.condition;
        quality->degrees = best.degrees;
        quality->loss = best.sum;
        for (size_t k = 0; k < n; k++)
            start[k] = best.estimates[k].value;
        r->residual += fit_lobe_residual(p, start);
        r->pairs = p->count;
    }
    free(start);
    free(estimates);
    return status;
}

static graze_status fit_channels(fit_result *r, const fit_measurements *m, const fit_settings *settings, size_t first,
                                 size_t channels, fit_quality *quality, const graze_report *report) {
    fit_lobe_problem p;
    double roughness[2];
    graze_status status = search(m, settings, first, channels, roughness, quality, report);
    if (status != GRAZE_OK)
        return status;
    status = fit_lobe_problem_create(&p, m, settings, first, channels, false, 1, report);
    if (status == GRAZE_OK)
        status = finish(r, &p, roughness, first, quality, report);
    fit_lobe_problem_free(&p);
    return status;
}

graze_status fit_reflectance(fit_result *r, const fit_measurements *m, const fit_settings *settings,
                             const graze_report *report) {
    *r = (fit_result){.model = settings->model, .channel_count = m->channel_count};
    r->fit_count = settings->shared ? 1 : m->channel_count;
    r->channels = calloc(m->channel_count, sizeof *r->channels);
    r->qualities = calloc(r->fit_count, sizeof *r->qualities);
    graze_status status = r->channels && r->qualities ? GRAZE_OK : report_out_of_memory(report);
    for (size_t i = 0; i < r->fit_count && status == GRAZE_OK; i++)
        status = fit_channels(r, m, settings, i, settings->shared ? m->channel_count : 1, &r->qualities[i], report);
    if (status == GRAZE_OK)
        r->root_mean_square = sqrt(r->residual / (double)(r->pairs * r->channel_count));
    return status;
}

void fit_result_free(fit_result *r) {
    free(r->channels);
    free(r->qualities);
    *r = (fit_result){0};
}

double fit_result_value(const fit_result *r, size_t channel, graze_vec3 l, graze_vec3 v) {
    const fit_channel *c = &r->channels[channel];
    const graze_brdf brdf = {r->model, c->alpha_x.value, c->alpha_y.value};
    return c->rd.value * graze_diffuse_value(l, v) + c->rs.value * graze_brdf_value(&brdf, l, v);
}
