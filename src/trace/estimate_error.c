/* From the sums of two halves to their mean and its standard error. */
#include "trace/estimate_error.h"

#include "trace/path.h"
#include "trace/unmet_light.h"

/* Where so much of what was expected of gloss has been found, its peaks have been met, and scatter tells the error. */
#define FOUND_ENOUGH 0.25

/* The share of a control that the other half's samples add: what of it is not shadowed. */
static double share_of_control(const estimate_half *other, int k) {
    bool shadowed = k < other->control_count && other->lit[k] < other->whole[k];
    return shadowed ? fmax(other->lit[k], 0) / other->whole[k] : 1;
}

static void add_differences(evidence *e, rgb *mean, int count, int level) {
    for (; count > 1; count /= 2, level++) {
        int pairs = count / 2;
        rgb squares = {0, 0, 0};
        for (int i = 0; i < pairs; i++) {
            rgb difference = rgb_scale(0.5, rgb_add_scaled(mean[2 * i], -1, mean[2 * i + 1]));
            squares = rgb_add(squares, rgb_multiply(difference, difference));
            mean[i] = rgb_scale(0.5, rgb_add(mean[2 * i], mean[2 * i + 1]));
        }
        evidence_add(e, laws_of_difference(level), pairs, squares);
    }
}

estimate_finding estimate_finding_of(const estimate_half *h, const estimate_half *other) {
    double share[PATH_CONTROLS];
    for (int k = 0; k < h->control_count; k++)
        share[k] = share_of_control(other, k);
    int full = (int)(h->taken >> h->level), begun = full + (h->taken > (uint32_t)full << h->level);
    rgb mean[ESTIMATE_BLOCKS], total = {0, 0, 0};
    for (int i = 0; i < begun; i++) {
        rgb sum = h->sum[i];
        for (int k = 0; k < h->control_count; k++)
            sum = rgb_add_scaled(sum, share[k], h->difference[i][k]);
        total = rgb_add(total, sum);
        mean[i] = rgb_scale(ldexp(1, -h->level), sum);
    }
    estimate_finding found = {.mean = rgb_scale(1.0 / h->taken, total)};
    add_differences(&found.evidence, mean, full, h->level);
    return found;
}

/* Of what is known without sampling, the error that graze/brdf_light.h allows; of what differs from sample to sample,
 * if in its last digits only, that of adding some thousands in a row. */
#define KNOWN_ERROR    1e-8
#define ROUNDING_ERROR 1e-12
#define LEVEL          1e-9

rgb estimate_with_known_error(rgb variance, rgb value, bool integrated) {
    rgb error = rgb_scale(integrated ? KNOWN_ERROR : rgb_max(variance) > 0 ? ROUNDING_ERROR : 0, value);
    rgb sum = rgb_add(variance, rgb_multiply(error, error));
    return (rgb){sqrt(sum.r), sqrt(sum.g), sqrt(sum.b)};
}

void estimate_share_halves(const estimate_half halves[ESTIMATE_HALVES], double share[ESTIMATE_HALVES]) {
    uint32_t all = halves[0].taken + halves[1].taken;
    bool alike = halves[0].taken < halves[1].taken + 2 && halves[1].taken <= halves[0].taken;
    for (int i = 0; i < ESTIMATE_HALVES; i++)
        share[i] = alike ? (double)halves[i].taken / all : 0.5;
}

/* What a half's samples have added of a control, if it is more than nothing. */
static double brightness_of_control(const estimate_half *h, int k) {
    double sum = 0;
    for (uint32_t i = 0; k < h->control_count && i << h->level < h->taken; i++)
        sum += rgb_brightness(h->difference[i][k]);
    return fmax(sum, 0);
}

/* Shadows of lights that are seen in part, as far as is known, may lie where no sample has been: about one part in as
 * many as there are samples; and where no sample has been to any of the part that shines, as when most of a sun has
 * set, all of it may be in shadow. Not more than what is seen, and nothing where zeros are believed. */
static double unseen_shadows(const estimate_half halves[ESTIMATE_HALVES], double brightness) {
    double unseen = 0;
    if (brightness <= 0 && halves[0].taken + halves[1].taken >= ESTIMATE_ZEROS_BELIEVED)
        return 0;
    for (int k = 0; k < PATH_CONTROLS; k++) {
        double lit = 0, whole = 0;
        uint32_t taken = 0;
        for (int i = 0; i < ESTIMATE_HALVES; i++) {
            bool known = k < halves[i].control_count;
            lit += known ? halves[i].lit[k] : 0;
            whole += known ? halves[i].whole[k] : 0;
            taken += halves[i].taken;
        }
        if (whole <= 0)
            unseen += (brightness_of_control(&halves[0], k) + brightness_of_control(&halves[1], k)) / taken;
        else if (lit >= whole || lit <= 0)
            unseen += whole / ((double)taken * taken);
    }
    return brightness > 0 ? fmin(unseen, brightness) : unseen;
}

double estimate_unseen_sky(const estimate_half *h, double count) {
    bool watched = PATH_CONTROL_OF_SKY < h->control_count && h->lit[PATH_CONTROL_OF_SKY] <= 0;
    return watched ? h->whole[PATH_CONTROL_OF_SKY] / (h->taken * count) : 0;
}

