/* Rows reduced to a triangle: lengths and angles of columns, however the rows come. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fit/triangle.h"

enum { ROWS = 1000, COLUMNS = FIT_TRIANGLE_COLUMNS_MAX };

static double rows[COLUMNS][ROWS];

static double uniform(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) * 0x1p-53;
}

static void fill(double scale) {
    uint64_t state = 1;
    for (int k = 0; k < COLUMNS; k++)
        for (int i = 0; i < ROWS; i++)
            rows[k][i] = scale * (uniform(&state) - .3) * (k + 1);
}

/* The rows in pieces of `piece` and, at the end, what is left. */
static fit_triangle reduce(int columns, size_t piece) {
    double copy[COLUMNS][ROWS], *at[COLUMNS];
    fit_triangle t = {.columns = columns};
    memcpy(copy, rows, sizeof copy);
    for (size_t first = 0; first < ROWS; first += piece) {
        for (int k = 0; k < columns; k++)
            at[k] = copy[k] + first;
        fit_triangle_add(&t, at, ROWS - first < piece ? ROWS - first : piece);
    }
    return t;
}

static long double product(int a, int b) {
    long double sum = 0;
    for (int i = 0; i < ROWS; i++)
        sum += (long double)rows[a][i] * rows[b][i];
    return sum;
}

/* R'R = A'A. */
static void assert_same_products(const fit_triangle *t) {
    for (int a = 0; a < t->columns; a++)
        for (int b = 0; b <= a; b++) {
            long double sum = 0, bound = 1e-14L * sqrtl(product(a, a) * product(b, b));
            for (int i = 0; i < t->columns; i++)
                sum += (long double)t->r[i][a] * t->r[i][b];
            assert_true(fabsl(sum - product(a, b)) <= bound);
            assert_true(a == b || t->r[a][b] == 0);
        }
}

static void lengths_and_angles_stay(void **state) {
    (void)state;
    static const double scales[] = {1, 1e-140, 1e146};
    for (size_t s = 0; s < sizeof scales / sizeof *scales; s++) {
        fill(scales[s]);
        for (int columns = 1; columns <= COLUMNS; columns++)
            for (size_t piece = 1; piece <= ROWS; piece = 3 * piece + 1) {
                fit_triangle t = reduce(columns, piece);
                assert_same_products(&t);
            }
    }
}

/* What is nearly parallel stays apart, which it would not in A'A. */
static void small_angles_stay(void **state) {
    (void)state;
    fill(1);
    for (int i = 0; i < ROWS; i++) {
        rows[0][i] = 1;
        rows[1][i] = 1 + (i % 2 ? 0x1p-30 : -0x1p-30);
    }
    fit_triangle t = reduce(2, 64);
    assert_true(fabs(fabs(t.r[1][1]) / (sqrt(ROWS) * 0x1p-30) - 1) < 1e-5);
}

static void columns_of_zeros_stay(void **state) {
    (void)state;
    fill(1);
    memset(rows[0], 0, sizeof rows[0]);
    memset(rows[2], 0, sizeof rows[2]);
    fit_triangle t = reduce(COLUMNS, 64);
    for (int i = 0; i < COLUMNS; i++)
        assert_true(t.r[i][0] == 0 && t.r[i][2] == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lengths_and_angles_stay),
        cmocka_unit_test(small_angles_stay),
        cmocka_unit_test(columns_of_zeros_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
