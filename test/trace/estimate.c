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
static path_sample smooth(void *user, sampler *points, estimate_luck *luck) {
    (void)user;
    double u[2];
    sampler_2d(points, u);
    *luck = ESTIMATE_NOISY;
    calls++;
    return (path_sample){.radiance = rgb_gray(exp(u[0] + u[1]))};
}

/* A quarter disk: 1 inside, 0 outside. */
static path_sample disk(void *user, sampler *points, estimate_luck *luck) {
    (void)user;
    double u[2];
    sampler_2d(points, u);
    *luck = ESTIMATE_NOISY;
    return (path_sample){.radiance = rgb_gray(u[0] * u[0] + u[1] * u[1] < 1)};
}

static path_sample constant(void *user, sampler *points, estimate_luck *luck) {
    (void)points;
    *luck = ESTIMATE_EXACT;
    calls++;
    return (path_sample){.radiance = *(rgb *)user};
}

static graze_trace_settings fixed(uint32_t samples) {
    graze_trace_settings s = graze_trace_defaults();
    s.samples = samples;
    return s;
}

static void takes_exactly_the_samples_asked_for(void **state) {
    (void)state;
    for (uint32_t n = 2; n < 100; n += 7) {
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

/* Student's t for 15 degrees of freedom: 95% of the intervals must hold the truth, give or take the noise of 4000. */
static void check_coverage(estimate_sample *sample, double truth, uint32_t samples) {
    int covered = 0, count = 4000;
    graze_trace_settings s = fixed(samples);
    for (int i = 0; i < count; i++) {
        graze_answer answer;
        estimate(&s, (uint64_t)i, sample, NULL, &answer);
        covered += fabs(answer.value.r - truth) <= 2.131 * answer.standard_error.r;
    }
    double share = (double)covered / count;
    if (share < 0.935 || share > 0.965)
        fail_msg("%.1f%% covered with %u samples", 100 * share, samples);
}

static void intervals_cover_the_truth(void **state) {
    (void)state;
    for (uint32_t samples = 16; samples <= 256; samples *= 4) {
        check_coverage(smooth, smooth_mean, samples);
        check_coverage(disk, acos(-1) / 4, samples < 64 ? 64 : samples);
    }
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
    s.floor = 1000;
    estimate(&s, 1, disk, NULL, &tight);
    assert_true(tight.samples < loose.samples);
}

/* Zeros, as from a light that has not been found yet, or as from an empty pixel. */
static path_sample zero(void *user, sampler *points, estimate_luck *luck) {
    double u[2];
    sampler_2d(points, u);
    *luck = *(estimate_luck *)user;
    return (path_sample){.radiance = rgb_gray(0)};
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
static path_sample search(void *user, sampler *points, estimate_luck *luck) {
    (void)user;
    *luck = ESTIMATE_SEARCH;
    return (path_sample){.radiance = rgb_gray(1 + 1e-3 * sampler_1d(points))};
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
        cmocka_unit_test(stops_at_the_error_asked_for),
        cmocka_unit_test(zeros_need_many_samples_unless_certain),
        cmocka_unit_test(searches_need_many_samples),
        cmocka_unit_test(reports_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
