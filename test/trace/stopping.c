/* When estimates stop, and what they state that no sample shows, to the last sample and digit: of samples that are all
 * alike, or differ in a way that is known. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/close.h"
#include "trace/estimate_error.h"
#include "trace/unmet_light.h"

/* What the samples are. In adaptive estimates the first half takes four, then the second one; else the first one takes
 * all of its. */
typedef struct script {
    path_sample sample;
    const path_sample *second; /* those after the first so many, if not null */
    int first;
    estimate_luck luck[2]; /* of the first four samples, and the next four: others do not change that of their half */
    double torn;           /* added to the second four samples, */
    double after;          /* and to all later ones */
    int calls;
} script;

static void play(void *user, sampler *points, path_sample *sample, estimate_luck *luck) {
    script *s = user;
    (void)points;
    *sample = s->second && s->calls >= s->first ? *s->second : s->sample;
    *luck = s->calls < 8 ? s->luck[s->calls >= 4] : ESTIMATE_PLACE;
    double more = s->calls >= 8 ? s->after : s->calls >= 4 ? s->torn : 0;
    sample->radiance = rgb_add(sample->radiance, rgb_gray(more));
    s->calls++;
}

static script all_alike(double value, estimate_luck luck) {
    return (script){.sample = {.radiance = rgb_gray(value)}, .luck = {luck, luck}};
}

static graze_trace_settings within(double error, double floor) {
    graze_trace_settings s = graze_trace_defaults();
    s.error = error;
    s.floor = floor;
    s.ambient_bounces = 0;
    return s;
}

static graze_trace_settings fixed(uint32_t samples) {
    graze_trace_settings s = within(0.05, 0);
    s.samples = samples;
    return s;
}

static graze_answer answer_of(graze_trace_settings s, script of) {
    graze_answer answer;
    estimate(&s, 1, play, &of, &answer);
    assert_int_equal(answer.samples, of.calls);
    return answer;
}

/* The error of so many samples that are all alike. */
static double stated(uint32_t samples, script of) {
    return answer_of(fixed(samples), of).standard_error.g;
}

/* The same if the second half's samples have nothing but the same radiance, or the first half's. */
static double stated_of_half(int half, uint32_t samples, script of) {
    const path_sample bare = {.radiance = of.sample.radiance}, whole = of.sample;
    of.first = (int)(samples - samples / 2);
    of.second = half ? &whole : &bare;
    of.sample = half ? bare : whole;
    return stated(samples, of);
}

static void samples_are_believed(void **state) {
    (void)state;
    const struct {
        double value, error, floor;
        estimate_luck luck;
        graze_strategy strategy;
        uint32_t samples;
    } cases[] = {
        {1, 0.05, 0, ESTIMATE_PLACE, GRAZE_STRATEGY_MIS, 8},
        {0, 0.05, 0, ESTIMATE_PLACE, GRAZE_STRATEGY_MIS, 8},
        /* 3/n of few, 1/n of many, the rest 32 */
        {1, 0.2, 0, ESTIMATE_NOISY, GRAZE_STRATEGY_MIS, 16},
        {1, 0.05, 0, ESTIMATE_NOISY, GRAZE_STRATEGY_MIS, 32},
        {1, 0.01, 0, ESTIMATE_NOISY, GRAZE_STRATEGY_MIS, 128},
        {1, 0.05, 0, ESTIMATE_SEARCH, GRAZE_STRATEGY_MIS, 512},
        {1, 0.0005, 0, ESTIMATE_SEARCH, GRAZE_STRATEGY_MIS, 2048},
        /* at the floor as above it; below, the more */
        {1, 0.05, 1, ESTIMATE_NOISY, GRAZE_STRATEGY_MIS, 32},
        {1, 0.05, 2, ESTIMATE_NOISY, GRAZE_STRATEGY_MIS, 128},
        {1, 0.05, 100, ESTIMATE_NOISY, GRAZE_STRATEGY_MIS, 512},
        /* zeros */
        {0, 0.05, 0, ESTIMATE_NOISY, GRAZE_STRATEGY_MIS, 512},
        {0, 0.05, 0, ESTIMATE_SEARCH, GRAZE_STRATEGY_MIS, 512},
        {0, 0.05, 0, ESTIMATE_NOISY, GRAZE_STRATEGY_BRDF, 512},
        {0, 0.05, 0, ESTIMATE_SEARCH, GRAZE_STRATEGY_BRDF, 65536},
        {0, 0.05, 1e-3, ESTIMATE_SEARCH, GRAZE_STRATEGY_BRDF, 512},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        graze_trace_settings s = within(cases[i].error, cases[i].floor);
        s.strategy = cases[i].strategy;
        graze_answer answer = answer_of(s, all_alike(cases[i].value, cases[i].luck));
        if (answer.samples != cases[i].samples || !answer.converged)
            fail_msg("case %d: %u samples", (int)i, answer.samples);
    }
}

