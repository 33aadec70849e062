/* Sampling over arrays: the same bits as one sample at a time, from every instruction set, at every length and
 * alignment, whatever the arguments are. */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "brdf/common.h"
#include "brdf/kernel_tables.h"
#include "graze/brdf_batch.h"

enum { MOST = 300, ARGUMENTS = 6, RESULTS = 5 };

/* v, s, t, u */
typedef struct arguments {
    double of[ARGUMENTS][MOST];
} arguments;

typedef struct results {
    double of[RESULTS][MOST];
} results;

static graze_vec3_arrays view_of(const arguments *a, size_t from) {
    return (graze_vec3_arrays){a->of[0] + from, a->of[1] + from, a->of[2] + from};
}

static graze_brdf_sample_arrays arrays_of(results *r, size_t from) {
    return (graze_brdf_sample_arrays){r->of[0] + from, r->of[1] + from, r->of[2] + from, r->of[3] + from,
                                      r->of[4] + from};
}

static graze_vec3 view_at(const arguments *a, int i) {
    return (graze_vec3){a->of[0][i], a->of[1][i], a->of[2][i]};
}

static void fill(results *r, double x) {
    for (int k = 0; k < RESULTS; ++k)
        for (int i = 0; i < MOST; ++i)
            r->of[k][i] = x;
}

static void put(results *r, int i, graze_brdf_sample sample) {
    const double all[] = {sample.l.x, sample.l.y, sample.l.z, sample.density, sample.weight};
    for (int k = 0; k < RESULTS; ++k)
        r->of[k][i] = all[k];
}

static double draw_power_of_two(uint64_t *seed) {
    return ldexp(1 + draw(seed), (int)draw_between(seed, -1074, 0));
}

/* Directions, from all around to next to the surface; every fourth is a vector of numbers from all over. */
static arguments draw_arguments(uint64_t *seed, bool wild) {
    static const double special[] = {0,       -0.0,     5e-324,    -1e-310, DBL_MIN, 1e-300, 1e-150,      -1e-75,
                                     1e-20,   .5,       -.7,       1,       -1,      0x1p99, -0x1p101,    1e160,
                                     DBL_MAX, HUGE_VAL, -HUGE_VAL, NAN,     .25,     .75,    1 - 0x1p-53, 2};
    enum { SPECIAL = sizeof special / sizeof *special };
    arguments a;
    for (int i = 0; i < MOST; ++i) {
        double cosine = i % 4 == 0 ? draw_power_of_two(seed) : i % 4 == 1 ? draw_power(seed, 1e-9, 1) : draw(seed);
        graze_vec3 v = direction(fmin(cosine, 1), draw_between(seed, 0, 2 * pi));
        const double plain[] = {v.x, v.y, v.z, draw(seed), draw(seed), draw(seed)};
        for (int k = 0; k < ARGUMENTS; ++k) {
            a.of[k][i] = plain[k];
            if (wild && draw(seed) < .3)
                a.of[k][i] = draw(seed) < .5 ? special[(int)(draw(seed) * SPECIAL)] : draw_power_of_two(seed);
        }
    }
    return a;
}

static graze_brdf draw_brdf(uint64_t *seed) {
    graze_brdf brdf = {(graze_brdf_model)(draw(seed) * 4), draw_power(seed, 1e-6, 10), 0};
    brdf.alpha_y = draw(seed) < .3 ? brdf.alpha_x : draw_power(seed, 1e-6, 10);
    return brdf;
}

static void scalar_samples(results *r, const brdf_kernels *set, const graze_brdf *brdf, const arguments *a, bool pair) {
    for (int i = 0; i < MOST; ++i)
        put(r, i,
            pair ? set->sample_pair(brdf, view_at(a, i), a->of[3][i], a->of[4][i], a->of[5][i])
                 : set->sample_ward(brdf, view_at(a, i), a->of[3][i], a->of[4][i]));
}

