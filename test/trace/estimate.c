/* Means, their standard errors, and when estimates stop. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/vector.h"
#include "support/close.h"
#include "trace/estimate.h"

static int calls;

/* exp(x + y) has the mean (e - 1)^2 over the unit square. */
static const double smooth_mean = 2.9524924420125602;
static void smooth(void *user, sampler *points, path_sample *sample, estimate_luck *luck) {
    (void)user;
    double u[2];
    sampler_2d(points, u);
    *luck = ESTIMATE_NOISY;
    calls++;
    *sample = (path_sample){.radiance = rgb_gray(exp(u[0] + u[1]))};
}

/* A quarter disk: 1 inside, 0 outside. */
static void disk(void *user, sampler *points, path_sample *sample, estimate_luck *luck) {
    (void)user;
    double u[2];
    sampler_2d(points, u);
    *luck = ESTIMATE_NOISY;
    *sample = (path_sample){.radiance = rgb_gray(u[0] * u[0] + u[1] * u[1] < 1)};
}

static void constant(void *user, sampler *points, path_sample *sample, estimate_luck *luck) {
    (void)points;
    *luck = ESTIMATE_EXACT;
    calls++;
    *sample = (path_sample){.radiance = *(rgb *)user};
}

static graze_trace_settings fixed(uint32_t samples) {
    graze_trace_settings s = graze_trace_defaults();
    s.samples = samples;
    return s;
}

static void takes_exactly_the_samples_asked_for(void **state) {
    (void)state;
    for (uint32_t n = 2; n < 2000; n = n + n / 4 + 3) {
        graze_trace_settings s = fixed(n);
        graze_answer answer;
        calls = 0;
        estimate(&s, 1, smooth, NULL, &answer);
        assert_int_equal(calls, n);
        assert_int_equal(answer.samples, n);
        assert_true(answer.standard_error.r > 0);
    }
}

static void an_exact_answer_takes_one_sample(void **state) {
    (void)state;
    rgb value = {1, 2, 3};
    graze_trace_settings s = graze_trace_defaults();
    graze_answer answer;
    calls = 0;
    estimate(&s, 1, constant, &value, &answer);
    assert_int_equal(calls, 1);
    assert_close(answer.value.b, 3, 0);
    assert_close(answer.standard_error.b, 0, 0);
}

/* A sum of a sequence's points' independent coins: no better than independent samples. */
static void coin(void *user, sampler *points, path_sample *sample, estimate_luck *luck) {
    (void)user;
    double coins = 0;
    for (int i = 0; i < 8; i++)
        coins += (uint64_t)(sampler_1d(points) * 0x1p53) & 1;
    *luck = ESTIMATE_NOISY;
    *sample = (path_sample){.radiance = rgb_gray(coins)};
}

typedef struct coverage {
    double covered, made, claimed; /* a share; root mean squares */
} coverage;

static coverage cover(estimate_sample *sample, double truth, uint32_t samples) {
    enum { COUNT = 4000 };
    coverage c = {0};
    graze_trace_settings s = fixed(samples);
    for (int i = 0; i < COUNT; i++) {
        graze_answer answer;
        estimate(&s, (uint64_t)i, sample, NULL, &answer);
        double error = answer.value.r - truth;
        c.covered += (fabs(error) <= 1.96 * answer.standard_error.r) / (double)COUNT;
        c.made += error * error / COUNT;
        c.claimed += answer.standard_error.r * answer.standard_error.r / COUNT;
    }
    return (coverage){c.covered, sqrt(c.made), sqrt(c.claimed)};
}

static void assert_covered(estimate_sample *sample, double truth, uint32_t samples, double times) {
    coverage c = cover(sample, truth, samples);
    if (c.covered < 0.92 || c.claimed > times * c.made)
        fail_msg("%u samples: %.1f%% covered, error %g, claimed %g", samples, 100 * c.covered, c.made, c.claimed);
}

/* Whatever the number of samples, powers of 2 or not; with few the error is hardly known, and stated the larger. */
static void intervals_cover_the_truth(void **state) {
    (void)state;
    static const uint32_t counts[] = {16, 23, 50, 64, 100, 256, 300, 1000};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        assert_covered(coin, 4, counts[i], counts[i] < 50 ? 2 : 1.3);
        assert_covered(disk, acos(-1) / 4, counts[i], counts[i] < 50 ? 2.5 : 2);
        if (counts[i] < 300)
            assert_covered(smooth, smooth_mean, counts[i], 6);
    }
}

