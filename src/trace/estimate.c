/* Two scrambled sequences, their mean and its standard error, and when to stop. */
#include "trace/estimate.h"

#include "base/vector.h"
#include "trace/context.h"
#include "trace/path.h"

/* The first look at the error comes after this many samples of each half; then after every doubling. */
#define FIRST_LOOK 4u
/* Samples tell nothing of light that none of them has found, except that less than about 3 in their number carry it. So
 * many are taken before an answer is believed: of nothing but zeros, which where lights are sampled means shadow; of
 * paths that search; and of nothing but zeros from a search by reflections alone, which may take long to find a small
 * light, unless a floor under the error makes it too faint to matter. */
#define ZEROS_BELIEVED        512u
#define SEARCH_BELIEVED       512u
#define EMPTY_SEARCH_BELIEVED 65536u

/* In all that is noisy, something of the value's own size that has happened in none of n samples may yet change the
 * mean: by 3/n of it where they are few and like independent ones, by 1/n where they are spread evenly. That much must
 * be within the error. Below the floor a value's own size says little of what may yet come, and the less the smaller it
 * is: what is missing may be as large beside the floor as the floor is beside the value. So many samples are taken, but
 * not more than of zeros. */
#define UNSEEN      1.0
#define UNSEEN_FEW  3.0
#define FEW_SAMPLES 32.0

/* Where so much of what was expected of gloss has been found, its peaks have been met, and scatter tells the error. */
#define FOUND_ENOUGH 0.25

/* A half keeps the sums of so many blocks of 2^j samples in a row; when they are full, j grows by 1. */
#define BLOCKS 16

/* One half of the samples: a sequence of its own. Whatever is decided about a half's samples - how many there are, how
 * much of a control is added - is decided by what the other half has found. Decisions then do not depend on the samples
 * that they are about, and neither the mean nor its error is led astray: an answer that stopped when it looked good
 * enough to itself would be biased towards what looks good. */
typedef struct half {
    uint64_t key;
    uint32_t taken;
    int level;          /* a block has 2^level samples */
    estimate_luck luck; /* the worst of any sample */
    path_rare rare;     /* sums */
    bool integrated;    /* whether light was integrated in any sample */
    int control_count;
    bool with_parts;
    estimate_parts parts; /* sums */
    rgb known_error;      /* sum of the errors of what was known beforehand */
    bool cached;
    rgb told[IRRADIANCE_PARTS];                      /* sums */
    double lit[PATH_CONTROLS], whole[PATH_CONTROLS]; /* sums of the controls' */
    rgb sum[BLOCKS];                                 /* those after the last block begun are not set */
    rgb difference[BLOCKS][PATH_CONTROLS];
} half;

enum { HALVES = 2 };

static void merge_blocks(half *h) {
    for (int i = 0; i < BLOCKS / 2; i++) {
        h->sum[i] = rgb_add(h->sum[2 * i], h->sum[2 * i + 1]);
        for (int k = 0; k < h->control_count; k++)
            h->difference[i][k] = rgb_add(h->difference[2 * i][k], h->difference[2 * i + 1][k]);
    }
    h->level++;
}

/* The block that the next sample belongs to. */
static int next_block(half *h) {
    if (h->taken >> h->level == BLOCKS)
        merge_blocks(h);
    int block = (int)(h->taken >> h->level);
    if (h->taken == (uint32_t)block << h->level) {
        h->sum[block] = rgb_gray(0);
        for (int k = 0; k < h->control_count; k++)
            h->difference[block][k] = rgb_gray(0);
    }
    return block;
}

static void add_controls(half *h, int block, const path_sample *sample) {
    for (; h->control_count < sample->control_count; h->control_count++) {
        int k = h->control_count;
        h->lit[k] = h->whole[k] = 0;
        for (int i = 0; i <= block; i++)
            h->difference[i][k] = rgb_gray(0);
    }
    for (int k = 0; k < sample->control_count; k++) {
        const path_control *control = &sample->controls[k];
        h->difference[block][k] = rgb_add(h->difference[block][k], control->difference);
        h->lit[k] += control->lit;
        h->whole[k] += control->whole;
    }
}

