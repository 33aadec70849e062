/* Two scrambled sequences, their mean and its standard error, and when to stop. */
#include "trace/estimate.h"

#include "base/vector.h"
#include "trace/context.h"
#include "trace/estimate_error.h"

/* The first look at the error comes after this many samples of each half; then after every doubling. */
#define FIRST_LOOK 4u
/* Samples tell nothing of light that none of them has found, except that less than about 3 in their number carry it. So
 * many are taken before an answer is believed: of nothing but zeros, which where lights are sampled means shadow; of
 * paths that search; and of nothing but zeros from a search by reflections alone, which may take long to find a small
 * light, unless a floor under the error makes it too faint to matter. */
#define SEARCH_BELIEVED       512u
#define EMPTY_SEARCH_BELIEVED 65536u

/* In all that is noisy, something of the value's own size that has happened in none of n samples may yet change the
 * mean: by 3/n of it where they are few and like independent ones, by 1/n where they are spread evenly. That much must
 * be within the error. Below the floor a value's own size says little of what may yet come, and the less the smaller it
 * is: what is missing may be as large beside the floor as the floor is beside the value. So many samples are taken, but
 * not more than of zeros. */
#define UNSEEN      1.0
#define FEW_SAMPLES 32.0

static double samples_to_believe(const graze_trace_settings *s, estimate_luck luck, double value) {
    if (luck < ESTIMATE_NOISY)
        return 0;
    bool search = luck == ESTIMATE_SEARCH;
    if (value == 0 && search && !context_samples_lights(s) && s->floor == 0)
        return EMPTY_SEARCH_BELIEVED;
    if (value == 0)
        return ESTIMATE_ZEROS_BELIEVED;
    double few = ESTIMATE_UNSEEN_FEW / s->error, unseen = fmax(UNSEEN / s->error, fmin(few, FEW_SAMPLES));
    if (value < s->floor)
        unseen = fmax(unseen, fmin(few * s->floor / value, ESTIMATE_ZEROS_BELIEVED));
    return search ? fmax(unseen, SEARCH_BELIEVED) : unseen;
}

/* Whether so many samples in either half are enough, as one of them finds. */
static bool is_enough(const graze_trace_settings *s, uint32_t least, const estimate_half *judge,
                      const estimate_finding *found, uint32_t taken) {
    double value = rgb_max(found->mean);
    if (taken < fmax(samples_to_believe(s, judge->luck, value), least) / ESTIMATE_HALVES)
        return false;
    double allowed = s->error * fmax(value, s->floor);
    rgb variance = evidence_variance(&found->evidence, laws_of_mean(taken));
    double unseen = estimate_unseen_gloss(&judge->rare, judge->taken, (double)taken * ESTIMATE_HALVES);
    /* Lights in mirrors are found too seldom to wait for: what is missing of them is stated. */
    if (judge->rare.by_mirrors && taken >= SEARCH_BELIEVED / ESTIMATE_HALVES)
        unseen = 0;
    unseen = hypot(unseen, estimate_unseen_sky(judge, (double)taken * ESTIMATE_HALVES));
    return rgb_max(variance) / ESTIMATE_HALVES + unseen * unseen <= allowed * allowed;
}

/* Where only the place in the pixel decides what is seen, halves begin with so few samples that one may see an edge
 * that the other does not; this much more than the error asked for then is too much. Going on does make such pixels a
 * little too dark at bright edges, but the same edge would else be bright in some pixels and missing in others. */
#define STATED_OF_PLACES 1.5

static bool is_torn(const graze_trace_settings *s, const estimate_half halves[ESTIMATE_HALVES],
                    const graze_answer *answer) {
    double allowed = s->error * fmax(rgb_max(answer->value), s->floor);
    return halves[0].luck < ESTIMATE_NOISY && halves[1].luck < ESTIMATE_NOISY &&
           rgb_max(answer->standard_error) > STATED_OF_PLACES * allowed;
}

/* Samples that differ by their places alone are few; where these have an edge, as many are taken as of noise. */
static bool is_at_edge(estimate_half halves[ESTIMATE_HALVES], const graze_trace_settings *s,
                       const estimate_extras *extras, void *user, const graze_answer *answer) {
    double allowed = s->error * fmax(rgb_max(answer->value), s->floor);
    if (!extras->has_edge || halves[0].luck != ESTIMATE_PLACE || halves[1].luck != ESTIMATE_PLACE ||
        !extras->has_edge(user, answer->samples, allowed))
        return false;
    halves[0].luck = halves[1].luck = ESTIMATE_NOISY;
    return true;
}

/* Doubles each half's samples until the other finds them enough, for good, or the limit is reached. What both together
 * then state may be more than the error asked for; going on because of that would have samples judge themselves: those
 * that found much and scatter would be added to, those that found little and scatter less would be believed. */