/* Two sequences, not many: what is smooth gets an error that falls faster than as 1/samples. */
static void long_sequences_are_used(void **state) {
    (void)state;
    assert_true(cover(smooth, smooth_mean, 256).made < cover(smooth, smooth_mean, 64).made / 5);
    assert_true(cover(disk, acos(-1) / 4, 256).made < cover(disk, acos(-1) / 4, 64).made / 2.5);
}

/* Of one sample that is not exact no error is known, and none is stated. */
static void one_sample_has_no_error(void **state) {
    (void)state;
    graze_trace_settings s = fixed(1);
    graze_answer answer;
    calls = 0;
    estimate(&s, 1, smooth, NULL, &answer);
    assert_int_equal(calls, 1);
    assert_int_equal(answer.samples, 1);
    assert_int_equal(answer.converged, 1);
    assert_close(answer.standard_error.g, GRAZE_UNKNOWN_ERROR, 0);
    estimate(&s, 1, constant, &(rgb){1, 2, 3}, &answer);
    assert_close(answer.standard_error.g, 0, 0);
}

/* A light half hidden, which is noise, beside other noise. The control, of mean 0, is what it would be if it were not
 * hidden; the share that the other half found takes away some of its noise and does not shift the mean. */
static void half_shadowed(void *user, sampler *points, path_sample *sample, estimate_luck *luck) {
    double u[2];
    sampler_2d(points, u);
    /* Low digits, which are as if independent. */
    bool lit = fmod(u[0] * 0x1p20, 1) < 0.5;
    double light = fmod(u[1] * 0x1p20, 1) < 0.1 ? 10 : 0;
    *luck = ESTIMATE_NOISY;
    *sample = (path_sample){.radiance = rgb_gray(lit ? light : 0)};
    if (*(bool *)user) {
        sample->controls[0] = (path_control){rgb_gray(1 - light), lit ? light : 0, light};
        sample->control_count = 1;
    }
}

static void controls_help_and_do_not_shift(void **state) {
    (void)state;
    enum { COUNT = 4000 };
    graze_trace_settings s = fixed(256);
    double sum[2] = {0}, squares[2] = {0}, claimed = 0;
    for (int i = 0; i < 2 * COUNT; i++) {
        graze_answer answer;
        bool controlled = i % 2;
        estimate(&s, (uint64_t)i, half_shadowed, &controlled, &answer);
        sum[controlled] += answer.value.g - 0.5;
        squares[controlled] += (answer.value.g - 0.5) * (answer.value.g - 0.5);
        claimed += controlled ? answer.standard_error.g * answer.standard_error.g : 0;
    }
    assert_true(squares[1] < 0.8 * squares[0]);
    assert_true(claimed > 0.8 * squares[1] && claimed < 2 * squares[1]);
    assert_true(fabs(sum[1]) < 3 * sqrt(squares[1]));
}

static void stops_at_the_error_asked_for(void **state) {
    (void)state;
    graze_trace_settings s = graze_trace_defaults();
    graze_answer loose, tight;
    s.error = 0.01;
    estimate(&s, 1, disk, NULL, &loose);
    s.error = 0.0005;
    estimate(&s, 1, disk, NULL, &tight);
    assert_true(loose.standard_error.r <= 0.01 * loose.value.r);
    assert_true(tight.standard_error.r <= 0.0005 * tight.value.r);
    assert_true(tight.samples > loose.samples);
    s.floor = 10;
    estimate(&s, 1, disk, NULL, &loose);
    assert_true(loose.samples < tight.samples);
    assert_true(loose.standard_error.r <= 0.0005 * 10);
}

/* Mostly a little, and few samples find what matters: the mean is 1. */
static void seldom(void *user, sampler *points, path_sample *sample, estimate_luck *luck) {
    double chance = *(double *)user, u[2], v[2];
    sampler_2d(points, u);
    sampler_2d(points, v);
    *luck = ESTIMATE_NOISY;
    /* Low digits, which are as if independent. */
    double found = fmod(u[0] * 0x1p20, 1) < chance ? 2 * 0.97 / chance * u[1] : 0;
    *sample = (path_sample){.radiance = rgb_gray(0.06 * v[0] + found)};
}

