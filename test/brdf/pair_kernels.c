/* The sums of two doubles that values, densities and weights are made of, against arbitrary precision: good to as much
 * as pair_kernels.h says, lower parts included. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <mpfr.h>

#include "brdf/common.h"
#include "brdf/pair_kernels.h"

/* Those of pair_kernels.h. */
#define GOOD   0x1p-90
#define GOOD_W 0x1p-60 /* what has to do with W */

/* Sums of the components here have so many bits. */
enum { BITS = 600 };

static int cases(void) {
    return is_short_run() ? 2000 : 20000;
}

/* --- Exact terms ---------------------------------------------------------------------------------------------------
 */

/* Of one pair; all but the first are the true numbers. */
enum { X2, Y2, Z2, HORIZONTAL2, SQUARE, Z, EXPONENT, NORMALISATION, MEAN, SCRATCH, TERMS };
typedef struct exact_terms {
    mpfr_t of[TERMS];
} exact_terms;

static void start(exact_terms *e) {
    for (int i = 0; i < TERMS; ++i)
        mpfr_init2(e->of[i], BITS);
}

static void stop(exact_terms *e) {
    for (int i = 0; i < TERMS; ++i)
        mpfr_clear(e->of[i]);
}

static void set_square_of_sum(mpfr_t to, double a, double b) {
    mpfr_set_d(to, a, MPFR_RNDN);
    mpfr_add_d(to, to, b, MPFR_RNDN);
    mpfr_sqr(to, to, MPFR_RNDN);
}

/* 1/(pi ax ay) */
static void set_normalisation(mpfr_t to, const graze_brdf *brdf) {
    mpfr_const_pi(to, MPFR_RNDN);
    mpfr_mul_d(to, to, brdf->alpha_x, MPFR_RNDN);
    mpfr_mul_d(to, to, brdf->alpha_y, MPFR_RNDN);
    mpfr_ui_div(to, 1, to, MPFR_RNDN);
}

/* W = (w + w')/2 for w = 2a, w' = 2 (2 - 3a - 2 tau^2 + a tau^2)/(3 - 4a - tau^2) where that is positive, a = lz/hz:
 * what comes of v.h = h.h/2. */
static void set_mean_weight(exact_terms *e, double lz) {
    mpfr_ptr a = e->of[SCRATCH], mean = e->of[MEAN];
    mpfr_t tan2, divisor;
    mpfr_inits2(BITS, tan2, divisor, (mpfr_ptr)NULL);
    mpfr_d_div(a, lz, e->of[Z], MPFR_RNDN);
    mpfr_div(tan2, e->of[HORIZONTAL2], e->of[Z2], MPFR_RNDN);
    mpfr_mul_ui(divisor, a, 4, MPFR_RNDN);
    mpfr_ui_sub(divisor, 3, divisor, MPFR_RNDN);
    mpfr_sub(divisor, divisor, tan2, MPFR_RNDN);
    mpfr_sub_ui(mean, a, 2, MPFR_RNDN); /* a tau^2 - 2 tau^2 - 3a + 2 */
    mpfr_mul(mean, mean, tan2, MPFR_RNDN);
    mpfr_mul_ui(tan2, a, 3, MPFR_RNDN);
    mpfr_sub(mean, mean, tan2, MPFR_RNDN);
    mpfr_add_ui(mean, mean, 2, MPFR_RNDN);
    if (mpfr_sgn(mean) > 0) {
        mpfr_div(mean, mean, divisor, MPFR_RNDN);
        mpfr_add(mean, mean, a, MPFR_RNDN);
    } else {
        mpfr_set(mean, a, MPFR_RNDN);
    }
    mpfr_clears(tan2, divisor, (mpfr_ptr)NULL);
}

