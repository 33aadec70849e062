/* Arrays of pairs: every instruction set, length and alignment gives the bits that one pair by itself gives. */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "brdf/common.h"
#include "brdf/kernel_tables.h"
#include "graze/brdf_batch.h"

enum { COUNT = 1000, FUNCTIONS = 5, GUARD = 8 };

/* Components of all pairs: those of l, then those of v. */
static double pairs[6][COUNT + GUARD];
static float float_pairs[6][COUNT + GUARD];

static const double roughnesses[] = {GRAZE_ROUGHNESS_MIN, 1e-3, .1, .2, 1, GRAZE_ROUGHNESS_MAX};
enum { ROUGHNESSES = sizeof roughnesses / sizeof *roughnesses };

static graze_vec3_arrays arrays_from(int first, int offset) {
    return (graze_vec3_arrays){pairs[first] + offset, pairs[first + 1] + offset, pairs[first + 2] + offset};
}
static graze_vec3_float_arrays float_arrays_from(int first, int offset) {
    return (graze_vec3_float_arrays){float_pairs[first] + offset, float_pairs[first + 1] + offset,
                                     float_pairs[first + 2] + offset};
}
static graze_vec3 vector_at(int first, int i) {
    return (graze_vec3){pairs[first][i], pairs[first + 1][i], pairs[first + 2][i]};
}

static void put_pair(int i, graze_vec3 l, graze_vec3 v) {
    const double components[6] = {l.x, l.y, l.z, v.x, v.y, v.z};
    for (int k = 0; k < 6; ++k) {
        pairs[k][i] = components[k];
        float_pairs[k][i] = (float)(fabs(components[k]) <= FLT_MAX ? components[k] : copysign(HUGE_VAL, components[k]));
    }
}

/* Directions, some next to the horizon or below it. */
static void draw_pairs(const graze_brdf *brdf, uint64_t seed, double least_cosine) {
    for (int i = 0; i < COUNT + GUARD; ++i) {
        graze_vec3 v = direction(draw_power(&seed, least_cosine, 1), draw_between(&seed, 0, 2 * pi));
        graze_vec3 l = graze_brdf_sample_ward(brdf, v, draw(&seed), draw(&seed)).l;
        if (i % 16 == 0)
            l = direction(draw_power(&seed, least_cosine, 1), draw_between(&seed, 0, 2 * pi));
        if (i % 64 == 1)
            l.z = -l.z;
        put_pair(i, l, v);
    }
}

/* What is a direction, what is none, and what is no number. */
static void draw_odd_pairs(uint64_t seed) {
    const double components[] = {0,     -0.0,  5e-324, -1e-310, DBL_MIN, 1e-300,   1e-150,   -1e-75,    1e-45, 1e-38,
                                 1e-20, -1e-8, .5,     -.7,     1,       -1,       1e5,      1e17,      -1e19, 1e38,
                                 1e39,  1e77,  -1e160, 1e300,   DBL_MAX, -DBL_MAX, HUGE_VAL, -HUGE_VAL, NAN};
    enum { KINDS = sizeof components / sizeof *components };
    for (int i = 0; i < COUNT + GUARD; ++i) {
        double c[6];
        for (int k = 0; k < 6; ++k) {
            c[k] = components[(int)(draw(&seed) * KINDS)];
            if (k % 3 == 2 && i % 8 != 0)
                c[k] = fabs(c[k]);
            if (i % 4 == 3 && k < 2 && draw(&seed) < .5)
                c[k] = -c[k + 3];
        }
        put_pair(i, (graze_vec3){c[0], c[1], c[2]}, (graze_vec3){c[3], c[4], c[5]});
    }
}

static brdf_batch_function *batch_of(const brdf_kernels *t, int function) {
    brdf_batch_function *const functions[FUNCTIONS] = {t->value_batch, t->ward_density_batch, t->ward_weight_batch,
                                                       t->pair_density_batch, t->pair_weight_batch};
    return functions[function];
}
static brdf_scalar_function *scalar_of(const brdf_kernels *t, int function) {
    brdf_scalar_function *const functions[FUNCTIONS] = {t->value, t->ward_density, t->ward_weight, t->pair_density,
                                                        t->pair_weight};
    return functions[function];
}
static brdf_scalar_function *const public_scalar[FUNCTIONS] = {
    graze_brdf_value, graze_brdf_ward_density, graze_brdf_ward_weight, graze_brdf_pair_density, graze_brdf_pair_weight};
static brdf_batch_function *const public_batch[FUNCTIONS] = {
    graze_brdf_value_batch, graze_brdf_ward_density_batch, graze_brdf_ward_weight_batch, graze_brdf_pair_density_batch,
    graze_brdf_pair_weight_batch};
