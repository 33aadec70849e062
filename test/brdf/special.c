/* What must hold for every input there is: no NaN, nothing negative, not even -0, nothing infinite; and reciprocity to
 * the last bit. */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "brdf/albedo.h"
#include "brdf/common.h"
#include "brdf/kernel_tables.h"
#include "graze/brdf_batch.h"

static const double roughnesses[] = {GRAZE_ROUGHNESS_MIN, .003, .1, 1, GRAZE_ROUGHNESS_MAX};
enum { ROUGHNESSES = sizeof roughnesses / sizeof *roughnesses };

static void assert_regular(double x) {
    assert_true(x >= 0 && x <= DBL_MAX && !signbit(x));
}

static void assert_regular_sample(graze_brdf_sample s) {
    assert_true(isfinite(s.l.x) && isfinite(s.l.y) && isfinite(s.l.z));
    assert_regular(s.density);
    assert_regular(s.weight);
}

static void assert_same_bits(double a, double b) {
    assert_memory_equal(&a, &b, sizeof a);
}

typedef void pair_batch(const graze_brdf *, size_t, graze_vec3_arrays l, graze_vec3_arrays v, double *);
typedef void pair_float_batch(const graze_brdf *, size_t, graze_vec3_float_arrays l, graze_vec3_float_arrays v,
                              float *);
enum { PAIR_FUNCTIONS = 5 };
static pair_batch *const pair_batches[PAIR_FUNCTIONS] = {graze_brdf_value_batch, graze_brdf_ward_density_batch,
                                                         graze_brdf_ward_weight_batch, graze_brdf_pair_density_batch,
                                                         graze_brdf_pair_weight_batch};
static pair_float_batch *const pair_float_batches[PAIR_FUNCTIONS] = {
    graze_brdf_value_float_batch, graze_brdf_ward_density_float_batch, graze_brdf_ward_weight_float_batch,
    graze_brdf_pair_density_float_batch, graze_brdf_pair_weight_float_batch};

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
    for (int model = 0; model < GRAZE_BRDF_MODEL_COUNT; ++model) {
        const graze_brdf brdf = {(graze_brdf_model)model, .1, .2};
        for (int k = 0; k < 6; ++k) {
            double c[6] = {.6, 0, .8, 0, .6, .8};
            for (int infinite = 0; infinite < 2; ++infinite) {
                c[k] = infinite ? HUGE_VAL : NAN;
                graze_vec3 l = {c[0], c[1], c[2]}, v = {c[3], c[4], c[5]};
                assert_same_bits(graze_brdf_value(&brdf, l, v), 0);
                assert_same_bits(graze_brdf_ward_density(&brdf, l, v), 0);
                assert_same_bits(graze_brdf_pair_density(&brdf, l, v), 0);
                assert_regular(graze_brdf_ward_weight(&brdf, l, v));
                assert_regular(graze_brdf_pair_weight(&brdf, l, v));
                if (model != GRAZE_BRDF_GMD || k % 3 == 2) { /* else they depend on cosines and slopes alone */
                    assert_same_bits(graze_brdf_ward_weight(&brdf, l, v), 0);
                    assert_same_bits(graze_brdf_pair_weight(&brdf, l, v), 0);
                }
                assert_regular_sample(graze_brdf_sample_ward(&brdf, v, .5, .5));
                assert_regular_sample(graze_brdf_sample_pair(&brdf, v, .5, .5, .5));
                assert_regular(graze_brdf_albedo(&brdf, v));
            }
        }
    }
}

/* `result` is `one` times 2^power, or as near to it as a double can be. */
static void assert_scaled(double result, double one, int power) {
    double expected = fmin(ldexp(one, power), DBL_MAX);
    if (!(fabs(result - expected) <= 4e-16 * expected + 5e-324))
        fail_msg("%.17g instead of %.17g, 2^%d times %.17g", result, expected, power, one);
}

/* Vectors 2^k times as long, though no directions, only change results by powers of two, which lead through all that
 * takes those out of pairs and puts them back. */