static void add_told(half *h, const path_sample *sample) {
    for (int i = 0; i < IRRADIANCE_PARTS; i++)
        h->told[i] = rgb_add(h->cached ? h->told[i] : rgb_gray(0), sample->told[i]);
    h->cached = true;
}

static void add_rare(path_rare *sum, const path_rare *rare) {
    sum->expected += rare->expected;
    sum->squares += rare->squares;
    sum->found += rare->found;
    sum->times += rare->times;
}

static estimate_luck take_one(half *h, estimate_sample *sample, void *user) {
    sampler points = sampler_start(h->key, h->taken);
    estimate_luck luck = ESTIMATE_NOISY;
    path_sample taken = sample(user, &points, &luck);
    int block = next_block(h);
    h->sum[block] = rgb_add(h->sum[block], taken.radiance);
    add_controls(h, block, &taken);
    h->integrated = h->integrated || taken.integrated;
    add_rare(&h->rare, &taken.rare);
    if (taken.cached)
        add_told(h, &taken);
    h->known_error = rgb_add(h->known_error, taken.known_error);
    h->luck = luck > h->luck ? luck : h->luck;
    if (h->with_parts) {
        h->parts.indirect = rgb_add(h->parts.indirect, taken.indirect);
        h->parts.albedo = rgb_add(h->parts.albedo, taken.albedo);
    }
    h->taken++;
    return luck;
}

static void take_until(half *h, uint32_t goal, estimate_sample *sample, void *user) {
    while (h->taken < goal)
        (void)take_one(h, sample, user);
}

/* How the variance of the mean of 2^j samples in a row may fall: as 2^-j, as that of independent samples does, or as
 * 4^-j, as it does along edges and better of what is smooth. Beyond that nothing is taken for granted. */
typedef struct laws {
    double slow, fast;
} laws;

/* Of n samples, in units of one sample's variance. With the fast law two blocks of p samples that make one of 2p have
 * the covariance -1/(2p^2), and so has any part of one with the other; hence the variance of a sum is 1 for each binary
 * digit of n that is 1, of value p, less (the sum of the digits below)/p. */
static laws variance_of_mean(uint32_t n) {
    double sum = 0;
    for (uint32_t rest = n, p = UINT32_C(1) << 31; p > 0; p >>= 1)
        if (rest >= p) {
            rest -= p;
            sum += 1 - (double)rest / p;
        }
    return (laws){1.0 / n, sum / ((double)n * n)};
}

/* Of half the difference of two blocks of 2^level samples that make up one: the variance of a block less that of both
 * together. */
static laws variance_of_difference(int level) {
    return (laws){0.5 * ldexp(1, -level), 0.75 * ldexp(1, -2 * level)};
}

/* What has been seen of the variance: squares over what each law expects of them. */
typedef struct evidence {
    double freedom; /* of how many squares */
    rgb slow, fast;
    double odds; /* log2 of how much likelier the sizes of the squares are by the fast law, but for its own sum */
} evidence;

static void add_evidence(evidence *e, laws expected, double freedom, rgb squares) {
    e->freedom += freedom;
    e->slow = rgb_add_scaled(e->slow, 1 / expected.slow, squares);
    e->fast = rgb_add_scaled(e->fast, 1 / expected.fast, squares);
    e->odds += freedom / 2 * log2(expected.slow / expected.fast);
}

/* How much likelier the slow law is beforehand. Of many intervals like those in test/trace/coverage.c 93.7% hold the
 * truth with 1, 96.4% with 4, which also is right where samples are as good as independent. */
#define SLOW_BEFOREHAND 3.0

/* The probability of the fast law (of normal values, their variance unknown). */
static double probability_of_fast(const evidence *e) {
    double slow = e->slow.r + e->slow.g + e->slow.b, fast = e->fast.r + e->fast.g + e->fast.b;
    return 1 / (1 + SLOW_BEFOREHAND * exp2(-e->odds - e->freedom / 2 * log2(slow / fast)));
}

