/* Scales: where values lie on them, and how their numbers read. */
#include "image/support.h"

#include <math.h>

#include "image/value_scale.h"
#include "support/close.h"

static void values_have_their_places(void **state) {
    (void)state;
    image_value_scale linear = {0, 500, 0, 8}, around = {-2, 2, 0, 8}, logarithmic = {0, 1000, 3, 6};
    assert_close(image_scale_position(&linear, 125), 0.25, 0);
    assert_close(image_scale_position(&linear, 1000), 2, 0);
    assert_close(image_scale_position(&around, 0), 0.5, 0);
    assert_close(image_scale_position(&around, -1), 0.25, 0);
    assert_close(image_scale_position(&logarithmic, 1000), 1, 0);
    assert_close(image_scale_position(&logarithmic, 10), 1 / 3., 1e-15);
    /* No logarithm, no place. */
    assert_close(image_scale_position(&logarithmic, 0), -1, 0);
    assert_close(image_scale_position(&logarithmic, -5), -1, 0);
}

static void divisions_invert_places(void **state) {
    (void)state;
    image_value_scale scales[] = {{0, 500, 0, 7}, {-2, 2, 0, 5}, {0, 1e-3, 2.5, 9}};
    for (int s = 0; s < 3; s++)
        for (int i = 0; i <= scales[s].divisions; i++)
            assert_close(image_scale_position(&scales[s], image_scale_value(&scales[s], i)),
                         (double)i / scales[s].divisions, 1e-14);
}

static void steps_are_round(void **state) {
    (void)state;
    static const struct {
        double value;
        int divisions;
        double rounded;
    } cases[] = {{937.4, 8, 1000}, {1000, 8, 1000}, {1001, 8, 1200}, {17900, 8, 20000}, {1, 1, 1},  {7, 1, 8},
                 {8.5, 1, 10},     {3e-7, 3, 3e-7}, {0.11, 4, 0.12}, {0, 8, 0},         {-1, 8, 0}, {NAN, 8, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_close(image_scale_round_up(cases[i].value, cases[i].divisions), cases[i].rounded,
                     1e-12 * cases[i].rounded);
    /* Never below, and never wasting more than a third. */
    for (double value = 1e-6; value < 1e9; value *= 1.37)
        for (int n = 1; n < 20; n++) {
            double rounded = image_scale_round_up(value, n);
            assert_true(rounded >= value * (1 - 1e-8) && rounded < 1.34 * value);
        }
}

static void expect_texts(image_value_scale scale, int decimals, const char *const *texts) {
    for (int i = 0; i <= scale.divisions; i++) {
        char text[IMAGE_SCALE_TEXT];
        image_scale_text(&scale, i, decimals, text);
        if (strcmp(text, texts[i]) != 0)
            fail_msg("division %d reads '%s', not '%s'", i, text, texts[i]);
    }
}

static void numbers_read_well(void **state) {
    (void)state;
    expect_texts((image_value_scale){0, 1000, 0, 4}, -1, (const char *[]){"0", "250", "500", "750", "1000"});
    /* As many decimals as the step has, in all. */
    expect_texts((image_value_scale){0, 250, 0, 4}, -1, (const char *[]){"0.0", "62.5", "125.0", "187.5", "250.0"});
    expect_texts((image_value_scale){0, 1, 0, 3}, -1, (const char *[]){"0.000", "0.333", "0.667", "1.000"});
    expect_texts((image_value_scale){0, 1000, 0, 3}, -1, (const char *[]){"0", "333", "667", "1000"});
    expect_texts((image_value_scale){0, 1, 0, 3}, 1, (const char *[]){"0.0", "0.3", "0.7", "1.0"});
    expect_texts((image_value_scale){-1, 1, 0, 4}, -1, (const char *[]){"-1.0", "-0.5", "0.0", "+0.5", "+1.0"});
    expect_texts((image_value_scale){-.3, .3, 0, 3}, -1, (const char *[]){"-0.3", "-0.1", "+0.1", "+0.3"});
    expect_texts((image_value_scale){-.3, .3, 0, 3}, 0, (const char *[]){"0", "0", "0", "0"});
    expect_texts((image_value_scale){0, 2e8, 0, 2}, -1, (const char *[]){"0", "1e+08", "2e+08"});
    expect_texts((image_value_scale){0, 2e-8, 0, 2}, -1, (const char *[]){"0", "1e-08", "2e-08"});
    expect_texts((image_value_scale){0, 1000, 2, 4}, -1, (const char *[]){"10", "31.6", "100", "316", "1000"});
    expect_texts((image_value_scale){0, 1, 3, 3}, -1, (const char *[]){"0.001", "0.01", "0.1", "1"});
    expect_texts((image_value_scale){0, 1000, 2, 4}, 0, (const char *[]){"10", "32", "100", "316", "1000"});
}

static void three_digits_are_three(void **state) {
    (void)state;
    static const struct {
        double value;
        const char *text;
    } cases[] = {{17783, "17800"}, {0.0123456, "0.0123"}, {-5.6789, "-5.68"},
                 {0, "0"},         {999.9, "1000"},       {1e30, "1e+30"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[IMAGE_SCALE_TEXT];
        image_three_digits_text(cases[i].value, text);
        assert_string_equal(text, cases[i].text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_have_their_places), cmocka_unit_test(divisions_invert_places),
        cmocka_unit_test(steps_are_round),          cmocka_unit_test(numbers_read_well),
        cmocka_unit_test(three_digits_are_three),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
