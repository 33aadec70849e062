/* Channels as colours, and the choice between plastic2 and metal2. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "fit/material.h"

enum { CHANNELS_MAX = 81 };

static bool is_colour(graze_rgb c, double r, double g, double b, double tolerance) {
    return fabs(c.r - r) <= tolerance && fabs(c.g - g) <= tolerance && fabs(c.b - b) <= tolerance;
}

static fit_colour_kind kind_of(const char *const *names, size_t count, double first_wavelength) {
    fit_channel_name channels[CHANNELS_MAX];
    for (size_t k = 0; k < count; k++)
        channels[k] = (fit_channel_name){(char *)names[k], first_wavelength ? first_wavelength + 10 * (double)k : 0};
    return fit_colour_kind_of(channels, count);
}

static void kinds(void **state) {
    (void)state;
    const char *rgb[] = {"R", "G", "B"}, *brdfeval[] = {"f_r", "f_g", "f_b"}, *words[] = {"red", "green", "blue"};
    const char *xyz[] = {"X", "Y", "Z"}, *other[] = {"a", "b", "c"};
    assert_int_equal(kind_of(rgb, 3, 0), FIT_COLOUR_RGB);
    assert_int_equal(kind_of(brdfeval, 3, 0), FIT_COLOUR_RGB);
    assert_int_equal(kind_of(words, 3, 0), FIT_COLOUR_RGB);
    assert_int_equal(kind_of(xyz, 3, 0), FIT_COLOUR_XYZ);
    assert_int_equal(kind_of(other, 3, 0), FIT_COLOUR_GREY);
    assert_int_equal(kind_of(rgb, 1, 0), FIT_COLOUR_GREY);
    assert_int_equal(kind_of(other, 3, 500), FIT_COLOUR_SPECTRUM);
    assert_int_equal(kind_of(other, 3, 900), FIT_COLOUR_GREY);
}

static double value_of(const void *values, size_t channel) {
    return ((const double *)values)[channel];
}

/* A spectrum from 380 nm on, in steps of 5 nm. */
static graze_rgb colour_of_spectrum(double (*reflectance)(double)) {
    fit_channel_name channels[CHANNELS_MAX];
    double values[CHANNELS_MAX];
    for (size_t k = 0; k < CHANNELS_MAX; k++) {
        channels[k] = (fit_channel_name){(char *)"", 380 + 5 * (double)k};
        values[k] = reflectance(channels[k].wavelength);
    }
    return fit_colour(FIT_COLOUR_SPECTRUM, channels, CHANNELS_MAX, value_of, values);
}

static double even(double w) {
    (void)w;
    return .4;
}
static double long_waves(double w) {
    return w > 600;
}
static double falling(double w) {
    return (780 - w) / 400;
}

static void colours(void **state) {
    (void)state;
    assert_true(is_colour(colour_of_spectrum(even), .4, .4, .4, 1e-9));
    graze_rgb red = colour_of_spectrum(long_waves), fall = colour_of_spectrum(falling);
    assert_true(red.r > .5 && red.g < .05 && red.b == 0);
    assert_true(fall.b > fall.g && fall.g > fall.r);
    /* A primary of Radiance has the chromaticity (.640 .330). */
    const double primary[] = {.64 / .33 * .2651058201, .2651058201, .03 / .33 * .2651058201};
    assert_true(is_colour(fit_colour(FIT_COLOUR_XYZ, NULL, 3, value_of, primary), 1, 0, 0, 1e-8));
    const double grey[] = {.1, .2, .3};
    assert_true(is_colour(fit_colour(FIT_COLOUR_GREY, NULL, 3, value_of, grey), .2, .2, .2, 1e-15));
    assert_true(is_colour(fit_colour(FIT_COLOUR_RGB, NULL, 3, value_of, grey), .1, .2, .3, 0));
}

static fit_material material_of(const double rs[3], const double rd[3]) {
    static const char *const letters[] = {"R", "G", "B"};
    fit_channel channels[3];
    fit_channel_name names[3];
    memset(channels, 0, sizeof channels);
    for (size_t k = 0; k < 3; k++) {
        channels[k] = (fit_channel){.alpha_x = {.1 * (double)(k + 1), 0, FIT_DETERMINED},
                                    .alpha_y = {.2, 0, FIT_DETERMINED},
                                    .rs = {rs[k], 0, FIT_DETERMINED},
                                    .rd = {rd[k], 0, FIT_DETERMINED}};
        names[k] = (fit_channel_name){(char *)letters[k], 0};
    }
    const fit_result r = {.channel_count = 3, .channels = channels, .fit_count = 3};
    return fit_material_of(&r, names);
}

static void choice(void **state) {
    (void)state;
    /* What a plastic2 of colour (.6 .3 .1) and spec .05 has, and back. */
    const double white[] = {.05, .05, .05}, dyed[] = {.6 * .95, .3 * .95, .1 * .95};
    fit_material m = material_of(white, dyed);
    assert_false(m.metal);
    assert_true(is_colour(m.colour, .6, .3, .1, 1e-12) && fabs(m.spec - .05) < 1e-12);
    assert_true(is_colour(m.rs_as, .05, .05, .05, 1e-12) && is_colour(m.rd_as, dyed[0], dyed[1], dyed[2], 1e-12));
    assert_true(fabs(m.alpha_x - .2) < 1e-12 && fabs(m.alpha_y - .2) < 1e-12);
    /* A metal2 of colour (.8 .5 .2) and spec .9. */
    const double gold[] = {.72, .45, .18}, rest[] = {.08, .05, .02};
    m = material_of(gold, rest);
    assert_true(m.metal);
    assert_true(is_colour(m.colour, .8, .5, .2, 1e-12) && fabs(m.spec - .9) < 1e-12);
    assert_true(is_colour(m.rs_as, .72, .45, .18, 1e-12) && is_colour(m.rd_as, .08, .05, .02, 1e-12));
    assert_true(fabs(m.alpha_x - (.072 + .09 + .054) / 1.35) < 1e-12);
    /* Grey could be either; black has no colour; all specular leaves nothing for the diffuse part. */
    m = material_of(white, white);
    assert_true(!m.metal && is_colour(m.colour, .05 / .95, .05 / .95, .05 / .95, 1e-12));
    const double black[] = {0, 0, 0}, mirror[] = {1, 1, 1};
    m = material_of(black, black);
    assert_true(!m.metal && m.spec == 0 && is_colour(m.colour, 0, 0, 0, 0));
    m = material_of(mirror, black);
    assert_true(!m.metal && fabs(m.spec - 1) < 1e-6 && isfinite(m.colour.r));
}

/* What noise and rounding leave of colour decides nothing. */
static void grey_is_plastic(void **state) {
    (void)state;
    for (int i = 1; i < 2000; i++) {
        double total = .175 + i * 1e-7, specular = total * i / 2000;
        const double rs[] = {specular, specular, specular};
        const double rd[] = {total - specular, total - specular, total - specular};
        assert_false(material_of(rs, rd).metal);
    }
    /* Less than 1% from grey, though just as a metal2 would have it; and more. */
    const double hardly[] = {.05, .0501, .0499}, hardly_rest[] = {.1, .1002, .0998};
    assert_false(material_of(hardly, hardly_rest).metal);
    const double silver[] = {.9 * .97, .9 * .96, .9 * .92}, silver_rest[] = {.1 * .97, .1 * .96, .1 * .92};
    assert_true(material_of(silver, silver_rest).metal);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(kinds), cmocka_unit_test(colours), cmocka_unit_test(choice),
                                       cmocka_unit_test(grey_is_plastic)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
