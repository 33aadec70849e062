/* What must hold for every input there is: no NaN, nothing negative, nothing infinite; and reciprocity to the last bit.
 */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "brdf/common.h"

static const double roughnesses[] = {GRAZE_ROUGHNESS_MIN, .003, .1, 1, GRAZE_ROUGHNESS_MAX};
enum { ROUGHNESSES = sizeof roughnesses / sizeof *roughnesses };

static void assert_regular(double x) {
    assert_true(x >= 0 && x <= DBL_MAX);
}

static void assert_regular_sample(graze_brdf_sample s) {
    assert_true(isfinite(s.l.x) && isfinite(s.l.y) && isfinite(s.l.z));
    assert_regular(s.density);
    assert_regular(s.weight);
}

static void assert_same_bits(double a, double b) {
    assert_memory_equal(&a, &b, sizeof a);
}

/* Everything about one pair, and both ways round. */
static void check_pair(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    assert_regular(graze_brdf_value(brdf, l, v));
    assert_regular(graze_brdf_ward_density(brdf, l, v));
    assert_regular(graze_brdf_ward_weight(brdf, l, v));
    assert_regular(graze_brdf_pair_density(brdf, l, v));
    assert_regular(graze_brdf_pair_weight(brdf, l, v));
    if (brdf->model == GRAZE_BRDF_GMD) {
        assert_true(graze_brdf_ward_weight(brdf, l, v) <= 2);
        assert_true(graze_brdf_pair_weight(brdf, l, v) <= 1);
    }
    if (!(l.z > 0 && v.z > 0)) {
        assert_same_bits(graze_brdf_value(brdf, l, v), 0);
        assert_same_bits(graze_brdf_ward_density(brdf, l, v), 0);
        assert_same_bits(graze_brdf_ward_weight(brdf, l, v), 0);
        assert_same_bits(graze_brdf_pair_density(brdf, l, v), 0);
        assert_same_bits(graze_brdf_pair_weight(brdf, l, v), 0);
    }
    assert_same_bits(graze_brdf_value(brdf, l, v), graze_brdf_value(brdf, v, l));
}

/* Unit vectors of special components, and finite vectors that are no directions at all. */
static void special_vectors(void **state) {
    (void)state;
    const double components[] = {0,     -0.0, 5e-324, -1e-310, DBL_MIN, 1e-300, 1e-150, -1e-75, 1e-20,
                                 -1e-8, .5,   -.7,    1,       -1,      1e5,    1e77,   -1e160, DBL_MAX};
    enum { COUNT = sizeof components / sizeof *components };
    uint64_t seed = 1;
    for (int i = 0; i < 200000; ++i) {
        double c[6];
        for (int k = 0; k < 6; ++k)
            c[k] = components[(int)(draw(&seed) * (draw(&seed) < .9 ? COUNT - 4 : COUNT))];
        double alpha_x = roughnesses[(int)(draw(&seed) * ROUGHNESSES)];
        const graze_brdf brdf = {(graze_brdf_model)(i % 4), alpha_x, roughnesses[(int)(draw(&seed) * ROUGHNESSES)]};
        graze_vec3 v = {c[3], c[4], c[5]};
        check_pair(&brdf, (graze_vec3){c[0], c[1], c[2]}, v);
        assert_regular_sample(graze_brdf_sample_ward(&brdf, v, draw(&seed), draw(&seed)));
        assert_regular_sample(graze_brdf_sample_pair(&brdf, v, draw(&seed), draw(&seed), draw(&seed)));
    }
}

static void not_numbers_reflect_nothing(void **state) {
    (void)state;
    for (int model = 0; model < 4; ++model) {
        const graze_brdf brdf = {(graze_brdf_model)model, .1, .2};
        for (int k = 0; k < 6; ++k) {
            double c[6] = {.6, 0, .8, 0, .6, .8};
            for (int infinite = 0; infinite < 2; ++infinite) {
                c[k] = infinite ? HUGE_VAL : NAN;
                graze_vec3 l = {c[0], c[1], c[2]}, v = {c[3], c[4], c[5]};
                assert_regular(graze_brdf_value(&brdf, l, v));
                assert_regular(graze_brdf_ward_density(&brdf, l, v));
                assert_regular(graze_brdf_pair_density(&brdf, l, v));
                assert_regular(graze_brdf_ward_weight(&brdf, l, v));
                assert_regular(graze_brdf_pair_weight(&brdf, l, v));
                assert_regular_sample(graze_brdf_sample_ward(&brdf, v, .5, .5));
                assert_regular_sample(graze_brdf_sample_pair(&brdf, v, .5, .5, .5));
                assert_regular(graze_brdf_albedo(&brdf, v));
            }
        }
    }
}

