/* Constants, and the samplers' elementary functions, against arbitrary precision, in units in the last place. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <mpfr.h>

#include "brdf/common.h"
#include "brdf/elementary.h"

/* Those of elementary.h. */
static const double log_bound = 1, turn_bound = .9;

static double ulps(mpfr_t exact, double found) {
    mpfr_t error;
    mpfr_init2(error, 200);
    mpfr_sub_d(error, exact, found, MPFR_RNDN);
    mpfr_exp_t last_bit = mpfr_get_exp(exact) - 53;
    mpfr_div_2si(error, error, last_bit > -1074 ? last_bit : -1074, MPFR_RNDN);
    double result = fabs(mpfr_get_d(error, MPFR_RNDN));
    mpfr_clear(error);
    return result;
}

/* Whether the sum of both is `exact` to so many bits. */
static bool has_bits(mpfr_t exact, double hi, double lo, int bits) {
    mpfr_t error;
    mpfr_init2(error, 200);
    mpfr_sub_d(error, exact, hi, MPFR_RNDN);
    mpfr_sub_d(error, error, lo, MPFR_RNDN);
    mpfr_div(error, error, exact, MPFR_RNDN);
    bool result = fabs(mpfr_get_d(error, MPFR_RNDN)) < ldexp(1, -bits);
    mpfr_clear(error);
    return result;
}

/* Both halves of constants.h; and that products with log 2 are as exact as it says. */
static void constants_in_two_parts(void **state) {
    (void)state;
    mpfr_t exact;
    mpfr_init2(exact, 200);
    mpfr_const_pi(exact, MPFR_RNDN);
    assert_true(has_bits(exact, brdf_pi, brdf_pi_low, 106));
    assert_true(brdf_pi == mpfr_get_d(exact, MPFR_RNDN));
    mpfr_const_log2(exact, MPFR_RNDN);
    assert_true(has_bits(exact, brdf_ln2_hi, brdf_ln2_lo, 93));
    for (int n = 1; n < 1 << 13; ++n)
        assert_true(fma(n, brdf_ln2_hi, -(n * brdf_ln2_hi)) == 0);
    mpfr_clear(exact);
}

static int cases(void) {
    return is_short_run() ? 10000 : 100000;
}

/* s from 0 to 1, next to either, and where the logarithm is cut: at 1 - sqrt(1/2). */
static double draw_s(uint64_t *seed, int kind) {
    double s = kind == 0   ? draw(seed)
               : kind == 1 ? draw_power(seed, 1e-300, 1)
               : kind == 2 ? 1 - draw_power(seed, 0x1p-53, 1)
                           : draw_between(seed, .29, .31);
    return fmin(s, 1 - 0x1p-53);
}

static void logarithm(void **state) {
    (void)state;
    uint64_t seed = 41;
    double worst = 0;
    mpfr_t exact;
    mpfr_init2(exact, 160);
    for (int i = 0; i < cases(); ++i) {
        double s = draw_s(&seed, i % 4), found = brdf_minus_log_remainder(s, 1 - s);
        mpfr_set_d(exact, -s, MPFR_RNDN);
        mpfr_log1p(exact, exact, MPFR_RNDN);
        mpfr_neg(exact, exact, MPFR_RNDN);
        double error = ulps(exact, found);
        worst = fmax(worst, error);
        if (!(error <= log_bound))
            fail_msg("-log(1 - s) is %g ulp off at s = %a", error, s);
    }
    assert_true(worst > .7);
    assert_true(brdf_minus_log_remainder(0, 1) == 0);
    mpfr_clear(exact);
}

/* t from 0 to 1, next to 0, and next to every multiple of 1/8. */
static double draw_t(uint64_t *seed, int kind) {
    double away = draw_power(seed, 1e-17, .1), eighth = floor(8 * draw(seed)) / 8;
    return kind == 0 ? draw(seed) : kind == 1 ? draw_power(seed, 1e-300, 1) : fabs(eighth + (kind == 2 ? away : -away));
}

static void sine_and_cosine(void **state) {
    (void)state;
    uint64_t seed = 42;
    double worst = 0;
    mpfr_t exact, turns;
    mpfr_inits2(160, exact, turns, (mpfr_ptr)NULL);
    for (int i = 0; i < cases(); ++i) {
        double t = draw_t(&seed, i % 4);
        if (4 * t == floor(4 * t))
            continue;
        brdf_sine_cosine found = brdf_turn(t);
        mpfr_set_d(turns, t, MPFR_RNDN);
        mpfr_sinu(exact, turns, 1, MPFR_RNDN);
        double of_sine = ulps(exact, found.sine);
        mpfr_cosu(exact, turns, 1, MPFR_RNDN);
        double of_cosine = ulps(exact, found.cosine);
        worst = fmax(worst, fmax(of_sine, of_cosine));
        if (!(of_sine <= turn_bound && of_cosine <= turn_bound))
            fail_msg("sine and cosine of %a turns are %g and %g ulp off", t, of_sine, of_cosine);
    }
    assert_true(worst > .6);
    mpfr_clears(exact, turns, (mpfr_ptr)NULL);
}

static void quarters_are_exact(void **state) {
    (void)state;
    const double sines[] = {0, 1, 0, -1, 0}, cosines[] = {1, 0, -1, 0, 1};
    for (int quarter = 0; quarter < 5; ++quarter) {
        brdf_sine_cosine found = brdf_turn(quarter / 4.);
        assert_true(found.sine == sines[quarter] && found.cosine == cosines[quarter]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constants_in_two_parts),
        cmocka_unit_test(logarithm),
        cmocka_unit_test(sine_and_cosine),
        cmocka_unit_test(quarters_are_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