/* Above and below the floor alike: estimates are right on the average, as likely within their errors as they say, and
 * these are mostly what was asked for. */
static void what_is_below_the_floor_is_true(void **state) {
    (void)state;
    enum { COUNT = 1500 };
    struct {
        double chance, floor, largest; /* the error, as a part of what was asked for */
    } cases[] = {{0.1, 1, 1.2}, {0.1, 3, 1.2}, {0.1, 10, 1.2}, {0.1, 30, 1.2}, {0.01, 3, 2}};
    graze_trace_settings s = graze_trace_defaults();
    s.error = 0.05;
    for (size_t f = 0; f < sizeof cases / sizeof *cases; f++) {
        double sum = 0, squares = 0, covered = 0;
        s.floor = cases[f].floor;
        for (int i = 0; i < COUNT; i++) {
            graze_answer answer;
            estimate(&s, (uint64_t)i + COUNT * f, seldom, &cases[f].chance, &answer);
            double error = answer.value.r - 1;
            sum += error;
            squares += error * error;
            covered += (fabs(error) <= 1.96 * answer.standard_error.r) / (double)COUNT;
        }
        double scatter = sqrt(squares / COUNT), uncertain = scatter / sqrt(COUNT);
        if (fabs(sum / COUNT) > 3 * uncertain || covered < 0.9 || scatter > cases[f].largest * s.error * s.floor)
            fail_msg("floor %g: %g too large, +- %g, %.1f%% covered, error %g", s.floor, sum / COUNT, uncertain,
                     100 * covered, scatter);
    }
}

/* Zeros, as from a light that has not been found yet, or as from an empty pixel. */
static void zero(void *user, sampler *points, path_sample *sample, estimate_luck *luck) {
    double u[2];
    sampler_2d(points, u);
    *luck = *(estimate_luck *)user;
    *sample = (path_sample){.radiance = rgb_gray(0)};
}

static void zeros_need_many_samples_unless_certain(void **state) {
    (void)state;
    graze_trace_settings s = graze_trace_defaults();
    graze_answer certain, noisy, lucky;
    estimate(&s, 1, zero, &(estimate_luck){ESTIMATE_PLACE}, &certain);
    estimate(&s, 1, zero, &(estimate_luck){ESTIMATE_NOISY}, &noisy);
    s.strategy = GRAZE_STRATEGY_BRDF;
    estimate(&s, 1, zero, &(estimate_luck){ESTIMATE_SEARCH}, &lucky);
    assert_true(certain.samples < noisy.samples && noisy.samples < lucky.samples);
    assert_true(noisy.samples >= 512 && lucky.samples >= 65536);
}

/* A search takes many samples however small their scatter. */
static void search(void *user, sampler *points, path_sample *sample, estimate_luck *luck) {
    (void)user;
    *luck = ESTIMATE_SEARCH;
    *sample = (path_sample){.radiance = rgb_gray(1 + 1e-3 * sampler_1d(points))};
}

static void searches_need_many_samples(void **state) {
    (void)state;
    graze_trace_settings s = graze_trace_defaults();
    graze_answer answer;
    estimate(&s, 1, search, NULL, &answer);
    assert_true(answer.converged && answer.samples >= 512);
}

static void reports_the_limit(void **state) {
    (void)state;
    graze_trace_settings s = graze_trace_defaults();
    graze_answer answer;
    s.error = 1e-6;
    s.sample_limit = 100;
    estimate(&s, 1, disk, NULL, &answer);
    assert_int_equal(answer.samples, 100);
    assert_int_equal(answer.converged, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(takes_exactly_the_samples_asked_for),
        cmocka_unit_test(an_exact_answer_takes_one_sample),
        cmocka_unit_test(intervals_cover_the_truth),
        cmocka_unit_test(long_sequences_are_used),
        cmocka_unit_test(one_sample_has_no_error),
        cmocka_unit_test(controls_help_and_do_not_shift),
        cmocka_unit_test(stops_at_the_error_asked_for),
        cmocka_unit_test(what_is_below_the_floor_is_true),
        cmocka_unit_test(zeros_need_many_samples_unless_certain),
        cmocka_unit_test(searches_need_many_samples),
        cmocka_unit_test(reports_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