static void evaluate(exact_terms *e, const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    set_square_of_sum(e->of[X2], l.x, v.x);
    set_square_of_sum(e->of[Y2], l.y, v.y);
    set_square_of_sum(e->of[Z2], l.z, v.z);
    mpfr_sqrt(e->of[Z], e->of[Z2], MPFR_RNDN);
    mpfr_add(e->of[HORIZONTAL2], e->of[X2], e->of[Y2], MPFR_RNDN);
    mpfr_add(e->of[SQUARE], e->of[HORIZONTAL2], e->of[Z2], MPFR_RNDN);
    mpfr_div_d(e->of[SCRATCH], e->of[X2], brdf->alpha_x, MPFR_RNDN);
    mpfr_div_d(e->of[SCRATCH], e->of[SCRATCH], brdf->alpha_x, MPFR_RNDN);
    mpfr_div_d(e->of[EXPONENT], e->of[Y2], brdf->alpha_y, MPFR_RNDN);
    mpfr_div_d(e->of[EXPONENT], e->of[EXPONENT], brdf->alpha_y, MPFR_RNDN);
    mpfr_add(e->of[EXPONENT], e->of[EXPONENT], e->of[SCRATCH], MPFR_RNDN);
    mpfr_div(e->of[EXPONENT], e->of[EXPONENT], e->of[Z2], MPFR_RNDN);
    set_normalisation(e->of[NORMALISATION], brdf);
    set_mean_weight(e, l.z);
}

/* --- Comparisons ---------------------------------------------------------------------------------------------------
 */

/* (hi + lo)(1 + correction) against what is exact. */
static void assert_good(mpfr_t exact, double_double found, double correction, double bound, const char *what) {
    mpfr_t sum;
    mpfr_init2(sum, BITS);
    mpfr_set_d(sum, correction, MPFR_RNDN);
    mpfr_add_ui(sum, sum, 1, MPFR_RNDN);
    mpfr_mul_d(sum, sum, found.hi, MPFR_RNDN); /* what the correction adds to the lower part is nothing */
    mpfr_add_d(sum, sum, found.lo, MPFR_RNDN);
    mpfr_sub(sum, sum, exact, MPFR_RNDN);
    bool is_good = mpfr_zero_p(sum) != 0;
    if (!is_good) {
        mpfr_div(sum, sum, exact, MPFR_RNDN);
        is_good = fabs(mpfr_get_d(sum, MPFR_RNDN)) <= bound;
    }
    double error = mpfr_get_d(sum, MPFR_RNDN);
    mpfr_clear(sum);
    if (!is_good)
        fail_msg("%s, %a + %a, is off by %a of itself", what, found.hi, found.lo, error);
}

static void check_constants(exact_terms *e, const graze_brdf *brdf, const lobe_constants *k) {
    mpfr_ptr a = e->of[SCRATCH];
    const double_double over[] = {k->over_sx2, k->over_sy2};
    const double alphas[] = {brdf->alpha_x, brdf->alpha_y};
    for (int i = 0; i < 2; ++i) {
        mpfr_set_d(a, alphas[i], MPFR_RNDN);
        mpfr_sqr(a, a, MPFR_RNDN);
        mpfr_mul_d(a, a, k->s, MPFR_RNDN);
        mpfr_ui_div(a, 1, a, MPFR_RNDN);
        assert_good(a, over[i], 0, GOOD, "1/(s alpha^2)");
    }
    mpfr_div_ui(a, e->of[NORMALISATION], 4, MPFR_RNDN);
    assert_good(a, k->quarter, 0, GOOD, "1/(4 pi ax ay)");
    assert_good(e->of[NORMALISATION], exact_product(k->s, k->s), k->excess, GOOD, "s^2 (1 + excess)");
    assert_true(fabs(k->s * k->inverse_s - 1) <= 0x1p-50);
}

static void check_half_vector(exact_terms *e, const half_vector *h) {
    assert_good(e->of[X2], h->x2, 0, GOOD, "hx^2");
    assert_good(e->of[Y2], h->y2, 0, GOOD, "hy^2");
    assert_good(e->of[Z], h->z, 0, GOOD, "hz");
    assert_good(e->of[Z2], h->z2, 0, GOOD, "hz^2");
    assert_good(e->of[HORIZONTAL2], h->horizontal2, 0, GOOD, "hx^2 + hy^2");
    assert_good(e->of[SQUARE], h->square, 0, GOOD, "h.h");
}