/* (t/1.96)^2, where t bounds 95% of Student's distribution: within 2% from 1 degree of freedom on. Of less than that
 * hardly anything is known. */
static double widening(double freedom) {
    double f = fmax(freedom, 1);
    return 1 + 2.42 / (f - 1.77 + 0.829 / f);
}

/* The variance of what has the variance `wanted` in units of one sample's; so much larger that 1.96 of its roots bound
 * 95% of all errors. */
static rgb variance_by(const evidence *e, laws wanted) {
    if (rgb_max(e->slow) <= 0)
        return rgb_gray(0);
    double probability = probability_of_fast(e), scale = widening(e->freedom) / e->freedom;
    rgb slow = rgb_scale((1 - probability) * wanted.slow, e->slow);
    return rgb_scale(scale, rgb_add_scaled(slow, probability * wanted.fast, e->fast));
}

/* The share of a control that the other half's samples add: what of it is not shadowed. */
static double share_of_control(const half *other, int k) {
    bool shadowed = k < other->control_count && other->lit[k] < other->whole[k];
    return shadowed ? fmax(other->lit[k], 0) / other->whole[k] : 1;
}

/* What a half has found. */
typedef struct finding {
    rgb mean;
    evidence evidence;
} finding;

static void add_differences(evidence *e, rgb *mean, int count, int level) {
    for (; count > 1; count /= 2, level++) {
        int pairs = count / 2;
        rgb squares = {0, 0, 0};
        for (int i = 0; i < pairs; i++) {
            rgb difference = rgb_scale(0.5, rgb_add_scaled(mean[2 * i], -1, mean[2 * i + 1]));
            squares = rgb_add(squares, rgb_multiply(difference, difference));
            mean[i] = rgb_scale(0.5, rgb_add(mean[2 * i], mean[2 * i + 1]));
        }
        add_evidence(e, variance_of_difference(level), pairs, squares);
    }
}

static finding finding_of(const half *h, const half *other) {
    double share[PATH_CONTROLS];
    for (int k = 0; k < h->control_count; k++)
        share[k] = share_of_control(other, k);
    int full = (int)(h->taken >> h->level), begun = full + (h->taken > (uint32_t)full << h->level);
    rgb mean[BLOCKS], total = {0, 0, 0};
    for (int i = 0; i < begun; i++) {
        rgb sum = h->sum[i];
        for (int k = 0; k < h->control_count; k++)
            sum = rgb_add_scaled(sum, share[k], h->difference[i][k]);
        total = rgb_add(total, sum);
        mean[i] = rgb_scale(ldexp(1, -h->level), sum);
    }
    finding found = {.mean = rgb_scale(1.0 / h->taken, total)};
    add_differences(&found.evidence, mean, full, h->level);
    return found;
}

static evidence joined(const evidence *a, const evidence *b) {
    return (evidence){a->freedom + b->freedom, rgb_add(a->slow, b->slow), rgb_add(a->fast, b->fast), a->odds + b->odds};
}

/* Of what is known without sampling, the error that graze/brdf_light.h allows; of what differs from sample to sample,
 * if in its last digits only, that of adding some thousands in a row. */
#define KNOWN_ERROR    1e-8
#define ROUNDING_ERROR 1e-12

static rgb with_known_error(rgb variance, rgb value, bool integrated) {
    rgb error = rgb_scale(integrated ? KNOWN_ERROR : rgb_max(variance) > 0 ? ROUNDING_ERROR : 0, value);
    rgb sum = rgb_add(variance, rgb_multiply(error, error));
    return (rgb){sqrt(sum.r), sqrt(sum.g), sqrt(sum.b)};
}

/* Radiance is not negative, though controls are, and few samples of much noise may leave more of them than of light:
 * the value nearest to what was found is then 0, and nearer to the truth whatever that is. */
static rgb not_negative(rgb mean) {
    return (rgb){fmax(mean.r, 0), fmax(mean.g, 0), fmax(mean.b, 0)};
}

