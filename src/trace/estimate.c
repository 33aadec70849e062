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

enum { HALVES = 2, IN_HALF = ESTIMATE_REPLICATES / HALVES };

/* One half of the replicates. Whatever is decided about a half's samples - how many there are, how much of a control is
 * added - is decided by what the other half has found. Decisions then do not depend on the samples that they are about,
 * and neither the mean nor its error is led astray: an answer that stopped when it looked good enough to itself would
 * be biased towards what looks good. */
typedef struct half {
    uint64_t key[IN_HALF];
    rgb sum[IN_HALF], spread;
    path_control controls[PATH_CONTROLS][IN_HALF]; /* sums */
    path_control totals[PATH_CONTROLS];
    int control_count;
    uint32_t taken;     /* of all replicates together */
    estimate_luck luck; /* the worst of any sample */
} half;

static uint32_t replicate_count(const half *h, int i) {
    return h->taken / IN_HALF + ((uint32_t)i < h->taken % IN_HALF);
}

static int replicates_used(const half *h) {
    return h->taken < IN_HALF ? (int)h->taken : IN_HALF;
}

/* The share of a control that the other half's replicates add: what of it is not shadowed. */
static double share_of_control(const path_control *found) {
    return found->lit < found->whole ? fmax(found->lit, 0) / found->whole : 1;
}

static rgb controlled_sum(const half *h, const half *other, int i) {
    rgb sum = h->sum[i];
    for (int k = 0; k < h->control_count; k++)
        sum = rgb_add_scaled(sum, share_of_control(&other->totals[k]), h->controls[k][i].difference);
    return sum;
}

static rgb total_of(const half *h, const half *other) {
    rgb total = {0, 0, 0};
    for (int i = 0; i < replicates_used(h); i++)
        total = rgb_add(total, controlled_sum(h, other, i));
    return total;
}

/* How widely the replicates' sums scatter about their shares of a mean: the sum of squares. */
static rgb scatter_of(const half *h, const half *other, rgb mean) {
    rgb sum = {0, 0, 0};
    for (int i = 0; i < replicates_used(h); i++) {
        rgb deviation = rgb_add_scaled(controlled_sum(h, other, i), -(double)replicate_count(h, i), mean);
        sum = rgb_add(sum, rgb_multiply(deviation, deviation));
    }
    return sum;
}

/* A mean and its variance. */
typedef struct finding {
    rgb mean, variance;
    uint32_t taken;
    estimate_luck luck;
} finding;

static rgb variance_of(rgb scatter, int used, uint32_t taken) {
    return rgb_scale(used > 1 ? used / (used - 1.0) / ((double)taken * taken) : 0, scatter);
}

static finding finding_of(const half *h, const half *other) {
    rgb mean = rgb_scale(1.0 / h->taken, total_of(h, other));
    return (finding){mean, variance_of(scatter_of(h, other, mean), replicates_used(h), h->taken), h->taken, h->luck};
}

/* Of what is known without sampling, the error that graze/brdf_light.h allows. */
#define KNOWN_ERROR 1e-8

static double standard_error(double variance, double known) {
    return sqrt(variance + KNOWN_ERROR * known * (KNOWN_ERROR * known));
}

static void set_answer(graze_answer *answer, rgb mean, rgb variance, const half halves[HALVES]) {
    rgb spread = rgb_scale(1.0 / (halves[0].taken + halves[1].taken), rgb_add(halves[0].spread, halves[1].spread));
    variance = rgb_add(variance, rgb_multiply(spread, spread));
    rgb known = halves[0].control_count + halves[1].control_count > 0 ? mean : rgb_gray(0);
    answer->value = mean;
    answer->standard_error = (rgb){standard_error(variance.r, known.r), standard_error(variance.g, known.g),
                                   standard_error(variance.b, known.b)};
    answer->samples = halves[0].taken + halves[1].taken;
}

/* Where both halves have as many samples, the mean of all. */
static void summarize_together(const half halves[HALVES], graze_answer *answer) {
    uint32_t taken = halves[0].taken + halves[1].taken;
    rgb total = rgb_add(total_of(&halves[0], &halves[1]), total_of(&halves[1], &halves[0]));
    rgb mean = rgb_scale(1.0 / taken, total);
    rgb scatter = rgb_add(scatter_of(&halves[0], &halves[1], mean), scatter_of(&halves[1], &halves[0], mean));
    int used = replicates_used(&halves[0]) + replicates_used(&halves[1]);
    set_answer(answer, mean, variance_of(scatter, used, taken), halves);
}

/* Where the numbers were decided to be different, the mean of both halves, each counted as much as the other: a weight
 * by its number of samples would depend on the other's. */
static void summarize_evenly(const half halves[HALVES], graze_answer *answer) {
    finding a = finding_of(&halves[0], &halves[1]), b = finding_of(&halves[1], &halves[0]);
    set_answer(answer, rgb_scale(0.5, rgb_add(a.mean, b.mean)), rgb_scale(0.25, rgb_add(a.variance, b.variance)),
               halves);
}