static bool refine(estimate_half halves[ESTIMATE_HALVES], const graze_trace_settings *s, const estimate_extras *extras,
                   estimate_sample *sample, void *user, graze_answer *answer) {
    uint32_t limit = s->sample_limit / ESTIMATE_HALVES;
    bool enough[ESTIMATE_HALVES] = {false, false};
    for (uint64_t goal = FIRST_LOOK;; goal *= 2) {
        bool last = goal >= limit;
        for (int i = 0; i < ESTIMATE_HALVES; i++)
            if (!enough[i])
                estimate_half_take_until(&halves[i], last ? limit : (uint32_t)goal, sample, user);
        const estimate_finding found[ESTIMATE_HALVES] = {estimate_finding_of(&halves[0], &halves[1]),
                                                         estimate_finding_of(&halves[1], &halves[0])};
        for (int i = 0; i < ESTIMATE_HALVES; i++)
            enough[i] = enough[i] || is_enough(s, extras->least, &halves[1 - i], &found[1 - i], halves[i].taken);
        bool reached = enough[0] && enough[1];
        if (!reached && !last)
            continue;
        estimate_summarize(s, halves, found, answer);
        if (last || (!is_torn(s, halves, answer) && !is_at_edge(halves, s, extras, user, answer)))
            return reached;
        enough[0] = enough[1] = false;
    }
}

static rgb error_of_exact(rgb value, rgb known_error, bool integrated) {
    return estimate_with_known_error(rgb_multiply(known_error, known_error), value, integrated);
}

/* A single sample, which tells nothing of its error if another would differ. */
static void estimate_once(const graze_trace_settings *s, uint64_t stream, estimate_parts *parts,
                          estimate_sample *sample, void *user, graze_answer *answer) {
    const sampler_origin origin = {s->seed, stream};
    sampler points = sampler_start_once(&origin);
    path_sample taken;
    estimate_luck luck = ESTIMATE_NOISY;
    sample(user, &points, &taken, &luck);
    answer->value = estimate_not_negative(taken.radiance);
    answer->standard_error = rgb_gray(GRAZE_UNKNOWN_ERROR);
    if (luck == ESTIMATE_EXACT)
        answer->standard_error = error_of_exact(answer->value, taken.known_error, taken.integrated);
    answer->samples = 1;
    if (parts)
        *parts = (estimate_parts){taken.indirect, taken.albedo};
}

/* The first half has begun; the second one does where it is needed. */
static void estimate_halves(estimate_half halves[ESTIMATE_HALVES], const graze_trace_settings *s, uint64_t stream,
                            const estimate_extras *extras, estimate_sample *sample, void *user, graze_answer *answer) {
    if (estimate_half_take(&halves[0], sample, user) == ESTIMATE_EXACT) {
        answer->value = estimate_not_negative(halves[0].sum[0]);
        answer->standard_error = error_of_exact(answer->value, halves[0].known_error, halves[0].integrated);
        answer->samples = 1;
        return;
    }
    estimate_half_begin(&halves[1], sampler_key(s->seed, stream, 1), halves[0].with_parts);
    if (s->samples) {
        estimate_half_take_until(&halves[0], s->samples - s->samples / ESTIMATE_HALVES, sample, user);
        estimate_half_take_until(&halves[1], s->samples / ESTIMATE_HALVES, sample, user);
        const estimate_finding found[ESTIMATE_HALVES] = {estimate_finding_of(&halves[0], &halves[1]),
                                                         estimate_finding_of(&halves[1], &halves[0])};
        estimate_summarize(s, halves, found, answer);
    } else {
        answer->converged = refine(halves, s, extras, sample, user, answer);
    }
}

/* Controls are direct light, and change none of the parts. */
static estimate_parts mean_parts(const estimate_half halves[ESTIMATE_HALVES]) {
    estimate_parts mean = {{0, 0, 0}, {0, 0, 0}};
    double share[ESTIMATE_HALVES];
    estimate_share_halves(halves, share);
    for (int i = 0; i < ESTIMATE_HALVES && halves[i].taken > 0; i++) {
        double weight = share[i] / halves[i].taken;
        mean.indirect = rgb_add_scaled(mean.indirect, weight, halves[i].parts.indirect);
        mean.albedo = rgb_add_scaled(mean.albedo, weight, halves[i].parts.albedo);
    }
    return mean;
}

void estimate_with_extras(const graze_trace_settings *s, uint64_t stream, const estimate_extras *extras,
                          estimate_sample *sample, void *user, graze_answer *answer) {
    estimate_half halves[ESTIMATE_HALVES];
    *answer = (graze_answer){.converged = 1};
    if (s->samples == 1) {
        estimate_once(s, stream, extras->parts, sample, user, answer);
        return;
    }
    estimate_half_begin(&halves[0], sampler_key(s->seed, stream, 0), extras->parts != NULL);
    halves[1].taken = 0;
    estimate_halves(halves, s, stream, extras, sample, user, answer);
    if (extras->parts)
        *extras->parts = mean_parts(halves);
}

void estimate(const graze_trace_settings *s, uint64_t stream, estimate_sample *sample, void *user,
              graze_answer *answer) {
    estimate_with_extras(s, stream, &(estimate_extras){.least = 0}, sample, user, answer);
}