/* How much each half counts: by its number of samples where that is as good as the other's; where the numbers were
 * decided to be different, as much as the other, since its number depends on what the other found. */
static void share_halves(const half halves[HALVES], double share[HALVES]) {
    uint32_t all = halves[0].taken + halves[1].taken;
    bool alike = halves[0].taken < halves[1].taken + 2 && halves[1].taken <= halves[0].taken;
    for (int i = 0; i < HALVES; i++)
        share[i] = alike ? (double)halves[i].taken / all : 0.5;
}

/* Shadows of lights that are seen in part, as far as is known, may lie where no sample has been: about one part in as
 * many as there are samples. Not more than what is seen, and nothing where zeros are believed. */
static double unseen_shadows(const half halves[HALVES], double brightness) {
    double unseen = 0;
    if (brightness <= 0 && halves[0].taken + halves[1].taken >= ZEROS_BELIEVED)
        return 0;
    for (int k = 0; k < PATH_CONTROLS; k++) {
        double lit = 0, whole = 0;
        uint32_t taken = 0;
        for (int i = 0; i < HALVES; i++) {
            bool known = k < halves[i].control_count;
            lit += known ? halves[i].lit[k] : 0;
            whole += known ? halves[i].whole[k] : 0;
            taken += halves[i].taken;
        }
        if (lit >= whole || lit <= 0)
            unseen += whole / ((double)taken * taken);
    }
    return brightness > 0 ? fmin(unseen, brightness) : unseen;
}

/* What is missing of a mean of `count` samples, as it was found by `taken`, if next to nothing was found of what gloss
 * is expected to reflect of small lights: all of that, but the less, the more peaks of it should have been met; and
 * more, where what is expected is known by a few points alone. */
static double unseen_gloss(const path_rare *sum, double taken, double count) {
    double missing = (sum->expected - sum->found / FOUND_ENOUGH) / taken;
    if (missing <= 0 || sum->squares <= 0)
        return 0;
    double peaks = count / taken * sum->expected * sum->expected / sum->squares;
    return missing * (1 + 1 / sum->times) * fmin(UNSEEN_FEW / peaks, 1);
}

/* Of the mean of what the irradiance cache's parts say, as they differ. */
static rgb variance_of_cache(const half halves[HALVES], const double share[HALVES]) {
    rgb told[IRRADIANCE_PARTS], mean = {0, 0, 0}, squares = {0, 0, 0};
    for (int k = 0; k < IRRADIANCE_PARTS; k++) {
        told[k] = rgb_gray(0);
        for (int i = 0; i < HALVES; i++)
            if (halves[i].cached)
                told[k] = rgb_add_scaled(told[k], share[i] / halves[i].taken, halves[i].told[k]);
        mean = rgb_add_scaled(mean, 1.0 / IRRADIANCE_PARTS, told[k]);
    }
    for (int k = 0; k < IRRADIANCE_PARTS; k++) {
        rgb difference = rgb_add_scaled(told[k], -1, mean);
        squares = rgb_add(squares, rgb_multiply(difference, difference));
    }
    double freedom = IRRADIANCE_PARTS - 1;
    return rgb_scale(widening(freedom) / (freedom * IRRADIANCE_PARTS), squares);
}

/* Of what was known beforehand: the same surface's in all samples, it does not average out. */
static rgb variance_of_known(const half halves[HALVES], const double share[HALVES]) {
    rgb error = {0, 0, 0};
    for (int i = 0; i < HALVES; i++)
        if (halves[i].taken > 0)
            error = rgb_add_scaled(error, share[i] / halves[i].taken, halves[i].known_error);
    return rgb_multiply(error, error);
}