static brdf_float_batch_function *const public_float_batch[FUNCTIONS] = {
    graze_brdf_value_float_batch, graze_brdf_ward_density_float_batch, graze_brdf_ward_weight_float_batch,
    graze_brdf_pair_density_float_batch, graze_brdf_pair_weight_float_batch};

/* All instruction sets, scalar and batch, at the pairs there are; every result is a number and not below zero. */
static void check_all(const graze_brdf *brdf) {
    static double expected[COUNT], result[COUNT];
    static float float_expected[COUNT], float_result[COUNT];
    const brdf_kernels *tables[KERNEL_TABLES_MOST];
    int count = kernel_tables_available(tables);
    for (int function = 0; function < FUNCTIONS; ++function) {
        for (int i = 0; i < COUNT; ++i) {
            expected[i] = public_scalar[function](brdf, vector_at(0, i), vector_at(3, i));
            assert_true(expected[i] >= 0 && expected[i] <= DBL_MAX);
        }
        public_batch[function](brdf, COUNT, arrays_from(0, 0), arrays_from(3, 0), result);
        assert_memory_equal(result, expected, sizeof result);
        for (int t = 0; t < count; ++t) {
            batch_of(tables[t], function)(brdf, COUNT, arrays_from(0, 0), arrays_from(3, 0), result);
            assert_memory_equal(result, expected, sizeof result);
            for (int i = 0; i < COUNT; ++i)
                result[i] = scalar_of(tables[t], function)(brdf, vector_at(0, i), vector_at(3, i));
            assert_memory_equal(result, expected, sizeof result);
        }
        public_float_batch[function](brdf, COUNT, float_arrays_from(0, 0), float_arrays_from(3, 0), float_expected);
        for (int i = 0; i < COUNT; ++i)
            assert_true(float_expected[i] >= 0 && float_expected[i] <= FLT_MAX);
    }
    tables[count - 1]->value_float_batch(brdf, COUNT, float_arrays_from(0, 0), float_arrays_from(3, 0), float_expected);
    for (int t = 0; t < count; ++t) {
        tables[t]->value_float_batch(brdf, COUNT, float_arrays_from(0, 0), float_arrays_from(3, 0), float_result);
        assert_memory_equal(float_result, float_expected, sizeof float_result);
    }
}

static void every_instruction_set_gives_the_same_bits(void **state) {
    (void)state;
    for (int a = 0; a < ROUGHNESSES * ROUGHNESSES; ++a) {
        const graze_brdf brdf = {(graze_brdf_model)(a % 4), roughnesses[a / ROUGHNESSES], roughnesses[a % ROUGHNESSES]};
        draw_pairs(&brdf, (uint64_t)a, a % 3 ? 1e-3 : 1e-150);
        check_all(&brdf);
    }
}

static void odd_pairs_too(void **state) {
    (void)state;
    for (int a = 0; a < ROUGHNESSES * ROUGHNESSES; ++a)
        for (int model = 0; model < GRAZE_BRDF_MODEL_COUNT; ++model) {
            const graze_brdf brdf = {(graze_brdf_model)model, roughnesses[a / ROUGHNESSES],
                                     roughnesses[a % ROUGHNESSES]};
            draw_odd_pairs((uint64_t)(a + 100));
            check_all(&brdf);
        }
}