double estimate_unseen_gloss(const path_rare *sum, double taken, double count) {
    double missing = (sum->expected - sum->found / FOUND_ENOUGH) / taken;
    if (missing <= 0 || sum->squares <= 0)
        return 0;
    double peaks = count / taken * sum->expected * sum->expected / sum->squares;
    return missing * (1 + 1 / sum->times) * fmin(ESTIMATE_UNSEEN_FEW / peaks, 1);
}

/* Of the mean of what the irradiance cache's parts say, as they differ. */
static rgb variance_of_cache(const estimate_half halves[ESTIMATE_HALVES], const double share[ESTIMATE_HALVES]) {
    rgb told[IRRADIANCE_PARTS], mean = {0, 0, 0}, squares = {0, 0, 0};
    for (int k = 0; k < IRRADIANCE_PARTS; k++) {
        told[k] = rgb_gray(0);
        for (int i = 0; i < ESTIMATE_HALVES; i++)
            if (halves[i].cached)
                told[k] = rgb_add_scaled(told[k], share[i] / halves[i].taken, halves[i].told[k]);
        mean = rgb_add_scaled(mean, 1.0 / IRRADIANCE_PARTS, told[k]);
    }
    for (int k = 0; k < IRRADIANCE_PARTS; k++) {
        rgb difference = rgb_add_scaled(told[k], -1, mean);
        squares = rgb_add(squares, rgb_multiply(difference, difference));
    }
    double freedom = IRRADIANCE_PARTS - 1;
    return rgb_scale(evidence_widening(freedom) / (freedom * IRRADIANCE_PARTS), squares);
}

/* Of what was known beforehand: the same surface's in all samples, it does not average out. */
static rgb variance_of_known(const estimate_half halves[ESTIMATE_HALVES], const double share[ESTIMATE_HALVES]) {
    rgb error = {0, 0, 0};
    for (int i = 0; i < ESTIMATE_HALVES; i++)
        error = rgb_add_scaled(error, share[i] / halves[i].taken, halves[i].known_error);
    return rgb_multiply(error, error);
}

/* Whether random numbers have made no difference yet: all samples are equal but for roundings. Diffuse reflections that
 * find nothing may still have missed what is seldom met, such as a glossy body that shows a window: about as much as
 * the value itself in less than one of them. */
static bool is_level(rgb variance, rgb value) {
    const double rounding = LEVEL * rgb_max(value);
    return rgb_max(variance) <= rounding * rounding;
}

void estimate_summarize(const graze_trace_settings *s, const estimate_half halves[ESTIMATE_HALVES],
                        const estimate_finding found[ESTIMATE_HALVES], graze_answer *answer) {
    double share[ESTIMATE_HALVES];
    estimate_share_halves(halves, share);
    laws first = laws_of_mean(halves[0].taken), second = laws_of_mean(halves[1].taken);
    evidence e = evidence_joined(&found[0].evidence, &found[1].evidence);
    rgb between = rgb_add_scaled(found[0].mean, -1, found[1].mean);
    evidence_add(&e, (laws){first.slow + second.slow, first.fast + second.fast}, 1, rgb_multiply(between, between));
    double squares[ESTIMATE_HALVES] = {share[0] * share[0], share[1] * share[1]};
    rgb variance = evidence_variance(&e, (laws){squares[0] * first.slow + squares[1] * second.slow,
                                                squares[0] * first.fast + squares[1] * second.fast});
    if (halves[0].cached || halves[1].cached)
        variance = rgb_add(variance, variance_of_cache(halves, share));
    variance = rgb_add(variance, variance_of_known(halves, share));
    answer->value = estimate_not_negative(rgb_add_scaled(rgb_scale(share[0], found[0].mean), share[1], found[1].mean));
    double brightness = rgb_brightness(answer->value), shadows = unseen_shadows(halves, brightness);
    path_rare rare = halves[0].rare;
    estimate_add_rare(&rare, &halves[1].rare);
    double taken = (double)halves[0].taken + halves[1].taken,
           unseen = hypot(shadows, estimate_unseen_gloss(&rare, taken, taken));
    if (s->ambient_bounces > 0 && halves[0].luck >= ESTIMATE_NOISY && brightness > 0 &&
        is_level(variance, answer->value))
        unseen = hypot(unseen, brightness / taken);
    if (halves[0].unmet && halves[0].unmet->count > 0) {
        double unmet = unmet_light_of(halves[0].unmet, taken);
        unseen = hypot(unseen, brightness > 0 ? fmin(unmet, brightness) : unmet);
    }
    if (unseen > 0) {
        rgb part = brightness > 0 ? rgb_scale(unseen / brightness, answer->value) : rgb_gray(unseen);
        variance = rgb_add(variance, rgb_multiply(part, part));
    }
    bool integrated = halves[0].integrated || halves[1].integrated;
    answer->standard_error = estimate_with_known_error(variance, answer->value, integrated);
    answer->samples = halves[0].taken + halves[1].taken;
}
