/* Surveys: from errors of a few pixels to numbers of samples. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "picture/survey.h"

enum { WIDTH = 640, HEIGHT = 300, NOISY_COLUMN = 320 };

/* Right of a column, errors are 10 times what is wanted of 1; left of it, nothing is noisy. */
static graze_answer half_noisy(void *user, const graze_trace_settings *settings, int column, int row) {
    (void)user;
    assert_true(settings->samples > 1 && column >= 0 && column < WIDTH && row >= 0 && row < HEIGHT);
    double error = column >= NOISY_COLUMN ? 10 * settings->error : 0;
    return (graze_answer){.value = {1, 1, 1}, .standard_error = {error, error, error}, .samples = settings->samples};
}

static graze_answer zero(void *user, const graze_trace_settings *settings, int column, int row) {
    (void)user, (void)settings, (void)column, (void)row;
    return (graze_answer){.samples = 8};
}

static picture_survey survey(survey_ask *ask, double floor, int threads) {
    graze_trace_settings settings = graze_trace_defaults();
    settings.error = 0.05;
    settings.floor = floor;
    picture_survey s;
    assert_int_equal(survey_make(&s, WIDTH, HEIGHT, &settings, threads, ask, NULL, NULL), GRAZE_OK);
    return s;
}

static void noise_asks_for_samples_where_it_is(void **state) {
    (void)state;
    picture_survey s = survey(half_noisy, 0, 2);
    uint32_t noisy = survey_least(&s, WIDTH - 1, HEIGHT - 1);
    /* Samples for a tenth of the error: 100 times as many if they were independent. */
    assert_in_range(noisy, 8 * 10, 8 * 100 * 4);
    assert_int_equal(survey_least(&s, NOISY_COLUMN + 100, 0), noisy);
    assert_int_equal(survey_least(&s, NOISY_COLUMN - 100, HEIGHT / 2), 0);
    /* Neighbours of noisy pixels are taken for noisy. */
    assert_in_range(survey_least(&s, NOISY_COLUMN - 5, HEIGHT / 2), noisy / 4, noisy - 1);
    survey_free(&s);
    assert_int_equal(survey_least(&s, WIDTH - 1, 0), 0);
}

static void a_floor_asks_for_less(void **state) {
    (void)state;
    picture_survey without = survey(half_noisy, 0, 1), with = survey(half_noisy, 4, 1);
    assert_in_range(survey_least(&with, WIDTH - 1, 9), 1, survey_least(&without, WIDTH - 1, 9) / 4);
    survey_free(&without);
    survey_free(&with);
}

static void darkness_asks_for_nothing(void **state) {
    (void)state;
    picture_survey s = survey(zero, 0, 1);
    for (int column = 0; column < WIDTH; column += 7)
        assert_int_equal(survey_least(&s, column, column % HEIGHT), 0);
    survey_free(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(noise_asks_for_samples_where_it_is),
        cmocka_unit_test(a_floor_asks_for_less),
        cmocka_unit_test(darkness_asks_for_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