static void summarize(const half halves[HALVES], const finding found[HALVES], graze_answer *answer) {
    double share[HALVES];
    share_halves(halves, share);
    laws first = variance_of_mean(halves[0].taken), second = variance_of_mean(halves[1].taken);
    evidence e = joined(&found[0].evidence, &found[1].evidence);
    rgb between = rgb_add_scaled(found[0].mean, -1, found[1].mean);
    add_evidence(&e, (laws){first.slow + second.slow, first.fast + second.fast}, 1, rgb_multiply(between, between));
    double squares[HALVES] = {share[0] * share[0], share[1] * share[1]};
    rgb variance = variance_by(&e, (laws){squares[0] * first.slow + squares[1] * second.slow,
                                          squares[0] * first.fast + squares[1] * second.fast});
    if (halves[0].cached || halves[1].cached)
        variance = rgb_add(variance, variance_of_cache(halves, share));
    variance = rgb_add(variance, variance_of_known(halves, share));
    answer->value = not_negative(rgb_add_scaled(rgb_scale(share[0], found[0].mean), share[1], found[1].mean));
    double brightness = rgb_brightness(answer->value), shadows = unseen_shadows(halves, brightness);
    path_rare rare = halves[0].rare;
    add_rare(&rare, &halves[1].rare);
    double taken = (double)halves[0].taken + halves[1].taken,
           unseen = hypot(shadows, unseen_gloss(&rare, taken, taken));
    if (unseen > 0) {
        rgb part = brightness > 0 ? rgb_scale(unseen / brightness, answer->value) : rgb_gray(unseen);
        variance = rgb_add(variance, rgb_multiply(part, part));
    }
    answer->standard_error = with_known_error(variance, answer->value, halves[0].integrated || halves[1].integrated);
    answer->samples = halves[0].taken + halves[1].taken;
}

static double samples_to_believe(const graze_trace_settings *s, estimate_luck luck, double value) {
    if (luck < ESTIMATE_NOISY)
        return 0;
    bool search = luck == ESTIMATE_SEARCH;
    if (value == 0 && search && !context_samples_lights(s) && s->floor == 0)
        return EMPTY_SEARCH_BELIEVED;
    if (value == 0)
        return ZEROS_BELIEVED;
    double few = UNSEEN_FEW / s->error, unseen = fmax(UNSEEN / s->error, fmin(few, FEW_SAMPLES));
    if (value < s->floor)
        unseen = fmax(unseen, fmin(few * s->floor / value, ZEROS_BELIEVED));
    return search ? fmax(unseen, SEARCH_BELIEVED) : unseen;
}

/* Whether so many samples in either half are enough, as one of them finds. */
static bool is_enough(const graze_trace_settings *s, uint32_t least, const half *judge, const finding *found,
                      uint32_t taken) {
    double value = rgb_max(found->mean);
    if (taken < fmax(samples_to_believe(s, judge->luck, value), least) / HALVES)
        return false;
    double allowed = s->error * fmax(value, s->floor);
    rgb variance = variance_by(&found->evidence, variance_of_mean(taken));
    double unseen = unseen_gloss(&judge->rare, judge->taken, (double)taken * HALVES);
    return rgb_max(variance) / HALVES + unseen * unseen <= allowed * allowed;
}

/* Where only the place in the pixel decides what is seen, halves begin with so few samples that one may see an edge
 * that the other does not; this much more than the error asked for then is too much. Going on does make such pixels a
 * little too dark at bright edges, but the same edge would else be bright in some pixels and missing in others. */
#define STATED_OF_PLACES 1.5

static bool is_torn(const graze_trace_settings *s, const half halves[HALVES], const graze_answer *answer) {
    double allowed = s->error * fmax(rgb_max(answer->value), s->floor);
    return halves[0].luck < ESTIMATE_NOISY && halves[1].luck < ESTIMATE_NOISY &&
           rgb_max(answer->standard_error) > STATED_OF_PLACES * allowed;
}

/* Doubles each half's samples until the other finds them enough, for good, or the limit is reached. What both together
 * then state may be more than the error asked for; going on because of that would have samples judge themselves: those
 * that found much and scatter would be added to, those that found little and scatter less would be believed. */
