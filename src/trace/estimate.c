/* Replicates, their mean and its standard error, and when to stop. */
#include "trace/estimate.h"

#include "base/vector.h"

/* The first look at the error comes after this many samples a replicate; then after every doubling. */
#define FIRST_LOOK 2u
/* Nothing but zeros says nothing of the error, except that less than about 3 in this many paths carry light. Where
 * lights are sampled that means shadow; reflections alone may take long to find a small light, and every one counts if
 * there is no floor under the error. */
#define ZEROS_BELIEVED                512u
#define ZEROS_BELIEVED_OF_REFLECTIONS 65536u

typedef struct replicates {
    uint64_t key[ESTIMATE_REPLICATES];
    rgb sum[ESTIMATE_REPLICATES];
    uint32_t taken; /* of all replicates together */
    bool noisy;     /* whether any sample was */
} replicates;

static uint32_t replicate_count(const replicates *r, int i) {
    return r->taken / ESTIMATE_REPLICATES + ((uint32_t)i < r->taken % ESTIMATE_REPLICATES);
}

/* The mean of all samples, and its standard error: the replicates' sums scatter about their shares of the total. */
static void summarize(const replicates *r, graze_answer *answer) {
    rgb total = {0, 0, 0}, variance = {0, 0, 0};
    int used = r->taken < ESTIMATE_REPLICATES ? (int)r->taken : ESTIMATE_REPLICATES;
    for (int i = 0; i < used; i++)
        total = rgb_add(total, r->sum[i]);
    rgb mean = rgb_scale(1.0 / r->taken, total);
    for (int i = 0; i < used; i++) {
        rgb deviation = rgb_add_scaled(r->sum[i], -(double)replicate_count(r, i), mean);
        variance = rgb_add(variance, rgb_multiply(deviation, deviation));
    }
    double scale = used > 1 ? used / (used - 1.0) / ((double)r->taken * r->taken) : 0;
    answer->value = mean;
    answer->standard_error = (rgb){sqrt(scale * variance.r), sqrt(scale * variance.g), sqrt(scale * variance.b)};
    answer->samples = r->taken;
}

static estimate_luck take_one(replicates *r, estimate_sample *sample, void *user) {
    int i = (int)(r->taken % ESTIMATE_REPLICATES);
    sampler points = sampler_start(r->key[i], r->taken / ESTIMATE_REPLICATES);
    estimate_luck luck = ESTIMATE_NOISY;
    r->sum[i] = rgb_add(r->sum[i], sample(user, &points, &luck));
    r->noisy = r->noisy || luck == ESTIMATE_NOISY;
    r->taken++;
    return luck;
}

static void take_until(replicates *r, uint32_t goal, estimate_sample *sample, void *user) {
    while (r->taken < goal)
        (void)take_one(r, sample, user);
}

static bool are_zeros_believed(const graze_trace_settings *s, const replicates *r) {
    bool lucky = s->strategy == GRAZE_STRATEGY_BRDF && s->floor == 0;
    return !r->noisy || r->taken >= (lucky ? ZEROS_BELIEVED_OF_REFLECTIONS : ZEROS_BELIEVED);
}

static bool is_good_enough(const graze_trace_settings *s, const replicates *r, const graze_answer *answer) {
    double value = rgb_max(answer->value), error = rgb_max(answer->standard_error);
    return value == 0 ? are_zeros_believed(s, r) : error <= s->error * fmax(value, s->floor);
}

/* Looks at the error after every doubling, until it is good enough or the limit is reached. */
static bool refine(replicates *r, const graze_trace_settings *s, estimate_sample *sample, void *user,
                   graze_answer *answer) {
    for (uint32_t goal = FIRST_LOOK * ESTIMATE_REPLICATES;; goal *= 2) {
        bool last = goal >= s->sample_limit;
        take_until(r, last ? s->sample_limit : goal, sample, user);
        summarize(r, answer);
        if (is_good_enough(s, r, answer))
            return true;
        if (last)
            return false;
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
