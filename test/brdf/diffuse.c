/* The diffuse term: its sampling against exact directions and its density, ends of the unit square, absurd inputs. */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <mpfr.h>

#include "brdf/common.h"

static const graze_vec3 normal = {0, 0, 1};

static void values(void **state) {
    (void)state;
    graze_vec3 up = {.6, 0, .8}, level = {1, 0, 0}, down = {0, .6, -.8};
    assert_true(graze_diffuse_value(up, normal) == 1 / pi);
    assert_true(fabs(graze_diffuse_density(up, normal) * pi - .8) < 1e-15);
    const graze_vec3 below[] = {level, down, {0, 0, NAN}, {NAN, NAN, NAN}};
    for (int i = 0; i < 4; ++i) {
        assert_true(graze_diffuse_value(up, below[i]) == 0 && graze_diffuse_value(below[i], up) == 0);
        assert_true(graze_diffuse_density(up, below[i]) == 0 && graze_diffuse_density(below[i], up) == 0);
        graze_brdf_sample sample = graze_diffuse_sample(below[i], .3, .3);
        assert_true(sample.density == 0 && sample.weight == 0);
        assert_true(sample.l.x == 0 && sample.l.y == 0 && sample.l.z == 0);
    }
    assert_true(isfinite(graze_diffuse_density((graze_vec3){0, 0, INFINITY}, up)));
}

/* How far l is from (sqrt(s) cos 2 pi t, sqrt(s) sin 2 pi t, sqrt(1 - s)). */
static double distance_from_exact(graze_vec3 l, double s, double t) {
    mpfr_t radius, angle, x, y, z;
    mpfr_inits2(200, radius, angle, x, y, z, (mpfr_ptr)NULL);
    mpfr_set_d(radius, s, MPFR_RNDN);
    mpfr_ui_sub(z, 1, radius, MPFR_RNDN);
    mpfr_sqrt(z, z, MPFR_RNDN);
    mpfr_sqrt(radius, radius, MPFR_RNDN);
    mpfr_const_pi(angle, MPFR_RNDN);
    mpfr_mul_d(angle, angle, 2 * t, MPFR_RNDN);
    mpfr_sin_cos(y, x, angle, MPFR_RNDN);
    mpfr_mul(x, x, radius, MPFR_RNDN);
    mpfr_mul(y, y, radius, MPFR_RNDN);
    mpfr_sub_d(x, x, l.x, MPFR_RNDN);
    mpfr_sub_d(y, y, l.y, MPFR_RNDN);
    mpfr_sub_d(z, z, l.z, MPFR_RNDN);
    mpfr_hypot(x, x, y, MPFR_RNDN);
    mpfr_hypot(x, x, z, MPFR_RNDN);
    double distance = mpfr_get_d(x, MPFR_RNDU);
    mpfr_clears(radius, angle, x, y, z, (mpfr_ptr)NULL);
    return distance;
}

static void directions_are_exact(void **state) {
    (void)state;
    const double ends[] = {0, 5e-324, 1e-20, .125, .25, .375, .5, .75, .875, 1 - 0x1p-53};
    uint64_t seed = 1;
    for (int i = 0; i < (is_short_run() ? 2000 : 20000); ++i) {
        double s = i < 100 ? ends[i % 10] : draw(&seed), t = i < 100 ? ends[i / 10] : draw(&seed);
        if (i % 3 == 2)
            s = 1 - draw_power(&seed, 0x1p-53, 1);
        graze_brdf_sample sample = graze_diffuse_sample(normal, s, t);
        assert_true(distance_from_exact(sample.l, s, t) < 4e-16);
        assert_true(sample.l.z > 0 && sample.weight == 1);
        assert_true(sample.density == graze_diffuse_density(sample.l, normal));
    }
}

/* A quarter more of t, which has bits to spare, turns x and y by a right angle, to the bit. */
static void quarter_turns_are_exact(void **state) {
    (void)state;
    for (int i = 0; i < 64; ++i) {
        double s = (i + .5) / 64;
        for (int k = -31; k < 32; ++k) { /* but not half-way between axes */
            double t = (k < 0 ? 1 : 0) + k / 256.;
            graze_vec3 l = graze_diffuse_sample(normal, s, t).l;
            for (int turn = 1; turn < 4; ++turn) {
                t += t < .75 ? .25 : -.75;
                graze_vec3 turned = graze_diffuse_sample(normal, s, t).l;
                l = (graze_vec3){-l.y, l.x, l.z};
                assert_true(turned.x == l.x && turned.y == l.y && turned.z == l.z);
            }
        }
    }
}

static void numbers_outside_count_as_the_nearest_inside(void **state) {
    (void)state;
    const double last = 1 - 0x1p-53, inside[] = {0, last, 0, last, last, .5, 0};
    const double given[] = {-1, 1, -INFINITY, INFINITY, 2, .5, NAN};
    for (int i = 0; i < 7; ++i)
        for (int k = 0; k < 7; ++k) {
            graze_brdf_sample a = graze_diffuse_sample(normal, given[i], given[k]),
                              b = graze_diffuse_sample(normal, inside[i], inside[k]);
            assert_true(a.l.x == b.l.x && a.l.y == b.l.y && a.l.z == b.l.z && a.density == b.density);
        }
}

/* Counted in 8 bands of lz^2 and 16 sectors, all of equal probability under the density lz/pi. */
static void samples_follow_their_density(void **state) {
    (void)state;
    enum { BANDS = 8, SECTORS = 16, CELLS = BANDS * SECTORS, COUNT = 200 * CELLS };
    int found[CELLS] = {0};
    uint64_t seed = 2;
    for (int i = 0; i < COUNT; ++i) {
        double s = draw(&seed), t = draw(&seed);
        graze_vec3 l = graze_diffuse_sample(normal, s, t).l;
        int band = (int)(l.z * l.z * BANDS), sector = (int)((atan2(l.y, l.x) / (2 * pi) + .5) * SECTORS);
        ++found[(band < BANDS ? band : BANDS - 1) * SECTORS + (sector < SECTORS ? sector : SECTORS - 1)];
    }
    double chi_square = 0;
    for (int i = 0; i < CELLS; ++i)
        chi_square += (found[i] - 200.) * (found[i] - 200.) / 200;
    assert_true(chi_square_p_value(chi_square, CELLS - 1) > .001);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values),
        cmocka_unit_test(directions_are_exact),
        cmocka_unit_test(quarter_turns_are_exact),
        cmocka_unit_test(numbers_outside_count_as_the_nearest_inside),
        cmocka_unit_test(samples_follow_their_density),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