/* As others have told, and not beyond the limit. */
static void least_and_most(void **state) {
    (void)state;
    graze_trace_settings s = within(0.05, 0);
    script flat = all_alike(1, ESTIMATE_PLACE);
    graze_answer answer;
    estimate_with_extras(&s, 1, &(estimate_extras){.least = 100}, play, &flat, &answer);
    assert_int_equal(answer.samples, 128);
    s.sample_limit = 20;
    answer = answer_of(s, all_alike(1, ESTIMATE_NOISY));
    assert_int_equal(answer.samples, 20);
    assert_int_equal(answer.converged, 0);
    s.sample_limit = 32;
    assert_int_equal(answer_of(s, all_alike(1, ESTIMATE_NOISY)).converged, 1);
}

/* The mean of both halves has half of one's variance: the error stated is then about what was asked for. */
static void coin(void *user, sampler *points, path_sample *sample, estimate_luck *luck) {
    (void)user;
    double coins = 0;
    for (int i = 0; i < 8; i++)
        coins += (uint64_t)(sampler_1d(points) * 0x1p53) & 1;
    *luck = ESTIMATE_NOISY;
    *sample = (path_sample){.radiance = rgb_gray(coins)};
}

static void not_much_better_than_asked_for(void **state) {
    (void)state;
    enum { COUNT = 400 };
    graze_trace_settings s = within(0.01, 0);
    double sum = 0;
    for (uint64_t stream = 0; stream < COUNT; stream++) {
        graze_answer answer;
        estimate(&s, stream, coin, NULL, &answer);
        sum += answer.standard_error.g / (0.01 * answer.value.g) / COUNT;
    }
    assert_true(sum > 0.6 && sum < 1);
}

/* What a half expects of gloss and has not found: 1 a sample, with a variance of 1; 1.5/n (1 + 1/n) of n samples, of
 * twice as many in both halves. */
static script with_gloss(double found, bool by_mirrors) {
    script s = all_alike(1, ESTIMATE_NOISY);
    s.sample.rare = (path_rare){.expected = 1, .squares = 1, .found = found, .times = 1, .by_mirrors = by_mirrors};
    return s;
}

static void unseen_gloss_is_waited_for(void **state) {
    (void)state;
    assert_int_equal(answer_of(within(0.05, 0), with_gloss(0, false)).samples, 64);
    assert_int_equal(answer_of(within(0.048, 0), with_gloss(0, false)).samples, 128);
    assert_int_equal(answer_of(within(0.001, 0), with_gloss(0, false)).samples, 4096);
    assert_int_equal(answer_of(within(0.001, 0), with_gloss(0.25, false)).samples, 1024);
    /* in mirrors no longer than for what is searched */
    assert_int_equal(answer_of(within(0.003, 0), with_gloss(0, true)).samples, 512);
    assert_int_equal(answer_of(within(0.05, 0), with_gloss(0, true)).samples, 64);
    script noisy = with_gloss(0, false);
    assert_close(stated(64, noisy), 3.0 / 64 * (1 + 1.0 / 64), 1e-9);
    assert_close(stated(2, noisy), 1.5, 1e-9); /* not more than all of it */
    noisy.sample.rare.squares = 0;
    assert_close(stated(64, noisy), 0, 0);
    assert_close(stated(64, with_gloss(0.125, false)), 1.5 / 64 * (1 + 1.0 / 64), 1e-9);
    assert_close(stated(64, with_gloss(0.25, false)), 0, 0);
    assert_close(stated(64, with_gloss(0.5, false)), 0, 0);
    noisy.sample.rare.squares = 0.001;
    assert_close(stated(64, noisy), 3.0 / 64000 * (1 + 1.0 / 64), 1e-9);
    noisy.sample.rare.squares = 1;
    assert_close(stated(5, noisy), 0.6 * 1.2, 1e-9);
    /* in one half: half as much, of half as many peaks */
    for (int half = 0; half < 2; half++)
        assert_close(stated_of_half(half, 64, noisy), 0.5 * 3 / 32 * (1 + 1.0 / 32), 1e-9);
}