static void summarize(const half halves[HALVES], graze_answer *answer) {
    if (halves[0].taken < halves[1].taken + 2 && halves[1].taken <= halves[0].taken)
        summarize_together(halves, answer);
    else
        summarize_evenly(halves, answer);
}

static void add_control(path_control *sum, const path_control *control) {
    sum->difference = rgb_add(sum->difference, control->difference);
    sum->lit += control->lit;
    sum->whole += control->whole;
}

static estimate_luck take_one(half *h, estimate_sample *sample, void *user) {
    int i = (int)(h->taken % IN_HALF);
    sampler points = sampler_start(h->key[i], h->taken / IN_HALF);
    estimate_luck luck = ESTIMATE_NOISY;
    path_sample taken = sample(user, &points, &luck);
    h->sum[i] = rgb_add(h->sum[i], taken.radiance);
    h->spread = rgb_add(h->spread, taken.spread);
    for (int k = 0; k < taken.control_count; k++) {
        add_control(&h->controls[k][i], &taken.controls[k]);
        add_control(&h->totals[k], &taken.controls[k]);
    }
    h->control_count = taken.control_count > h->control_count ? taken.control_count : h->control_count;
    h->luck = luck > h->luck ? luck : h->luck;
    h->taken++;
    return luck;
}

static void take_until(half *h, uint32_t goal, estimate_sample *sample, void *user) {
    while (h->taken < goal)
        (void)take_one(h, sample, user);
}

static double samples_to_believe(const graze_trace_settings *s, estimate_luck luck, double value) {
    if (luck < ESTIMATE_NOISY)
        return 0;
    bool search = luck == ESTIMATE_SEARCH;
    if (value == 0 && search && !context_samples_lights(s) && s->floor == 0)
        return EMPTY_SEARCH_BELIEVED;
    if (value == 0)
        return ZEROS_BELIEVED;
    double unseen = UNSEEN * value / (s->error * fmax(value, s->floor));
    return search ? fmax(unseen, SEARCH_BELIEVED) : unseen;
}

/* How many times too large the error of both halves together would be if the other half had `taken` samples, too, as
 * its finding tells. */
static double excess(const graze_trace_settings *s, const finding *found, uint32_t taken) {
    double allowed = s->error * fmax(rgb_max(found->mean), s->floor);
    double variance = rgb_max(found->variance) / HALVES * found->taken / taken;
    return allowed > 0 ? sqrt(variance) / allowed : 0;
}

/* Doubles each half's samples until the other finds them enough, for good, or the limit is reached. An error that is
 * small by chance, because the samples happen to agree, was seldom small before; so it must have been at most twice as
 * large when there were half as many. In the end both together must say so, too, or all begins again. */
static bool refine(half halves[HALVES], const graze_trace_settings *s, estimate_sample *sample, void *user,
                   graze_answer *answer) {
    uint32_t limit = s->sample_limit / HALVES;
    bool enough[HALVES] = {false, false};
    double before[HALVES] = {0, 0};
    for (uint64_t goal = FIRST_LOOK * IN_HALF;; goal *= 2) {
        bool last = goal >= limit;
        for (int i = 0; i < HALVES; i++)
            if (!enough[i])
                take_until(&halves[i], last ? limit : (uint32_t)goal, sample, user);
        const finding findings[HALVES] = {finding_of(&halves[0], &halves[1]), finding_of(&halves[1], &halves[0])};
        for (int i = 0; i < HALVES; i++) {
            const finding *other = &findings[1 - i];
            double now = excess(s, other, halves[i].taken);
            double needed = samples_to_believe(s, other->luck, rgb_max(other->mean)) / HALVES;
            enough[i] = enough[i] || (now <= 1 && before[i] <= 2 && halves[i].taken >= needed);
            before[i] = now;
        }
        if (!last && !(enough[0] && enough[1]))
            continue;
        summarize(halves, answer);
        double allowed = s->error * fmax(rgb_max(answer->value), s->floor);
        bool reached = enough[0] && enough[1] && rgb_max(answer->standard_error) <= allowed;
        if (reached || last)
            return reached;
        enough[0] = enough[1] = false;
    }
}

void estimate(const graze_trace_settings *s, uint64_t stream, estimate_sample *sample, void *user,
              graze_answer *answer) {
    half halves[HALVES] = {{.taken = 0}, {.taken = 0}};
    for (int i = 0; i < ESTIMATE_REPLICATES; i++)
        halves[i % HALVES].key[i / HALVES] = sampler_key(s->seed, stream, (uint32_t)i);
    *answer = (graze_answer){.converged = 1};
    if (take_one(&halves[0], sample, user) == ESTIMATE_EXACT) {
        answer->value = halves[0].sum[0];
        answer->samples = 1;
    } else if (s->samples) {
        take_until(&halves[0], s->samples - s->samples / HALVES, sample, user);
        take_until(&halves[1], s->samples / HALVES, sample, user);
        summarize(halves, answer);
    } else {
        answer->converged = refine(halves, s, sample, user, answer);
    }
}
