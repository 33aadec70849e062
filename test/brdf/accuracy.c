/* Value, densities and weights against arbitrary precision, in units in the last place, and the promises of brdf.h and
 * brdf_batch.h: the short form of `make accuracy`. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "accuracy/check.h"

/* Groups of pairs of each kind. */
static int groups(void) {
    return is_short_run() ? 20 : 300;
}

static void fail_where_broken(const accuracy_tally *t, const char *kind, const char *format, const double *bounds) {
    char text[CASE_TEXT];
    if (t->unlike > 0)
        fail_msg("%s pairs: the batch's %s is %a, not what the scalar function says, at %s", kind,
                 accuracy_rows[(int)t->first_unlike.ulps].name, t->first_unlike.result,
                 accuracy_text(&t->first_unlike.in, text));
    if (t->broken == 0)
        return;
    for (int row = 0; row < ROWS; ++row) {
        const accuracy_worst *worst = &t->worst[row];
        if (!(worst->ulps <= bounds[accuracy_rows[row].function]))
            fail_msg("%s pairs, %s: %s is %g ulp off: %a at %s", kind, format, accuracy_rows[row].name, worst->ulps,
                     worst->result, accuracy_text(&worst->in, text));
    }
    fail_msg("%s pairs, %s: a result below the normal numbers is off", kind, format);
}

static void survey(accuracy_tally *t, const pair_kind *kind, bool in_float, uint64_t seed) {
    reference r;
    memset(t, 0, sizeof *t);
    reference_start(&r);
    for (int i = 0; i < groups(); ++i) {
        pair_group g;
        pairs_draw(&seed, kind, in_float ? 0x1.44p-100 : 1e-150, &g);
        if (in_float) {
            accuracy_round(&g);
            accuracy_check_float(&r, &g, PAIRS, t);
        } else {
            accuracy_check(&r, &g, PAIRS, t);
        }
    }
    reference_stop(&r);
}

/* Most results must be positive numbers in the normal range, or the test is about nothing. */
static void every_kind_of_pairs(bool in_float) {
    for (int kind = 0; kind < PAIR_KINDS; ++kind) {
        static accuracy_tally t;
        survey(&t, &pair_kinds[kind], in_float, (uint64_t)kind + (in_float ? 100 : 1));
        fail_where_broken(&t, pair_kinds[kind].name, in_float ? "float" : "double",
                          in_float ? accuracy_float_bound : accuracy_bound);
        for (int row = 0; row < ROWS; ++row)
            assert_true(t.results[row] > t.pairs / 10);
    }
}

static void pairs_in_double(void **state) {
    (void)state;
    every_kind_of_pairs(false);
}

static void pairs_in_float(void **state) {
    (void)state;
    every_kind_of_pairs(true);
}

static void replay(const char *path) {
    FILE *file = fopen(path, "r");
    assert_non_null(file); /* tests run at the root of the tree */
    static accuracy_tally in_double, in_float;
    memset(&in_double, 0, sizeof in_double);
    memset(&in_float, 0, sizeof in_float);
    reference r;
    char line[512];
    reference_start(&r);
    while (fgets(line, sizeof line, file)) {
        pair_group g;
        if (line[0] == '#')
            continue;
        assert_true(accuracy_read_case(line, &g));
        accuracy_check(&r, &g, 1, &in_double);
        if (accuracy_is_float(&g))
            accuracy_check_float(&r, &g, 1, &in_float);
    }
    reference_stop(&r);
    fclose(file);
    assert_true(in_double.pairs >= 20);
    fail_where_broken(&in_double, path, "double", accuracy_bound);
    fail_where_broken(&in_float, path, "float", accuracy_float_bound);
}

/* What `make accuracy` found last. */
static void worst_pairs(void **state) {
    (void)state;
    replay("test/accuracy/worst.txt");
}

static void hard_pairs(void **state) {
    (void)state;
    replay("test/accuracy/hard.txt");
}

/* Why all the trouble; and that errors are noticed. */
static void naive_formulas_lose_hundreds_of_ulps(void **state) {
    (void)state;
    static accuracy_tally t;
    for (int kind = 0; kind < PAIR_KINDS; ++kind) {
        if (strcmp(pair_kinds[kind].name, "tail") != 0)
            continue;
        survey(&t, &pair_kinds[kind], false, 3);
        for (int row = 0; row < ROWS; ++row)
            if (accuracy_rows[row].function == VALUE || accuracy_rows[row].function == WARD_DENSITY)
                assert_true(t.naive[row].ulps > 300 && t.naive_large[row] > t.pairs / 50);
    }
    assert_true(t.pairs > 0);
}

/* The reference with five times the bits says the same to 2^-60. */
static void reference_has_bits_enough(void **state) {
    (void)state;
    reference r;
    mpfr_t difference;
    uint64_t seed = 4;
    reference_start(&r);
    mpfr_init2(difference, REFERENCE_FINE_BITS);
    for (int i = 0; i < PAIR_KINDS * 10; ++i) {
        pair_group g;
        pairs_draw(&seed, &pair_kinds[i % PAIR_KINDS], 1e-150, &g);
        for (int k = 0; k < PAIRS; ++k) {
            const reference_case in = accuracy_case(&g, k);
            reference_evaluate_terms(&r.coarse, &in);
            reference_evaluate_terms(&r.fine, &in);
            assert_false(r.fine.doubtful);
            for (int row = 0; row < ROWS && !r.coarse.doubtful; ++row) {
                mpfr_ptr coarse = accuracy_exact(&r.coarse, &accuracy_rows[row]);
                mpfr_ptr fine = accuracy_exact(&r.fine, &accuracy_rows[row]);
                if (mpfr_cmp_ui_2exp(fine, 1, -2000) < 0)
                    continue; /* nothing is left of such in a double */
                mpfr_sub(difference, coarse, fine, MPFR_RNDN);
                mpfr_abs(difference, difference, MPFR_RNDN);
                mpfr_mul_2ui(difference, difference, 60, MPFR_RNDN);
                assert_true(mpfr_less_p(difference, fine) != 0);
            }
        }
    }
    mpfr_clear(difference);
    reference_stop(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(worst_pairs),
        cmocka_unit_test(hard_pairs),
        cmocka_unit_test(pairs_in_double),
        cmocka_unit_test(pairs_in_float),
        cmocka_unit_test(naive_formulas_lose_hundreds_of_ulps),
        cmocka_unit_test(reference_has_bits_enough),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