/* The first four samples of one half see an edge that those of the other do not. What both state is compared with what
 * was asked for, and there is more of that at a floor. */
static void torn_places(void **state) {
    (void)state;
    script s = all_alike(1, ESTIMATE_PLACE);
    s.torn = 1;
    double one = answer_of(within(100, 0), s).standard_error.g;
    const double steps[] = {0.03, 0.02};
    for (int far = 0; far < 2; far++) {
        double error = steps[far];
        for (int more = 0; more < 2; more++) {
            double limit = 1.5 * error * (more ? 1.05 : 0.95);
            s.torn = limit / (one - limit / 2); /* so that what is stated is the limit's part of 1 + torn/2 */
            s.after = s.torn / 2;
            assert_int_equal(answer_of(within(error, 0), s).samples > 8, more);
        }
        assert_int_equal(answer_of(within(error, 2), s).samples, 8);
        assert_true(answer_of(within(error / 2, 2), s).samples > 8);
    }
    /* What noise tears is not gone on with. */
    s.torn = s.after = 10;
    for (int noisy = 0; noisy < 2; noisy++) {
        s.luck[noisy] = ESTIMATE_NOISY;
        s.luck[1 - noisy] = ESTIMATE_PLACE;
        graze_answer answer = answer_of(within(0.05, 0), s);
        assert_int_equal(answer.samples, 4 + 16);
        assert_true(answer.standard_error.g > 1.5 * 0.05 * answer.value.g);
    }
}

/* An edge that the few samples of a place may have missed is asked for once they would be believed. */
typedef struct edge {
    script script; /* comes first, for the samples */
    bool there;
    int asked;
    uint32_t samples;
    double allowed;
} edge;

static bool tell_edge(void *user, uint32_t samples, double allowed) {
    edge *e = user;
    e->asked++;
    e->samples = samples;
    e->allowed = allowed;
    return e->there;
}

static uint32_t samples_at(graze_trace_settings s, edge *e) {
    graze_answer answer;
    estimate_with_extras(&s, 1, &(estimate_extras){.has_edge = tell_edge}, play, e, &answer);
    return answer.samples;
}

static void edges_are_asked_for(void **state) {
    (void)state;
    edge none = {.script = all_alike(2, ESTIMATE_PLACE)},
         there = {.script = all_alike(2, ESTIMATE_PLACE), .there = true};
    assert_int_equal(samples_at(within(0.05, 1), &none), 8);
    assert_int_equal(none.asked, 1);
    assert_int_equal(none.samples, 8);
    assert_close(none.allowed, 0.1, 1e-15);
    assert_int_equal(samples_at(within(0.05, 3), &there), 128);
    assert_int_equal(there.asked, 1);
    assert_close(there.allowed, 0.15, 1e-15);
    for (int noisy = 0; noisy < 2; noisy++) {
        edge e = {.script = all_alike(2, ESTIMATE_PLACE), .there = true};
        e.script.luck[noisy] = ESTIMATE_NOISY;
        (void)samples_at(within(0.2, 0), &e);
        assert_int_equal(e.asked, 0);
    }
}

/* Of one sample, and of one that all others would be like, as many as are asked for. */
static void exact_answers(void **state) {
    (void)state;
    script s = all_alike(2, ESTIMATE_EXACT);
    s.sample.radiance.b = -1;
    s.sample.indirect = (rgb){1, 2, 3};
    s.sample.albedo = (rgb){4, 5, 6};
    for (int integrated = 0; integrated < 2; integrated++)
        for (uint32_t samples = 0; samples < 3; samples++) {
            graze_trace_settings settings = fixed(samples);
            estimate_parts parts;
            graze_answer answer;
            s.calls = 0;
            s.sample.integrated = integrated;
            s.sample.known_error = rgb_gray(integrated ? 0 : 0.25);
            estimate_with_extras(&settings, 1, &(estimate_extras){.parts = &parts}, play, &s, &answer);
            assert_int_equal(s.calls, 1);
            assert_int_equal(answer.samples, 1);
            assert_int_equal(answer.converged, 1);
            assert_close(answer.value.g, 2, 0);
            assert_close(answer.value.b, 0, 0);
            assert_close(answer.standard_error.g, integrated ? 2e-8 : 0.25, 1e-11);
            assert_close(parts.indirect.g, 2, 0);
            assert_close(parts.albedo.b, 6, 0);
        }
    s.calls = 0;
    s.luck[0] = ESTIMATE_NOISY;
    assert_close(stated(1, s), GRAZE_UNKNOWN_ERROR, 0);
}

