/* Residuals of a reflectance fit and their derivatives, block by block of pairs. */
#include "fit/lobe_problem.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/angle.h"
#include "graze/brdf_batch.h"

enum { BLOCK = 512, PAIR_ARRAYS = 9 };

int fit_lobe_roughnesses(const fit_settings *s) {
    return s->anisotropic ? 2 : 1;
}

int fit_lobe_reflectances(const fit_settings *s) {
    return s->total ? 1 : 2;
}

/* --- The lobe ---------------------------------------------------------------------------------------------------- */

/* f for rs = 1 of the pairs from `first` on. */
static void evaluate_lobe(const fit_lobe_problem *p, const double *parameters, size_t first, size_t count,
                          double *lobe) {
    const graze_brdf brdf = {p->settings->model, parameters[0], parameters[p->settings->anisotropic]};
    double *const *l = p->pairs.l, *const *v = p->pairs.v;
    graze_brdf_value_batch(&brdf, count, (graze_vec3_arrays){l[0] + first, l[1] + first, l[2] + first},
                           (graze_vec3_arrays){v[0] + first, v[1] + first, v[2] + first}, lobe);
}

/* Its derivatives by the roughnesses: all models are exp(-(hx/ax)^2/hz^2 - ...)/(ax ay) times what does not depend on
 * them. */
static void differentiate_lobe(const fit_lobe_problem *p, const double *parameters, size_t first, size_t count,
                               const double *lobe, double *by_x, double *by_y) {
    bool anisotropic = p->settings->anisotropic;
    double ax = parameters[0], ay = parameters[anisotropic];
    const double *slope_x = p->pairs.slope_x + first, *slope_y = p->pairs.slope_y + first;
    for (size_t i = 0; i < count; i++) {
        by_x[i] = lobe[i] * (2 * slope_x[i] / (ax * ax) - 1) / ax;
        by_y[i] = lobe[i] * (2 * slope_y[i] / (ay * ay) - 1) / ay;
    }
    for (size_t i = 0; i < count && !anisotropic; i++)
        by_x[i] += by_y[i];
}

/* --- Residuals --------------------------------------------------------------------------------------------------- */

/* rs and rd of a channel. */
static void reflectances(const fit_lobe_problem *p, const double *parameters, size_t channel, double *rs, double *rd) {
    const double *at =
        parameters + fit_lobe_roughnesses(p->settings) + channel * (size_t)fit_lobe_reflectances(p->settings);
    *rs = at[0];
    *rd = p->total ? p->total[channel] - at[0] : at[1];
}

/* The residuals of a channel, and what turns a derivative of the model's value into one of the residual. */
static void find_residuals(const fit_lobe_problem *p, const double *parameters, size_t channel, size_t first,
                           size_t count, const double *lobe, double *residuals, double *slopes) {
    const double *root = p->pairs.root + first, *cosine = p->pairs.l[2] + first;
    const double *data = p->values + channel * p->capacity + first;
    double rs, rd;
    reflectances(p, parameters, channel, &rs, &rd);
    double diffuse = rd * INV_PI;
    switch (p->settings->loss) {
    case FIT_LOSS_PLAIN:
        for (size_t i = 0; i < count; i++) {
            slopes[i] = root[i];
            residuals[i] = root[i] * (diffuse + rs * lobe[i] - data[i]);
        }
        break;
    case FIT_LOSS_LOG:
        data = p->logarithms + channel * p->capacity + first;
        for (size_t i = 0; i < count; i++) {
            double model = (diffuse + rs * lobe[i]) * cosine[i];
            slopes[i] = root[i] * cosine[i] / (1 + model);
            residuals[i] = root[i] * (log1p(model) - data[i]);
        }
        break;
    default:
        for (size_t i = 0; i < count; i++) {
            slopes[i] = root[i] * cosine[i];
            residuals[i] = slopes[i] * (diffuse + rs * lobe[i] - data[i]);
        }
        break;
    }
}