/* No more than asked for is written, wherever arrays begin. */
static void every_length_and_alignment(void **state) {
    (void)state;
    const brdf_kernels *tables[KERNEL_TABLES_MOST];
    int count = kernel_tables_available(tables);
    for (int model = 0; model < GRAZE_BRDF_MODEL_COUNT; ++model) {
        const graze_brdf brdf = {(graze_brdf_model)model, .2, .3};
        draw_pairs(&brdf, 7, 1e-20);
        for (int function = 0; function < FUNCTIONS; ++function) {
            double expected[COUNT];
            float float_expected[COUNT];
            public_batch[function](&brdf, COUNT, arrays_from(0, 0), arrays_from(3, 0), expected);
            public_float_batch[function](&brdf, COUNT, float_arrays_from(0, 0), float_arrays_from(3, 0),
                                         float_expected);
            for (int length = 0; length <= 70; ++length)
                for (int offset = 0; offset < 16; ++offset) {
                    double result[70 + 16 + GUARD];
                    float float_result[70 + 16 + GUARD];
                    for (int t = 0; t < count; ++t) {
                        memset(result, 0x55, sizeof result);
                        batch_of(tables[t], function)(&brdf, (size_t)length, arrays_from(0, offset),
                                                      arrays_from(3, offset), result + offset);
                        assert_memory_equal(result + offset, expected + offset, (size_t)length * sizeof *result);
                        memset(result + offset, 0x55, (size_t)length * sizeof *result);
                        for (unsigned char *p = (unsigned char *)result; p < (unsigned char *)result + sizeof result;
                             ++p)
                            assert_int_equal(*p, 0x55);
                        if (function > 0)
                            continue;
                        tables[t]->value_float_batch(&brdf, (size_t)length, float_arrays_from(0, offset),
                                                     float_arrays_from(3, offset), float_result);
                        assert_memory_equal(float_result, float_expected + offset,
                                            (size_t)length * sizeof *float_result);
                    }
                    memset(float_result, 0x55, sizeof float_result);
                    public_float_batch[function](&brdf, (size_t)length, float_arrays_from(0, offset),
                                                 float_arrays_from(3, offset), float_result + offset);
                    assert_memory_equal(float_result + offset, float_expected + offset,
                                        (size_t)length * sizeof *float_result);
                    memset(float_result + offset, 0x55, (size_t)length * sizeof *float_result);
                    for (unsigned char *p = (unsigned char *)float_result;
                         p < (unsigned char *)float_result + sizeof float_result; ++p)
                        assert_int_equal(*p, 0x55);
                }
        }
    }
}

/* But for the value, floats are what the double functions give for them, rounded. */
static void float_densities_and_weights_are_rounded_double_ones(void **state) {
    (void)state;
    static float result[COUNT];
    for (int model = 0; model < GRAZE_BRDF_MODEL_COUNT; ++model) {
        const graze_brdf brdf = {(graze_brdf_model)model, 1e-6, .1};
        draw_pairs(&brdf, (uint64_t)model, 1e-20);
        for (int function = 1; function < FUNCTIONS; ++function) {
            public_float_batch[function](&brdf, COUNT, float_arrays_from(0, 0), float_arrays_from(3, 0), result);
            for (int i = 0; i < COUNT; ++i) {
                graze_vec3 l = {float_pairs[0][i], float_pairs[1][i], float_pairs[2][i]};
                graze_vec3 v = {float_pairs[3][i], float_pairs[4][i], float_pairs[5][i]};
                double wide = public_scalar[function](&brdf, l, v);
                assert_true(result[i] == (wide < FLT_MAX ? (float)wide : FLT_MAX));
            }
        }
    }
}

static void assert_same_bits(double a, double b) {
    assert_memory_equal(&a, &b, sizeof a);
}

/* Exchanging l and v, or x and y together with their roughness, changes no bit. */
static void exchanges_leave_every_bit(void **state) {
    (void)state;
    static float one[COUNT], other[COUNT];
    for (int a = 0; a < ROUGHNESSES * ROUGHNESSES; ++a)
        for (int model = 0; model < GRAZE_BRDF_MODEL_COUNT; ++model) {
            const graze_brdf brdf = {(graze_brdf_model)model, roughnesses[a / ROUGHNESSES],
                                     roughnesses[a % ROUGHNESSES]};
            const graze_brdf turned = {brdf.model, brdf.alpha_y, brdf.alpha_x};
            draw_pairs(&brdf, (uint64_t)a, a % 2 ? 1e-3 : 1e-150);
            for (int i = 0; i < COUNT; ++i) {
                graze_vec3 l = vector_at(0, i), v = vector_at(3, i), ly = {l.y, l.x, l.z}, vy = {v.y, v.x, v.z};
                assert_same_bits(graze_brdf_value(&brdf, l, v), graze_brdf_value(&brdf, v, l));
                for (int function = 0; function < FUNCTIONS; ++function)
                    assert_same_bits(public_scalar[function](&brdf, l, v), public_scalar[function](&turned, ly, vy));
            }
            graze_vec3_float_arrays l = float_arrays_from(0, 0), v = float_arrays_from(3, 0);
            graze_vec3_float_arrays ly = {l.y, l.x, l.z}, vy = {v.y, v.x, v.z};
            graze_brdf_value_float_batch(&brdf, COUNT, l, v, one);
            graze_brdf_value_float_batch(&brdf, COUNT, v, l, other);
            assert_memory_equal(one, other, sizeof one);
            graze_brdf_value_float_batch(&turned, COUNT, ly, vy, other);
            assert_memory_equal(one, other, sizeof one);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_instruction_set_gives_the_same_bits),
        cmocka_unit_test(odd_pairs_too),
        cmocka_unit_test(every_length_and_alignment),
        cmocka_unit_test(float_densities_and_weights_are_rounded_double_ones),
        cmocka_unit_test(exchanges_leave_every_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