/* A half's evidence is all differences of neighbours, neighbours of neighbours, and so on. */
static void neighbours_are_compared(void **state) {
    (void)state;
    static const int freedoms[] = {0, 0, 1, 1, 3, 3, 4, 4, 7};
    for (uint32_t taken = 1; taken < 9; taken++) {
        estimate_half h = {.taken = taken}, other = {.taken = 1};
        for (int i = 0; i < 8; i++)
            h.sum[i] = rgb_gray(i < 4 ? 1 : 3);
        estimate_finding found = estimate_finding_of(&h, &other);
        assert_close(found.evidence.freedom, freedoms[taken], 0);
        assert_close(found.mean.g, taken <= 4 ? 1 : (4 + 3.0 * (taken - 4)) / taken, 1e-12);
        /* Only the two halves of eight differ, by 2. */
        assert_close(found.evidence.slow.g, taken == 8 ? 1 / laws_of_difference(2).slow : 0, 1e-12);
        assert_close(found.evidence.fast.g, taken == 8 ? 1 / laws_of_difference(2).fast : 0, 1e-12);
    }
}

/* Halves count by their samples where these were decided to be as many, or one more; else alike. */
static void halves_are_shared(void **state) {
    (void)state;
    const struct {
        uint32_t taken[2];
        double first;
    } cases[] = {{{1, 1}, 0.5}, {{2, 1}, 2 / 3.0}, {{3, 2}, 0.6}, {{3, 1}, 0.5},
                 {{1, 2}, 0.5}, {{8, 2}, 0.5},     {{1, 0}, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        estimate_half halves[2];
        double share[2];
        halves[0].taken = cases[i].taken[0];
        halves[1].taken = cases[i].taken[1];
        estimate_share_halves(halves, share);
        assert_close(share[0], cases[i].first, 1e-15);
        assert_close(share[1], 1 - cases[i].first, 1e-15);
    }
}

/* Whatever the number of samples in each half. */
static void parts_are_means(void **state) {
    (void)state;
    for (uint32_t samples = 0; samples < 12; samples++) {
        script s = all_alike(1, ESTIMATE_NOISY);
        graze_trace_settings settings = fixed(samples);
        estimate_parts parts;
        graze_answer answer;
        s.sample.indirect = (rgb){1, 2, 3};
        s.sample.albedo = (rgb){4, 5, 6};
        estimate_with_extras(&settings, 1, &(estimate_extras){.parts = &parts}, play, &s, &answer);
        const double found[] = {parts.indirect.r, parts.indirect.g, parts.indirect.b,
                                parts.albedo.r,   parts.albedo.g,   parts.albedo.b};
        for (int i = 0; i < 6; i++)
            assert_close(found[i], i + 1, 1e-15);
        assert_int_equal(answer.converged, 1);
    }
}

/* A light of which samples find this much, with and without shadows. */
static script watched(double value, double lit, double whole) {
    script s = all_alike(value, ESTIMATE_NOISY);
    s.sample.controls[0] = (path_control){{0, 0, 0}, lit, whole};
    s.sample.control_count = 1;
    return s;
}

static void unseen_shadows(void **state) {
    (void)state;
    assert_close(stated(64, watched(1, 2, 2)), 2.0 / 64, 1e-9);
    assert_close(stated(64, watched(1, 0, 2)), 2.0 / 64, 1e-9);
    assert_close(stated(64, watched(1, -1, 2)), 2.0 / 64, 1e-9);
    assert_close(stated(64, watched(1, 1.99, 2)), 0, 0);
    assert_close(stated(4, watched(1, 0, 20)), 1, 1e-9); /* not more than the value; */
    assert_close(stated(4, watched(0, 0, 20)), 5, 1e-9); /* all of it where that is 0, */
    assert_close(stated(510, watched(0, 0, 20)), 20.0 / 510, 1e-9);
    assert_close(stated(512, watched(0, 0, 20)), 0, 0); /* and zeros are believed */
    assert_true(stated(512, watched(1, 0, 20)) > 0);
    /* Nothing of it shines where samples were: all that was added may be in shadow. */
    script set = watched(1, 0, 0);
    set.sample.controls[0].difference = rgb_gray(0.5);
    assert_close(stated(64, set), 0.5, 1e-9);
    set.sample.controls[0].difference = rgb_gray(-0.5);
    assert_close(stated(64, set), 0, 0);
    /* Little of it, and little of it lit. */
    assert_close(stated(64, watched(1, 0.01, 0.01)), 0.01 / 64, 1e-9);
    assert_close(stated(64, watched(1, 0.005, 2)), 0, 0);
    /* Two lights. */
    script two = watched(1, 2, 2);
    two.sample.controls[1] = (path_control){{0, 0, 0}, 0, 3};
    two.sample.control_count = 2;
    assert_close(stated(64, two), 5.0 / 64, 1e-9);
    two.sample.controls[1] = (path_control){rgb_gray(0.5), 0, 0};
    assert_close(stated(64, two), 2.0 / 64 + 0.5, 1e-9);
    /* Only one half knows of it: both have the mean 1. */
    const path_sample bare = {.radiance = rgb_gray(1)};
    set.sample.controls[0].difference = rgb_gray(0.5);
    set.sample.radiance = rgb_gray(0.5);
    const path_sample whole = set.sample;
    for (int half = 0; half < 2; half++) {
        assert_close(stated_of_half(half, 64, watched(1, 0, 2)), 1.0 / 64, 1e-9);
        set.first = 32;
        set.sample = half ? bare : whole;
        set.second = half ? &whole : &bare;
        assert_close(stated(64, set), 0.25, 1e-9);
    }
}

/* As much of a control is added as of its light is not in shadow, as the other half finds. */
static void controls_are_added(void **state) {
    (void)state;
    const struct {
        double lit, whole, share;
    } cases[] = {{1, 4, 0.25}, {4, 4, 1}, {5, 4, 1}, {0, 4, 0}, {-1, 4, 0}, {0, 0, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        script s = watched(10, cases[i].lit, cases[i].whole);
        s.sample.controls[0].difference = (rgb){1, 2, -3};
        graze_answer answer = answer_of(fixed(37), s);
        assert_close(answer.value.r, 10 + cases[i].share, 1e-12);
        assert_close(answer.value.g, 10 + 2 * cases[i].share, 1e-12);
        assert_close(answer.value.b, 10 - 3 * cases[i].share, 1e-12);
    }
}

/* Each half by what the other one finds, however many samples there are. */
static void controls_are_decided_by_the_other_half(void **state) {
    (void)state;
    for (int adaptive = 0; adaptive < 2; adaptive++) {
        script s = watched(10, 1, 4);
        s.sample.controls[0].difference = rgb_gray(1);
        path_sample second = s.sample;
        second.controls[0] = (path_control){rgb_gray(-4), 3, 4};
        s.second = &second;
        s.first = 4;
        s.luck[0] = s.luck[1] = ESTIMATE_PLACE;
        graze_answer answer = answer_of(adaptive ? within(0.5, 0) : fixed(8), s);
        assert_int_equal(answer.samples, 8);
        assert_close(answer.value.g, (10 + 0.75 * 1 + 10 - 0.25 * 4) / 2, 1e-12);
    }
}

/* Errors of what was known beforehand do not average out; what the cache's parts say scatters as they do. */
static void known_errors(void **state) {
    (void)state;
    script s = all_alike(1, ESTIMATE_NOISY);
    s.sample.known_error = rgb_gray(0.125);
    assert_close(stated(2, s), 0.125, 1e-9);
    assert_close(stated(37, s), 0.125, 1e-9);
    s.sample.known_error = rgb_gray(0);
    s.sample.cached = true;
    for (int k = 0; k < IRRADIANCE_PARTS; k++)
        s.sample.told[k] = rgb_gray(k % 2 ? 1.5 : 0.5);
    double freedom = IRRADIANCE_PARTS - 1;
    double variance = 0.25 / freedom * evidence_widening(freedom);
    assert_close(stated(2, s), sqrt(variance), 1e-9);
    graze_answer answer = answer_of(fixed(37), s);
    assert_close(answer.standard_error.r, sqrt(variance), 1e-9);
    assert_close(answer.standard_error.g, sqrt(variance), 1e-9);
    assert_close(answer.standard_error.b, sqrt(variance), 1e-9);
    for (int half = 0; half < 2; half++)
        assert_close(stated_of_half(half, 64, s), sqrt(variance) / 2, 1e-9);
    s.sample.cached = false;
    s.sample.integrated = true;
    assert_close(stated(37, s), 1e-8, 1e-12);
    for (int half = 0; half < 2; half++)
        assert_close(stated_of_half(half, 64, s), 1e-8, 1e-12);
    /* Beside any of it, that of adding numbers. */
    script large = all_alike(1e6, ESTIMATE_NOISY);
    large.sample.known_error = rgb_gray(1e-9);
    assert_close(stated(64, large), 1e-6, 1e-11);
}

/* Where diffuse reflections have made no difference, one of all may yet make as much as the value. */
static void level_answers(void **state) {
    (void)state;
    graze_trace_settings s = fixed(64);
    s.ambient_bounces = 1;
    assert_close(answer_of(s, all_alike(2, ESTIMATE_NOISY)).standard_error.g, 2.0 / 64, 1e-9);
    assert_close(answer_of(s, all_alike(2, ESTIMATE_PLACE)).standard_error.g, 0, 0);
    assert_close(answer_of(s, all_alike(0, ESTIMATE_NOISY)).standard_error.g, 0, 0);
    script nearly = all_alike(2, ESTIMATE_NOISY);
    nearly.torn = 1e-11;
    assert_close(answer_of(s, nearly).standard_error.g, 2.0 / 64, 1e-9);
    nearly.sample.radiance = rgb_gray(2000);
    nearly.torn = 1e-8;
    assert_close(answer_of(s, nearly).standard_error.g, 2000.0 / 64, 1e-6);
    nearly.sample.radiance = rgb_gray(2);
    assert_close(answer_of(s, all_alike(0.5, ESTIMATE_NOISY)).standard_error.g, 0.5 / 64, 1e-9);
    nearly.torn = 1e-6;
    assert_close(answer_of(s, nearly).standard_error.g, 0, 1e-6);
    s.ambient_bounces = 0;
    assert_close(answer_of(s, all_alike(2, ESTIMATE_NOISY)).standard_error.g, 0, 0);
}

/* Of what lights might give behind panes, all that was not met may be missing, once in as many samples as there are. */
static void unmet_light(void **state) {
    (void)state;
    path_unmet unmet = {.count = 3, .at = {{.expected = 2}, {.expected = 5, .met = true}, {.expected = 4}}};
    script s = all_alike(1, ESTIMATE_NOISY);
    s.sample.unmet = &unmet;
    assert_close(stated(64, s), 6.0 / 64, 1e-9);
    assert_close(stated(4, s), 1, 1e-9);
    s.sample.radiance = rgb_gray(0);
    assert_close(stated(4, s), 1.5, 1e-9);
    unmet.count = 1;
    assert_close(stated(5, s), 0.4, 1e-9);
    unmet.count = 0;
    assert_close(stated(4, s), 0, 0);
}

/* What is stated has the value's colour. */
static void errors_have_the_color(void **state) {
    (void)state;
    script s = watched(0, 2, 2);
    s.sample.radiance = (rgb){0.5, 0.25, 0};
    graze_answer answer = answer_of(fixed(64), s);
    double brightness = rgb_brightness(s.sample.radiance);
    assert_close(answer.standard_error.r, 2.0 / 64 / brightness / 2, 1e-9);
    assert_close(answer.standard_error.g, 2.0 / 64 / brightness / 4, 1e-9);
    assert_close(answer.standard_error.b, 0, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_believed),
        cmocka_unit_test(least_and_most),
        cmocka_unit_test(not_much_better_than_asked_for),
        cmocka_unit_test(unseen_gloss_is_waited_for),
        cmocka_unit_test(torn_places),
        cmocka_unit_test(edges_are_asked_for),
        cmocka_unit_test(exact_answers),
        cmocka_unit_test(halves_are_shared),
        cmocka_unit_test(neighbours_are_compared),
        cmocka_unit_test(parts_are_means),
        cmocka_unit_test(unseen_shadows),
        cmocka_unit_test(controls_are_added),
        cmocka_unit_test(known_errors),
        cmocka_unit_test(controls_are_decided_by_the_other_half),
        cmocka_unit_test(level_answers),
        cmocka_unit_test(unmet_light),
        cmocka_unit_test(errors_have_the_color),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