static void reciprocity_to_the_bit(void **state) {
    (void)state;
    uint64_t seed = 2;
    int positive = 0;
    for (int i = 0; i < 100000; ++i) {
        double alpha_x = draw_power(&seed, 1e-6, 10);
        const graze_brdf brdf = {(graze_brdf_model)(i % 4), alpha_x, draw_power(&seed, 1e-6, 10)};
        graze_vec3 v = direction(draw_power(&seed, i % 8 < 4 ? .01 : 1e-150, 1), draw_between(&seed, 0, 2 * pi));
        graze_brdf_sample s = graze_brdf_sample_pair(&brdf, v, draw(&seed), draw(&seed), draw(&seed));
        check_pair(&brdf, s.l, v);
        positive += graze_brdf_value(&brdf, s.l, v) > 0;
    }
    assert_true(positive > 30000); /* the test is not about zeros */
}

/* s next to 1 gives the largest slopes; views next to the horizon; s, t, u outside [0,1) count as its nearest number.
 */
static void samples_at_the_edges(void **state) {
    (void)state;
    const double numbers[] = {0, 5e-324, 1e-17, .25, .5, .75, 1 - 0x1p-53, 1, -1, 2, 1e308};
    enum { COUNT = sizeof numbers / sizeof *numbers };
    const double cosines[] = {1, .5, 1e-3, 1e-8, 1e-16, 1e-100, 1e-150, 1e-300, 5e-324};
    for (unsigned c = 0; c < sizeof cosines / sizeof *cosines; ++c)
        for (int a = 0; a < ROUGHNESSES * ROUGHNESSES; ++a)
            for (int i = 0; i < COUNT * COUNT * COUNT; ++i) {
                const graze_brdf brdf = {(graze_brdf_model)(i % 4), roughnesses[a / ROUGHNESSES],
                                         roughnesses[a % ROUGHNESSES]};
                graze_vec3 v = direction(cosines[c], i * .1);
                double s = numbers[i % COUNT], t = numbers[i / COUNT % COUNT], u = numbers[i / COUNT / COUNT];
                graze_brdf_sample ward = graze_brdf_sample_ward(&brdf, v, s, t);
                graze_brdf_sample pair = graze_brdf_sample_pair(&brdf, v, s, t, u);
                assert_regular_sample(ward);
                assert_regular_sample(pair);
                assert_true(fabs(dot(ward.l, ward.l) - 1) < 1e-14 && fabs(dot(pair.l, pair.l) - 1) < 1e-14);
                assert_true((ward.weight > 0) <= (ward.l.z > 0) && (pair.weight > 0) <= (pair.l.z > 0));
                if (brdf.model == GRAZE_BRDF_GMD)
                    assert_true(ward.weight <= 2 && pair.weight <= 1);
            }
}

static void too_large_is_the_largest_double(void **state) {
    (void)state;
    const graze_brdf sharp = {GRAZE_BRDF_GMD, 1e-6, 1e-6}, sharp_ward_duer = {GRAZE_BRDF_WARD_DUER, 1e-6, 1e-6};
    graze_vec3 v = {1, 0, 1e-150}, l = {-1, 0, 1e-150};
    assert_same_bits(graze_brdf_value(&sharp, l, v), DBL_MAX);
    assert_same_bits(graze_brdf_value(&sharp_ward_duer, l, v), DBL_MAX);
    v.z = l.z = 1e-148; /* 1/(4 pi 1e-12 1e-296) = 8e306 is not */
    assert_true(graze_brdf_value(&sharp, l, v) < DBL_MAX && graze_brdf_value(&sharp, l, v) > 7e306);
    assert_true(graze_brdf_value(&sharp_ward_duer, l, v) < DBL_MAX);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(special_vectors),
        cmocka_unit_test(not_numbers_reflect_nothing),
        cmocka_unit_test(reciprocity_to_the_bit),
        cmocka_unit_test(samples_at_the_edges),
        cmocka_unit_test(too_large_is_the_largest_double),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