static bool refine(half halves[HALVES], const graze_trace_settings *s, uint32_t least, estimate_sample *sample,
                   void *user, graze_answer *answer) {
    uint32_t limit = s->sample_limit / HALVES;
    bool enough[HALVES] = {false, false};
    for (uint64_t goal = FIRST_LOOK;; goal *= 2) {
        bool last = goal >= limit;
        for (int i = 0; i < HALVES; i++)
            if (!enough[i])
                take_until(&halves[i], last ? limit : (uint32_t)goal, sample, user);
        const finding found[HALVES] = {finding_of(&halves[0], &halves[1]), finding_of(&halves[1], &halves[0])};
        for (int i = 0; i < HALVES; i++)
            enough[i] = enough[i] || is_enough(s, least, &halves[1 - i], &found[1 - i], halves[i].taken);
        bool reached = enough[0] && enough[1];
        if (!reached && !last)
            continue;
        summarize(halves, found, answer);
        if (last || !is_torn(s, halves, answer))
            return reached;
        enough[0] = enough[1] = false;
    }
}

static void begin(half *h, uint64_t key, bool with_parts) {
    h->key = key;
    h->taken = 0;
    h->level = h->control_count = 0;
    h->rare = (path_rare){0, 0, 0, 0};
    h->integrated = false;
    h->luck = ESTIMATE_EXACT;
    h->with_parts = with_parts;
    h->cached = false;
    h->known_error = rgb_gray(0);
    h->parts = (estimate_parts){{0, 0, 0}, {0, 0, 0}};
}

/* The first half has begun; the second one does where it is needed. */
static void estimate_halves(half halves[HALVES], const graze_trace_settings *s, uint64_t stream, uint32_t least,
                            estimate_sample *sample, void *user, graze_answer *answer) {
    bool exact = take_one(&halves[0], sample, user) == ESTIMATE_EXACT;
    if (exact || s->samples == 1) {
        answer->value = not_negative(halves[0].sum[0]);
        rgb known = rgb_multiply(halves[0].known_error, halves[0].known_error);
        answer->standard_error = exact ? with_known_error(known, answer->value, halves[0].integrated) : rgb_gray(GRAZE_UNKNOWN_ERROR);
        answer->samples = 1;
        return;
    }
    begin(&halves[1], sampler_key(s->seed, stream, 1), halves[0].with_parts);
    if (s->samples) {
        take_until(&halves[0], s->samples - s->samples / HALVES, sample, user);
        take_until(&halves[1], s->samples / HALVES, sample, user);
        const finding found[HALVES] = {finding_of(&halves[0], &halves[1]), finding_of(&halves[1], &halves[0])};
        summarize(halves, found, answer);
    } else {
        answer->converged = refine(halves, s, least, sample, user, answer);
    }
}

/* Controls are direct light, and change none of the parts. */
static estimate_parts mean_parts(const half halves[HALVES]) {
    estimate_parts mean = {{0, 0, 0}, {0, 0, 0}};
    double share[HALVES];
    share_halves(halves, share);
    for (int i = 0; i < HALVES && halves[i].taken > 0; i++) {
        double weight = halves[1].taken > 0 ? share[i] / halves[i].taken : 1;
        mean.indirect = rgb_add_scaled(mean.indirect, weight, halves[i].parts.indirect);
        mean.albedo = rgb_add_scaled(mean.albedo, weight, halves[i].parts.albedo);
    }
    return mean;
}

void estimate_with_parts(const graze_trace_settings *s, uint64_t stream, uint32_t least, estimate_sample *sample,
                         void *user, graze_answer *answer, estimate_parts *parts) {
    half halves[HALVES];
    begin(&halves[0], sampler_key(s->seed, stream, 0), parts != NULL);
    halves[1].taken = 0;
    *answer = (graze_answer){.converged = 1};
    estimate_halves(halves, s, stream, least, sample, user, answer);
    if (parts)
        *parts = mean_parts(halves);
}

void estimate(const graze_trace_settings *s, uint64_t stream, estimate_sample *sample, void *user,
              graze_answer *answer) {
    estimate_with_parts(s, stream, 0, sample, user, answer, NULL);
}