static void lengths_are_powers_of_two(void **state) {
    (void)state;
    static const int of_value[] = {-2, -1, -2, -1}, of_weight[] = {0, 1, 0, 1};
    uint64_t seed = 5;
    for (int i = 0; i < 2000; ++i) {
        const graze_brdf brdf = {(graze_brdf_model)(i % 4), draw_power(&seed, 1e-3, 1), draw_power(&seed, 1e-3, 1)};
        graze_vec3 v = direction(draw_between(&seed, .01, 1), draw_between(&seed, 0, 2 * pi));
        graze_vec3 l = graze_brdf_sample_pair(&brdf, v, draw(&seed), draw(&seed), draw(&seed)).l;
        int k = i % 8 < 4 ? (int)draw_between(&seed, -900, 1022) : (int)draw_between(&seed, -100, 100);
        graze_vec3 far_l = {ldexp(l.x, k), ldexp(l.y, k), ldexp(l.z, k)};
        graze_vec3 far_v = {ldexp(v.x, k), ldexp(v.y, k), ldexp(v.z, k)};
        if (l.z < .01)
            continue;
        assert_scaled(graze_brdf_value(&brdf, far_l, far_v), graze_brdf_value(&brdf, l, v), of_value[i % 4] * k);
        assert_scaled(graze_brdf_ward_density(&brdf, far_l, far_v), graze_brdf_ward_density(&brdf, l, v), -k);
        assert_scaled(graze_brdf_pair_density(&brdf, far_l, far_v), graze_brdf_pair_density(&brdf, l, v), -k);
        assert_scaled(graze_brdf_ward_weight(&brdf, far_l, far_v), graze_brdf_ward_weight(&brdf, l, v),
                      of_weight[i % 4] * k);
        assert_scaled(graze_brdf_pair_weight(&brdf, far_l, far_v), graze_brdf_pair_weight(&brdf, l, v),
                      of_weight[i % 4] * k);
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

/* Every function of a pair, one at a time and as an array. */
static void check_table(const brdf_kernels *set, const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    brdf_scalar_function *const scalar[] = {set->value, set->ward_density, set->ward_weight, set->pair_density,
                                            set->pair_weight};
    brdf_batch_function *const batch[] = {set->value_batch, set->ward_density_batch, set->ward_weight_batch,
                                          set->pair_density_batch, set->pair_weight_batch};
    const graze_vec3_arrays to = {&l.x, &l.y, &l.z}, from = {&v.x, &v.y, &v.z};
    for (unsigned k = 0; k < sizeof scalar / sizeof *scalar; ++k) {
        double result;
        batch[k](brdf, 1, to, from, &result);
        assert_regular(result);
        assert_same_bits(scalar[k](brdf, l, v), result);
    }
}

/* Exponents far beyond what any factor makes up for, next to the horizon, where powers of two are taken out. */
static void nothing_is_minus_zero(void **state) {
    (void)state;
    const brdf_kernels *sets[KERNEL_TABLES_MOST];
    int count = kernel_tables_available(sets);
    uint64_t seed = 3;
    for (int i = 0; i < 20000; ++i) {
        const graze_brdf brdf = {(graze_brdf_model)(i % 4), draw_power(&seed, 1e-6, 1), draw_power(&seed, 1e-6, 1)};
        double azimuth = draw_between(&seed, 0, 2 * pi), turn = draw_power(&seed, 1e-17, 1);
        graze_vec3 l = direction(draw_power(&seed, i % 8 < 4 ? 1e-3 : 1e-150, 1), azimuth);
        graze_vec3 v = direction(draw_power(&seed, 1e-150, 1), azimuth + pi + turn);
        for (int k = 0; k < count; ++k)
            check_table(sets[k], &brdf, l, v);
    }
    const graze_vec3 l = {-0.96677504209406828, -0.25560772696107897, 0.0032722930496730399};
    const graze_vec3 v = {-0.73330226849876035, 0.67990277467780047, 3.8395072084431578e-67};
    for (int model = 0; model < GRAZE_BRDF_MODEL_COUNT; ++model)
        for (int k = 0; k < count; ++k)
            check_table(sets[k], &(graze_brdf){(graze_brdf_model)model, 1e-6, 1e-6}, l, v);
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

static void assert_same_sample(graze_brdf_sample a, graze_brdf_sample b) {
    assert_memory_equal(&a, &b, sizeof a);
}

/* Roughness outside its range is the nearest inside, or the least; no model is Ward-Neumann: in every function. */
static void lobes_out_of_range(void **state) {
    (void)state;
    const double given[] = {0, -1, 9e-7, 1e-300, NAN, -HUGE_VAL, 11, 1e100, DBL_MAX, HUGE_VAL, .2};
    const double nearest[] = {1e-6, 1e-6, 1e-6, 1e-6, 1e-6, 1e-6, 10, 10, 10, 10, .2};
    enum { COUNT = sizeof given / sizeof *given, MODELS = 6 };
    const graze_brdf_model models[MODELS] = {GRAZE_BRDF_GMD,        GRAZE_BRDF_WARD,
                                             GRAZE_BRDF_WARD_DUER,  GRAZE_BRDF_WARD_NEUMANN,
                                             (graze_brdf_model)100, (graze_brdf_model)GRAZE_BRDF_MODEL_COUNT};
    uint64_t seed = 3;
    for (int i = 0; i < COUNT * COUNT; ++i) {
        const graze_brdf brdf = {models[i % MODELS], given[i / COUNT], given[i % COUNT]};
        const graze_brdf same = {models[i % MODELS < 3 ? i % MODELS : 3], nearest[i / COUNT], nearest[i % COUNT]};
        graze_vec3 v = direction(draw_power(&seed, 1e-3, 1), draw_between(&seed, 0, 2 * pi));
        graze_vec3 l = i % 2 ? mirror_of(v) : direction(draw_power(&seed, 1e-300, 1), draw_between(&seed, 0, 2 * pi));
        double s = draw(&seed), t = draw(&seed), u = draw(&seed), one[5], other[5];
        float sf = (float)s, tf = (float)t, uf = (float)u, lf[] = {(float)l.x, (float)l.y, (float)l.z};
        float vf[] = {(float)v.x, (float)v.y, (float)v.z}, one_float[5], other_float[5];
        check_pair(&brdf, l, v);
        assert_same_bits(graze_brdf_value(&brdf, l, v), graze_brdf_value(&same, l, v));
        assert_same_bits(graze_brdf_ward_density(&brdf, l, v), graze_brdf_ward_density(&same, l, v));
        assert_same_bits(graze_brdf_ward_weight(&brdf, l, v), graze_brdf_ward_weight(&same, l, v));
        assert_same_bits(graze_brdf_pair_density(&brdf, l, v), graze_brdf_pair_density(&same, l, v));
        assert_same_bits(graze_brdf_pair_weight(&brdf, l, v), graze_brdf_pair_weight(&same, l, v));
        assert_same_sample(graze_brdf_sample_ward(&brdf, v, s, t), graze_brdf_sample_ward(&same, v, s, t));
        assert_same_sample(graze_brdf_sample_pair(&brdf, v, s, t, u), graze_brdf_sample_pair(&same, v, s, t, u));
        if (i % 8 == 0) {
            assert_same_bits(graze_brdf_albedo(&brdf, v), graze_brdf_albedo(&same, v));
            assert_same_bits(graze_brdf_mean_albedo(&brdf), graze_brdf_mean_albedo(&same));
        }
        assert_same_bits(graze_brdf_ward_acceptance(&brdf, v), graze_brdf_ward_acceptance(&same, v));

        const graze_vec3_arrays ls = {&l.x, &l.y, &l.z}, vs = {&v.x, &v.y, &v.z};
        for (int function = 0; function < PAIR_FUNCTIONS; ++function) {
            pair_batches[function](&brdf, 1, ls, vs, one);
            pair_batches[function](&same, 1, ls, vs, other);
            assert_same_bits(*one, *other);
            assert_regular(*one);
        }
        const graze_brdf_sample_arrays to_one = {one, one + 1, one + 2, one + 3, one + 4};
        const graze_brdf_sample_arrays to_other = {other, other + 1, other + 2, other + 3, other + 4};
        graze_brdf_sample_ward_batch(&brdf, 1, vs, &s, &t, to_one);
        graze_brdf_sample_ward_batch(&same, 1, vs, &s, &t, to_other);
        assert_memory_equal(one, other, sizeof one);
        graze_brdf_sample_pair_batch(&brdf, 1, vs, &s, &t, &u, to_one);
        graze_brdf_sample_pair_batch(&same, 1, vs, &s, &t, &u, to_other);
        assert_memory_equal(one, other, sizeof one);

        const graze_vec3_float_arrays lfs = {lf, lf + 1, lf + 2}, vfs = {vf, vf + 1, vf + 2};
        for (int function = 0; function < PAIR_FUNCTIONS; ++function) {
            pair_float_batches[function](&brdf, 1, lfs, vfs, one_float);
            pair_float_batches[function](&same, 1, lfs, vfs, other_float);
            assert_memory_equal(one_float, other_float, sizeof *one_float);
        }
        const graze_brdf_sample_float_arrays f_one = {one_float, one_float + 1, one_float + 2, one_float + 3,
                                                      one_float + 4};
        const graze_brdf_sample_float_arrays f_other = {other_float, other_float + 1, other_float + 2, other_float + 3,
                                                        other_float + 4};
        graze_brdf_sample_ward_float_batch(&brdf, 1, vfs, &sf, &tf, f_one);
        graze_brdf_sample_ward_float_batch(&same, 1, vfs, &sf, &tf, f_other);
        assert_memory_equal(one_float, other_float, sizeof one_float);
        graze_brdf_sample_pair_float_batch(&brdf, 1, vfs, &sf, &tf, &uf, f_one);
        graze_brdf_sample_pair_float_batch(&same, 1, vfs, &sf, &tf, &uf, f_other);
        assert_memory_equal(one_float, other_float, sizeof one_float);
    }
}

/* Below the entry points, too: no function of a table, nor an albedo's, is at a loss for what is no model. */
static void no_model_is_ward_neumann_everywhere(void **state) {
    (void)state;
    const graze_brdf brdf = {(graze_brdf_model)GRAZE_BRDF_MODEL_COUNT, .2, .3},
                     same = {GRAZE_BRDF_WARD_NEUMANN, .2, .3};
    graze_vec3 l = from_degrees(50, 10), v = from_degrees(60, 170);
    const graze_vec3_arrays ls = {&l.x, &l.y, &l.z}, vs = {&v.x, &v.y, &v.z};
    float f[6] = {(float)l.x, (float)l.y, (float)l.z, (float)v.x, (float)v.y, (float)v.z}, one_float, other_float;
    const graze_vec3_float_arrays lfs = {f, f + 1, f + 2}, vfs = {f + 3, f + 4, f + 5};
    double s = .4, one[5], other[5];
    const graze_brdf_sample_arrays to_one = {one, one + 1, one + 2, one + 3, one + 4};
    const graze_brdf_sample_arrays to_other = {other, other + 1, other + 2, other + 3, other + 4};
    const brdf_kernels *tables[KERNEL_TABLES_MOST];
    for (int i = 0, count = kernel_tables_available(tables); i < count; ++i) {
        const brdf_kernels *k = tables[i];
        brdf_scalar_function *const scalars[] = {k->value, k->ward_weight, k->pair_weight};
        brdf_batch_function *const batches[] = {k->value_batch, k->ward_weight_batch, k->pair_weight_batch};
        for (int function = 0; function < 3; ++function) {
            assert_same_bits(scalars[function](&brdf, l, v), scalars[function](&same, l, v));
            batches[function](&brdf, 1, ls, vs, one);
            assert_same_bits(*one, scalars[function](&same, l, v));
        }
        k->value_float_batch(&brdf, 1, lfs, vfs, &one_float);
        k->value_float_batch(&same, 1, lfs, vfs, &other_float);
        assert_memory_equal(&one_float, &other_float, sizeof one_float);
        assert_same_sample(k->sample_ward(&brdf, v, s, s), k->sample_ward(&same, v, s, s));
        assert_same_sample(k->sample_pair(&brdf, v, s, s, s), k->sample_pair(&same, v, s, s, s));
        k->sample_ward_batch(&brdf, 1, vs, &s, &s, to_one);
        k->sample_ward_batch(&same, 1, vs, &s, &s, to_other);
        assert_memory_equal(one, other, sizeof one);
        k->sample_pair_batch(&brdf, 1, vs, &s, &s, &s, to_one);
        k->sample_pair_batch(&same, 1, vs, &s, &s, &s, to_other);
        assert_memory_equal(one, other, sizeof one);
    }
    brdf_slope_plane plane;
    brdf_slope_plane_prepare(&plane, &brdf, v);
    double albedo = graze_brdf_albedo(&same, v);
    assert_true(fabs(brdf_albedo_over_slopes(brdf.model, &plane, v.z) - albedo) < 1e-6);
    assert_true(fabs(brdf_albedo_over_directions(&brdf, v) - albedo) < 1e-9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(special_vectors),
        cmocka_unit_test(not_numbers_reflect_nothing),
        cmocka_unit_test(lengths_are_powers_of_two),
        cmocka_unit_test(reciprocity_to_the_bit),
        cmocka_unit_test(samples_at_the_edges),
        cmocka_unit_test(nothing_is_minus_zero),
        cmocka_unit_test(too_large_is_the_largest_double),
        cmocka_unit_test(lobes_out_of_range),
        cmocka_unit_test(no_model_is_ward_neumann_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