/* Takes a block of pairs into the triangles. */
static void add_block(fit_lobe_problem *p, const double *parameters, size_t first, size_t count) {
    double lobe[BLOCK], by_x[BLOCK], by_y[BLOCK], slopes[BLOCK], memory[FIT_TRIANGLE_COLUMNS_MAX][BLOCK];
    int roughnesses = fit_lobe_roughnesses(p->settings), each = fit_lobe_reflectances(p->settings);
    double *columns[FIT_TRIANGLE_COLUMNS_MAX], rs, rd, shift = p->total ? INV_PI : 0;
    for (int k = 0; k < FIT_TRIANGLE_COLUMNS_MAX; k++)
        columns[k] = memory[k];
    evaluate_lobe(p, parameters, first, count, lobe);
    differentiate_lobe(p, parameters, first, count, lobe, by_x, by_y);
    for (size_t channel = 0; channel < p->channels; channel++) {
        find_residuals(p, parameters, channel, first, count, lobe, columns[each + roughnesses], slopes);
        reflectances(p, parameters, channel, &rs, &rd);
        for (size_t i = 0; i < count; i++) {
            columns[0][i] = slopes[i] * (lobe[i] - shift);
            columns[each][i] = slopes[i] * rs * by_x[i];
        }
        for (size_t i = 0; i < count && !p->total; i++)
            columns[1][i] = slopes[i] * INV_PI;
        for (size_t i = 0; i < count && roughnesses == 2; i++)
            columns[each + 1][i] = slopes[i] * rs * by_y[i];
        fit_triangle_add(&p->triangles[channel], columns, count);
    }
}

/* What the channels' triangles have in common: their rows below those that begin with a derivative by rs or rd. */
static void add_common_rows(fit_triangle *common, const fit_triangle *channel) {
    double memory[FIT_TRIANGLE_COLUMNS_MAX][FIT_TRIANGLE_COLUMNS_MAX], *columns[FIT_TRIANGLE_COLUMNS_MAX];
    int skipped = channel->columns - common->columns;
    for (int k = 0; k < common->columns; k++) {
        columns[k] = memory[k];
        for (int i = 0; i < common->columns; i++)
            memory[k][i] = channel->r[skipped + i][skipped + k];
    }
    fit_triangle_add(common, columns, (size_t)common->columns);
}

static void evaluate(fit_lobe_problem *p, const double *parameters) {
    size_t size = (size_t)p->problem.parameter_count * sizeof *parameters;
    if (p->has_triangles && memcmp(p->at, parameters, size) == 0)
        return;
    memcpy(p->at, parameters, size);
    p->has_triangles = true;
    int common = fit_lobe_roughnesses(p->settings) + 1;
    for (size_t k = 0; k < p->channels; k++)
        p->triangles[k] = (fit_triangle){.columns = fit_lobe_reflectances(p->settings) + common};
    p->common = (fit_triangle){.columns = common};
    for (size_t first = 0; first < p->count; first += BLOCK)
        add_block(p, parameters, first, p->count - first < BLOCK ? p->count - first : BLOCK);
    for (size_t k = 0; k < p->channels; k++)
        add_common_rows(&p->common, &p->triangles[k]);
}

/* Rows in the order of the parameters, the last for what no parameter can change. */
static void residuals(void *user, const double *parameters, double *out) {
    fit_lobe_problem *p = user;
    int common = fit_lobe_roughnesses(p->settings) + 1, each = fit_lobe_reflectances(p->settings);
    evaluate(p, parameters);
    for (int i = 0; i + 1 < common; i++)
        *out++ = p->common.r[i][common - 1];
    for (size_t k = 0; k < p->channels; k++)
        for (int i = 0; i < each; i++)
            *out++ = p->triangles[k].r[i][each + common - 1];
    *out = p->common.r[common - 1][common - 1];
}

static void jacobian(void *user, const double *parameters, double *out) {
    fit_lobe_problem *p = user;
    size_t m = p->problem.residual_count, n = (size_t)p->problem.parameter_count;
    size_t roughnesses = (size_t)fit_lobe_roughnesses(p->settings), each = (size_t)fit_lobe_reflectances(p->settings);
    evaluate(p, parameters);
    for (size_t i = 0; i < m * n; i++)
        out[i] = 0;
    for (size_t k = 0; k < roughnesses; k++)
        for (size_t i = 0; i < roughnesses; i++)
            out[k * m + i] = p->common.r[i][k];
    for (size_t channel = 0; channel < p->channels; channel++) {
        const fit_triangle *t = &p->triangles[channel];
        size_t at = roughnesses + channel * each;
        for (size_t i = 0; i < each; i++) {
            for (size_t k = 0; k < roughnesses; k++)
                out[k * m + at + i] = t->r[i][each + k];
            for (size_t k = 0; k < each; k++)
                out[(at + k) * m + at + i] = t->r[i][k];
        }
    }
}

/* --- The data ---------------------------------------------------------------------------------------------------- */

