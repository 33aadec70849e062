/* Replicates, their mean and its standard error, and when to stop. */
#include "trace/estimate.h"

#include "base/vector.h"
#include "trace/path.h"

/* The first look at the error comes after this many samples a replicate; then after every doubling. */
#define FIRST_LOOK 2u
/* Samples tell nothing of light that none of them has found, except that less than about 3 in their number carry it. So
 * many are taken before an answer is believed: of nothing but zeros, which where lights are sampled means shadow; of
 * paths that search; and of nothing but zeros from a search by reflections alone, which may take long to find a small
 * light, unless a floor under the error makes it too faint to matter. */
#define ZEROS_BELIEVED        512u
#define SEARCH_BELIEVED       512u
#define EMPTY_SEARCH_BELIEVED 65536u

/* In all that is noisy, something of the value's own size that has happened in none of n samples may yet change the
 * mean by a part of 1/n; so many times 1/n must be within the error. */
#define UNSEEN 1.0

typedef struct replicates {
    uint64_t key[ESTIMATE_REPLICATES];
    rgb sum[ESTIMATE_REPLICATES];
    path_control controls[PATH_CONTROLS][ESTIMATE_REPLICATES]; /* sums */
    path_control totals[PATH_CONTROLS];
    int control_count;
    uint32_t taken;     /* of all replicates together */
    estimate_luck luck; /* the worst of any sample */
} replicates;

static uint32_t replicate_count(const replicates *r, int i) {
    return r->taken / ESTIMATE_REPLICATES + ((uint32_t)i < r->taken % ESTIMATE_REPLICATES);
}

/* The share of a control that is added to a replicate's sum: of what the other replicates have found, so that it does
 * not depend on the replicate's own samples and the mean stays what it is. */
static double share_of_control(const path_control *total, const path_control *own) {
    double lit = total->lit - own->lit, whole = total->whole - own->whole;
    return lit < whole ? fmax(lit, 0) / whole : 1;
}

static rgb controlled_sum(const replicates *r, int i) {
    rgb sum = r->sum[i];
    for (int k = 0; k < r->control_count; k++)
        sum = rgb_add_scaled(sum, share_of_control(&r->totals[k], &r->controls[k][i]), r->controls[k][i].difference);
    return sum;
}

/* The mean of all samples, and its standard error: the replicates' sums scatter about their shares of the total. */
static void summarize(const replicates *r, graze_answer *answer) {
    rgb sums[ESTIMATE_REPLICATES], total = {0, 0, 0}, variance = {0, 0, 0};
    int used = r->taken < ESTIMATE_REPLICATES ? (int)r->taken : ESTIMATE_REPLICATES;
    for (int i = 0; i < used; i++) {
        sums[i] = controlled_sum(r, i);
        total = rgb_add(total, sums[i]);
    }
    rgb mean = rgb_scale(1.0 / r->taken, total);
    for (int i = 0; i < used; i++) {
        rgb deviation = rgb_add_scaled(sums[i], -(double)replicate_count(r, i), mean);
        variance = rgb_add(variance, rgb_multiply(deviation, deviation));
    }
    double scale = used > 1 ? used / (used - 1.0) / ((double)r->taken * r->taken) : 0;
    answer->value = mean;
    answer->standard_error = (rgb){sqrt(scale * variance.r), sqrt(scale * variance.g), sqrt(scale * variance.b)};
    answer->samples = r->taken;
}

static void add_control(path_control *sum, const path_control *control) {
    sum->difference = rgb_add(sum->difference, control->difference);
    sum->lit += control->lit;
    sum->whole += control->whole;
}

static estimate_luck take_one(replicates *r, estimate_sample *sample, void *user) {
    int i = (int)(r->taken % ESTIMATE_REPLICATES);
    sampler points = sampler_start(r->key[i], r->taken / ESTIMATE_REPLICATES);
    estimate_luck luck = ESTIMATE_NOISY;
    path_sample taken = sample(user, &points, &luck);
    r->sum[i] = rgb_add(r->sum[i], taken.radiance);
    for (int k = 0; k < taken.control_count; k++) {
        add_control(&r->controls[k][i], &taken.controls[k]);
        add_control(&r->totals[k], &taken.controls[k]);
    }
    r->control_count = taken.control_count > r->control_count ? taken.control_count : r->control_count;
    r->luck = luck > r->luck ? luck : r->luck;
    r->taken++;
    return luck;
}

static void take_until(replicates *r, uint32_t goal, estimate_sample *sample, void *user) {
    while (r->taken < goal)
        (void)take_one(r, sample, user);
}

static double samples_to_believe(const graze_trace_settings *s, const replicates *r, double value) {
    if (r->luck < ESTIMATE_NOISY)
        return 0;
    bool search = r->luck == ESTIMATE_SEARCH;
    if (value == 0 && search && !path_samples_lights(s) && s->floor == 0)
        return EMPTY_SEARCH_BELIEVED;
    if (value == 0)
        return ZEROS_BELIEVED;
    double unseen = UNSEEN * value / (s->error * fmax(value, s->floor));
    return search ? fmax(unseen, SEARCH_BELIEVED) : unseen;
}

/* How many times too large the error is. */
static double excess(const graze_trace_settings *s, const graze_answer *answer) {
    double value = rgb_max(answer->value), allowed = s->error * fmax(value, s->floor);
    return allowed > 0 ? rgb_max(answer->standard_error) / allowed : 0;
}

/* Looks at the error after every doubling, until it is small enough or the limit is reached. An error that is small by
 * chance, because the samples happen to agree, was seldom small before; so it must have been at most twice as large
 * when there were half as many. */
static bool refine(replicates *r, const graze_trace_settings *s, estimate_sample *sample, void *user,
                   graze_answer *answer) {
    double before = 0;
    for (uint64_t goal = FIRST_LOOK * ESTIMATE_REPLICATES;; goal *= 2) {
        bool last = goal >= s->sample_limit;
        take_until(r, last ? s->sample_limit : (uint32_t)goal, sample, user);
        summarize(r, answer);
        double now = excess(s, answer);
        if (now <= 1 && before <= 2 && r->taken >= samples_to_believe(s, r, rgb_max(answer->value)))
            return true;
        if (last)
            return false;
        before = now;
    }
}

void estimate(const graze_trace_settings *s, uint64_t stream, estimate_sample *sample, void *user,
              graze_answer *answer) {
    replicates r = {.taken = 0};
    for (int i = 0; i < ESTIMATE_REPLICATES; i++)
        r.key[i] = sampler_key(s->seed, stream, (uint32_t)i);
    *answer = (graze_answer){.converged = 1};
    if (take_one(&r, sample, user) == ESTIMATE_EXACT) {
        answer->value = r.sum[0];
        answer->samples = 1;
    } else if (s->samples) {
        take_until(&r, s->samples, sample, user);
        summarize(&r, answer);
    } else {
        answer->converged = refine(&r, s, sample, user, answer);
    }
}