static void batch_samples(results *r, const brdf_kernels *set, const graze_brdf *brdf, const arguments *a, size_t from,
                          size_t count, size_t to, bool pair) {
    if (pair)
        set->sample_pair_batch(brdf, count, view_of(a, from), a->of[3] + from, a->of[4] + from, a->of[5] + from,
                               arrays_of(r, to));
    else
        set->sample_ward_batch(brdf, count, view_of(a, from), a->of[3] + from, a->of[4] + from, arrays_of(r, to));
}

/* Arrays of any length, that begin anywhere, and nothing written but what was asked for. */
static void check_pieces(const brdf_kernels *set, const graze_brdf *brdf, const arguments *a, const results *expected,
                         bool pair, uint64_t *seed) {
    for (int i = 0; i < 40; ++i) {
        size_t from = (size_t)draw_between(seed, 0, 16), to = (size_t)draw_between(seed, 0, 16);
        size_t count = (size_t)(i < 20 ? i : draw_between(seed, 0, MOST - 16));
        static results made, wanted;
        fill(&made, 7);
        fill(&wanted, 7);
        for (int k = 0; k < RESULTS; ++k)
            memcpy(wanted.of[k] + to, expected->of[k] + from, count * sizeof(double));
        batch_samples(&made, set, brdf, a, from, count, to, pair);
        assert_memory_equal(&made, &wanted, sizeof made);
    }
}

static void every_instruction_set_gives_the_same_bits(void **state) {
    (void)state;
    const brdf_kernels *sets[KERNEL_TABLES_MOST];
    int count = kernel_tables_available(sets);
    uint64_t seed = 31;
    int accepted = 0, rejected = 0;
    for (int round = 0; round < 200; ++round) {
        static arguments a;
        static results expected, made;
        bool pair = round % 2 != 0, wild = round % 4 < 2;
        graze_brdf brdf = draw_brdf(&seed);
        a = draw_arguments(&seed, wild);
        scalar_samples(&expected, sets[0], &brdf, &a, pair);
        for (int k = 0; k < count; ++k) {
            scalar_samples(&made, sets[k], &brdf, &a, pair);
            assert_memory_equal(&made, &expected, sizeof made);
            batch_samples(&made, sets[k], &brdf, &a, 0, MOST, 0, pair);
            assert_memory_equal(&made, &expected, sizeof made);
            check_pieces(sets[k], &brdf, &a, &expected, pair, &seed);
        }
        for (int i = 0; i < MOST; ++i) {
            double density = expected.of[3][i], weight = expected.of[4][i];
            assert_true(isfinite(expected.of[0][i]) && isfinite(expected.of[1][i]) && isfinite(expected.of[2][i]));
            assert_true(density >= 0 && density <= DBL_MAX && weight >= 0 && weight <= DBL_MAX);
            accepted += weight > 0;
            rejected += weight == 0;
        }
    }
    assert_true(accepted > 20000 && rejected > 10000);
}

static void public_functions_are_those_of_the_best_set(void **state) {
    (void)state;
    uint64_t seed = 32;
    for (int round = 0; round < 40; ++round) {
        static results expected, made;
        graze_brdf brdf = draw_brdf(&seed);
        const arguments a = draw_arguments(&seed, round % 4 < 2);
        bool pair = round % 2 != 0;
        scalar_samples(&expected, brdf_kernels_best(), &brdf, &a, pair);
        for (int i = 0; i < MOST; ++i)
            put(&made, i,
                pair ? graze_brdf_sample_pair(&brdf, view_at(&a, i), a.of[3][i], a.of[4][i], a.of[5][i])
                     : graze_brdf_sample_ward(&brdf, view_at(&a, i), a.of[3][i], a.of[4][i]));
        assert_memory_equal(&made, &expected, sizeof made);
        fill(&made, 7);
        if (pair)
            graze_brdf_sample_pair_batch(&brdf, MOST, view_of(&a, 0), a.of[3], a.of[4], a.of[5], arrays_of(&made, 0));
        else
            graze_brdf_sample_ward_batch(&brdf, MOST, view_of(&a, 0), a.of[3], a.of[4], arrays_of(&made, 0));
        assert_memory_equal(&made, &expected, sizeof made);
    }
}

/* In single precision: the double result for the same arguments, rounded, or FLT_MAX; rejected where that makes l.z 0.
 */