static bool takes_part(const fit_settings *s, const fit_pair *pair) {
    double least = cos(s->max_polar);
    return s->max_polar >= PI / 2 || (pair->l.z >= least && pair->v.z >= least);
}

/* One in `thinning`, without the rhythm that would miss rows or columns of a regular grid. */
static bool is_drawn(uint64_t number, size_t thinning) {
    number = (number ^ (number >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    number = (number ^ (number >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (number ^ (number >> 31)) % thinning == 0;
}

static graze_status allocate(fit_lobe_problem *p, const graze_report *report) {
    bool logarithmic = p->settings->loss == FIT_LOSS_LOG;
    size_t arrays = PAIR_ARRAYS + p->channels * (logarithmic ? 2 : 1), n = (size_t)p->problem.parameter_count;
    p->memory = calloc(p->capacity + 1, arrays * sizeof *p->memory);
    p->ranges = calloc(n, sizeof *p->ranges);
    p->at = calloc(n, sizeof *p->at);
    p->triangles = calloc(p->channels, sizeof *p->triangles);
    if (!p->memory || !p->ranges || !p->at || !p->triangles)
        return report_out_of_memory(report);
    double *array = p->memory;
    double **const all[PAIR_ARRAYS] = {&p->pairs.l[0],    &p->pairs.l[1],    &p->pairs.l[2],
                                       &p->pairs.v[0],    &p->pairs.v[1],    &p->pairs.v[2],
                                       &p->pairs.slope_x, &p->pairs.slope_y, &p->pairs.root};
    for (int i = 0; i < PAIR_ARRAYS; i++, array += p->capacity)
        *all[i] = array;
    p->values = array;
    p->logarithms = logarithmic ? array + p->channels * p->capacity : NULL;
    return GRAZE_OK;
}

static void copy_pair(fit_lobe_problem *p, const fit_pair *pair) {
    size_t i = p->count;
    graze_vec3 l = pair->l, v = pair->v;
    double slope_x = (l.x + v.x) / (l.z + v.z), slope_y = (l.y + v.y) / (l.z + v.z);
    p->pairs.l[0][i] = l.x;
    p->pairs.l[1][i] = l.y;
    p->pairs.l[2][i] = l.z;
    p->pairs.v[0][i] = v.x;
    p->pairs.v[1][i] = v.y;
    p->pairs.v[2][i] = v.z;
    p->pairs.slope_x[i] = slope_x * slope_x;
    p->pairs.slope_y[i] = slope_y * slope_y;
    p->pairs.root[i] = sqrt(pair->weight);
}

static graze_status copy_value(fit_lobe_problem *p, size_t channel, double value, const graze_report *report) {
    size_t at = channel * p->capacity + p->count;
    double cosine = p->pairs.l[2][p->count];
    p->values[at] = value;
    if (!p->logarithms)
        return GRAZE_OK;
    if (!(value * cosine > -1))
        return report_error(report, NULL, "the logarithmic loss needs values above -1/cos");
    p->logarithms[at] = log1p(value * cosine);
    return GRAZE_OK;
}

static graze_status copy_values(fit_lobe_problem *p, const double *from, size_t channels, bool mean,
                                const graze_report *report) {
    graze_status status = GRAZE_OK;
    double sum = 0;
    for (size_t k = 0; k < channels && status == GRAZE_OK; k++) {
        sum += from[k] / (double)channels;
        if (!mean)
            status = copy_value(p, k, from[k], report);
    }
    return mean ? copy_value(p, 0, sum, report) : status;
}

static graze_status copy_all(fit_lobe_problem *p, const fit_measurements *m, size_t first, size_t channels, bool mean,
                             size_t thinning, const graze_report *report) {
    size_t seen = 0;
    graze_status status = GRAZE_OK;
    for (size_t i = 0; i < m->count && p->count < p->capacity && status == GRAZE_OK; i++) {
        if (!takes_part(p->settings, &m->pairs[i]) || !is_drawn(seen++, thinning))
            continue;
        copy_pair(p, &m->pairs[i]);
        status = copy_values(p, m->values + i * m->channel_count + first, channels, mean, report);
        p->count++;
    }
    if (status == GRAZE_OK && p->count == 0)
        status = report_error(report, NULL, "no measurement is within the angle that is left in");
    return status;
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
                                     size_t first, size_t channels, bool mean, size_t thinning,
                                     const graze_report *report) {
    *p = (fit_lobe_problem){.settings = settings,
                            .capacity = thinning > 1 ? 2 * (m->count / thinning) + 1 : m->count,
                            .channels = mean ? 1 : channels,
                            .total = settings->total ? settings->total + first : NULL};
    for (size_t k = 0; mean && settings->total && k < channels; k++)
        p->mean_total += settings->total[first + k] / (double)channels;
    if (mean && settings->total)
        p->total = &p->mean_total;
    p->problem.parameter_count = fit_lobe_roughnesses(settings) + (int)p->channels * fit_lobe_reflectances(settings);
    graze_status status = allocate(p, report);
    if (status == GRAZE_OK)
        status = copy_all(p, m, first, channels, mean, thinning, report);
    if (status != GRAZE_OK)
        return status;
    set_ranges(p);
    p->problem.residual_count = (size_t)p->problem.parameter_count + 1;
    p->problem.observation_count = p->count * p->channels;
    p->problem.ranges = p->ranges;
    p->problem.user = p;
    p->problem.residuals = residuals;
    p->problem.jacobian = jacobian;
    return GRAZE_OK;
}

void fit_lobe_problem_free(fit_lobe_problem *p) {
    free(p->memory);
    free(p->ranges);
    free(p->triangles);
    free(p->at);
    *p = (fit_lobe_problem){0};
}

/* --- Beginning and end ------------------------------------------------------------------------------------------- */

static double inside(double value, double high) {
    return fmin(fmax(value, .01 * high), .99 * high);
}

/* Sums of products of what Eq. 20 weighs: f, the diffuse term, and data. */
typedef struct products {
    double ff, fo, oo, fd, od;
} products;

/* Linear least squares in rs, or in rs and rd, from the normal equations. */
static void solve_reflectances(const fit_lobe_problem *p, const products *s, size_t channel, double *out) {
    if (p->total) {
        out[0] = inside(s->ff > 0 ? s->fd / s->ff : 0, p->total[channel]);
        return;
    }
    /* A lobe that no pair has seen tells nothing of rs, nor does one as even as the diffuse term. */
    double determinant = s->ff * s->oo - s->fo * s->fo;
    bool singular = !(s->ff > 1e-12 * s->oo && determinant > 1e-12 * s->ff * s->oo);
    out[0] = inside(singular ? 0 : (s->fd * s->oo - s->od * s->fo) / determinant, 1);
    out[1] = inside(singular ? s->od / s->oo : (s->od * s->ff - s->fd * s->fo) / determinant, 1);
}

static products products_of(const fit_lobe_problem *p, const double *parameters, size_t channel) {
    products s = {0};
    double lobe[BLOCK];
    for (size_t i = 0; i < p->count; i++) {
        if (i % BLOCK == 0)
            evaluate_lobe(p, parameters, i, p->count - i < BLOCK ? p->count - i : BLOCK, lobe);
        double c = p->pairs.l[2][i] * p->pairs.root[i], f = lobe[i % BLOCK] * c, one = INV_PI * c;
        double d = p->values[channel * p->capacity + i] * c;
        if (p->total) {
            f -= one;
            d -= p->total[channel] * one;
        }
        s.ff += f * f;
        s.fo += f * one;
        s.oo += one * one;
        s.fd += f * d;
        s.od += one * d;
    }
    return s;
}

void fit_lobe_start(fit_lobe_problem *p, const double roughness[2], double *parameters) {
    int roughnesses = fit_lobe_roughnesses(p->settings), each = fit_lobe_reflectances(p->settings);
    for (int k = 0; k < roughnesses; k++)
        parameters[k] = fmin(fmax(roughness[k], 2 * FIT_ALPHA_MIN), FIT_ALPHA_MAX / 2);
    for (size_t k = 0; k < p->channels; k++) {
        products s = products_of(p, parameters, k);
        solve_reflectances(p, &s, k, parameters + roughnesses + k * (size_t)each);
    }
}

double fit_lobe_residual(fit_lobe_problem *p, const double *parameters) {
    double sum = 0, rs, rd, lobe[BLOCK];
    for (size_t first = 0; first < p->count; first += BLOCK) {
        size_t count = p->count - first < BLOCK ? p->count - first : BLOCK;
        evaluate_lobe(p, parameters, first, count, lobe);
        for (size_t k = 0; k < p->channels; k++) {
            const double *data = p->values + k * p->capacity + first, *cosine = p->pairs.l[2] + first;
            reflectances(p, parameters, k, &rs, &rd);
            for (size_t i = 0; i < count; i++) {
                double d = (rd * INV_PI + rs * lobe[i] - data[i]) * cosine[i];
                sum += d * d;
            }
        }
    }
    return sum;
}