/* Exponent, and factors before E. The exact terms are turned from one into the next. */
static void check_factors(exact_terms *e, const lobe_constants *k, const half_vector *h, double lz, mean_weight w) {
    mpfr_ptr a = e->of[SCRATCH];
    lobe_terms t = lobe_terms_of(k, h);
    double correction = gmd_correction(k, &t);
    assert_good(e->of[EXPONENT], (double_double){t.exponent, t.exponent_low}, 0, GOOD, "the exponent");

    mpfr_d_div(a, k->s, e->of[Z2], MPFR_RNDN);
    assert_good(a, (double_double){t.r, 0}, t.rho, GOOD, "s/hz^2");

    mpfr_div(a, e->of[SQUARE], e->of[Z2], MPFR_RNDN);
    mpfr_div(a, a, e->of[Z2], MPFR_RNDN);
    mpfr_mul(a, a, e->of[NORMALISATION], MPFR_RNDN);
    assert_good(a, gmd_factor(h, &t), correction, GOOD, "h.h/(pi ax ay hz^4)");

    mpfr_mul(a, a, e->of[Z], MPFR_RNDN);
    mpfr_div_ui(a, a, 2, MPFR_RNDN);
    assert_good(a, ward_density_factor(h, &t), correction, GOOD, "Ward's density but for E");

    mpfr_div(a, a, e->of[Z], MPFR_RNDN);
    mpfr_mul_d(a, a, 2 * lz, MPFR_RNDN);
    mpfr_div(a, a, e->of[MEAN], MPFR_RNDN);
    if (w.certain)
        assert_good(a, pair_density_factor(h, &t, lz, w.mean), correction, GOOD_W, "paired density but for E");
}

static void check_cosine_factors(exact_terms *e, graze_vec3 l, graze_vec3 v) {
    mpfr_ptr a = e->of[SCRATCH];
    mpfr_set_d(a, l.z, MPFR_RNDN);
    mpfr_mul_d(a, a, v.z, MPFR_RNDN);
    assert_good(a, cosine_factor(GRAZE_BRDF_WARD_DUER, l.z, v.z), 0, GOOD, "lz vz");
    mpfr_sqrt(a, a, MPFR_RNDN);
    assert_good(a, cosine_factor(GRAZE_BRDF_WARD, l.z, v.z), 0, GOOD, "sqrt(lz vz)");
    mpfr_set_d(a, fmax(l.z, v.z), MPFR_RNDN);
    assert_good(a, cosine_factor(GRAZE_BRDF_WARD_NEUMANN, l.z, v.z), 0, GOOD, "max(lz, vz)");
}

static void check_pair(exact_terms *e, const graze_brdf *brdf, graze_vec3 l, graze_vec3 v, int *certain) {
    lobe_constants k = lobe_constants_of(brdf);
    half_vector h = half_vector_of(l, v);
    mean_weight w = mean_weight_of_pair(&h, l.z, v.z);
    assert_true(has_ordinary_cosines(&h));
    evaluate(e, brdf, l, v);
    check_constants(e, brdf, &k);
    check_half_vector(e, &h);
    check_cosine_factors(e, l, v);
    check_factors(e, &k, &h, l.z, w);
    if (w.certain) {
        assert_good(e->of[MEAN], w.mean, 0, GOOD_W, "W");
        assert_true(w.mean.hi <= 1);
        ++*certain;
    }
}

/* --- Pairs ---------------------------------------------------------------------------------------------------------
 */

/* The ends of the range as often as a power of ten in it. */
static double draw_roughness(uint64_t *seed) {
    return fmin(fmax(draw_power(seed, 1e-7, 100), GRAZE_ROUGHNESS_MIN), GRAZE_ROUGHNESS_MAX);
}

/* Any two directions; or almost mirrored, with cosines next to each other: there W is next to 1. */
static void sums_are_as_good_as_said(void **state) {
    (void)state;
    uint64_t seed = 91;
    int certain = 0;
    exact_terms e;
    start(&e);
    for (int i = 0; i < cases(); ++i) {
        const graze_brdf brdf = {GRAZE_BRDF_GMD, draw_roughness(&seed), draw_roughness(&seed)};
        double azimuth = draw_between(&seed, 0, 2 * pi), least = i % 4 < 2 ? .01 : 1e-9;
        graze_vec3 v = direction(draw_power(&seed, least, 1), azimuth);
        graze_vec3 l = direction(draw_power(&seed, least, 1), draw_between(&seed, 0, 2 * pi));
        if (i % 3 == 0) {
            double away = draw_power(&seed, 1e-18, 1);
            l = (graze_vec3){-v.x + away * (draw(&seed) - .5), -v.y + away * (draw(&seed) - .5),
                             v.z * (1 + away * (draw(&seed) - .5))};
        }
        check_pair(&e, &brdf, l, v, &certain);
    }
    stop(&e);
    assert_true(certain > cases() / 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_are_as_good_as_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