static void float_samples_are_rounded_double_ones(void **state) {
    (void)state;
    static float narrow[ARGUMENTS][MOST], made[RESULTS][MOST];
    const graze_vec3_float_arrays view = {narrow[0], narrow[1], narrow[2]};
    const graze_brdf_sample_float_arrays arrays = {made[0], made[1], made[2], made[3], made[4]};
    const int lengths[] = {0, 1, 127, 128, 129, 256, MOST};
    enum { LENGTHS = sizeof lengths / sizeof *lengths };
    uint64_t seed = 33;
    int largest = 0;
    for (int round = 0; round < 60; ++round) {
        static results expected;
        graze_brdf brdf = draw_brdf(&seed);
        arguments a = draw_arguments(&seed, false);
        bool pair = round % 2 != 0;
        int length = lengths[round % LENGTHS];
        for (int k = 0; k < ARGUMENTS; ++k)
            for (int i = 0; i < MOST; ++i)
                a.of[k][i] = narrow[k][i] = (float)a.of[k][i];
        scalar_samples(&expected, brdf_kernels_best(), &brdf, &a, pair);
        for (int k = 0; k < RESULTS; ++k)
            for (int i = 0; i < MOST; ++i)
                made[k][i] = 7;
        if (pair)
            graze_brdf_sample_pair_float_batch(&brdf, (size_t)length, view, narrow[3], narrow[4], narrow[5], arrays);
        else
            graze_brdf_sample_ward_float_batch(&brdf, (size_t)length, view, narrow[3], narrow[4], arrays);
        for (int k = 0; k < RESULTS; ++k)
            for (int i = 0; i < MOST; ++i) {
                float rounded = expected.of[k][i] > FLT_MAX ? FLT_MAX : (float)expected.of[k][i];
                if (k > 2 && !((float)expected.of[2][i] > 0))
                    rounded = 0;
                largest += rounded == FLT_MAX;
                assert_true(made[k][i] == (i < length ? rounded : 7));
            }
    }
    assert_true(largest > 0);
}

/* A direction above the surface by less than any float is on it: rejected, without a density or weight. */
static void what_floats_have_at_the_horizon_is_rejected(void **state) {
    (void)state;
    enum { COUNT = 200 };
    float x[COUNT], y[COUNT], z[COUNT], s[COUNT], t[COUNT], made[RESULTS][COUNT];
    const graze_vec3_float_arrays view = {x, y, z};
    const graze_brdf_sample_float_arrays arrays = {made[0], made[1], made[2], made[3], made[4]};
    for (int i = 0; i < COUNT; ++i) {
        x[i] = 0;
        y[i] = 1;
        z[i] = 0x1p-149f;
        s[i] = 1 - (float)i * 0x1p-8f;
        t[i] = 0;
    }
    int in_double_alone = 0, accepted = 0;
    for (int round = 0; round < 8; ++round) {
        const graze_brdf brdf = {(graze_brdf_model)(round / 2), .1, .1};
        if (round % 2 != 0)
            graze_brdf_sample_pair_float_batch(&brdf, COUNT, view, s, t, s, arrays);
        else
            graze_brdf_sample_ward_float_batch(&brdf, COUNT, view, s, t, arrays);
        for (int i = 0; i < COUNT; ++i) {
            const graze_vec3 v = {x[i], y[i], z[i]};
            const graze_brdf_sample sample = round % 2 != 0 ? graze_brdf_sample_pair(&brdf, v, s[i], t[i], s[i])
                                                            : graze_brdf_sample_ward(&brdf, v, s[i], t[i]);
            in_double_alone += sample.weight > 0 && !(made[2][i] > 0);
            accepted += made[4][i] > 0;
            assert_true(made[2][i] > 0 || (made[3][i] == 0 && made[4][i] == 0));
        }
    }
    assert_true(in_double_alone > 0 && accepted > 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_instruction_set_gives_the_same_bits),
        cmocka_unit_test(public_functions_are_those_of_the_best_set),
        cmocka_unit_test(float_samples_are_rounded_double_ones),
        cmocka_unit_test(what_floats_have_at_the_horizon_is_rejected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
