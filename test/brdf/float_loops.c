/* The polynomial of values in single precision: what its approximation takes off, beside the roundings. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "brdf/common.h"
#include "brdf/float_loops.h"

enum { COUNT = 1 << 16, PIECES = 64 };

/* That of float_loops.h, 2^-28.3, in units of 2^-24. */
static const double approximation = .051;

/* The mean of COUNT roundings, none of them far above 1/2, is nothing but for so much. */
static const double rest = .01;

/* Relative errors of p(f) = 2 x 2^f in units of 2^-24, for f drawn from a piece of [-1/2, 1/2]: their mean. */
static double mean_error(int piece, uint64_t *seed) {
    static float f[COUNT], one[COUNT], p[COUNT];
    double sum = 0;
    for (int i = 0; i < COUNT; ++i) {
        f[i] = (float)((piece + draw(seed)) / PIECES - .5);
        one[i] = 1;
    }
    float_products(COUNT, one, one, f, one, p); /* a product with 1 is exact */
    for (int i = 0; i < COUNT; ++i)
        sum += p[i] / (2 * exp2(f[i])) - 1;
    return sum / COUNT * 0x1p24;
}

static void the_approximation_is_as_good_as_said(void **state) {
    (void)state;
    uint64_t seed = 71;
    double worst = 0;
    for (int piece = 0; piece < PIECES; ++piece)
        worst = fmax(worst, fabs(mean_error(piece, &seed)));
    assert_true(worst < approximation + rest && worst > approximation / 2);
    (void)value_float_batch; /* the rest of the header */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_approximation_is_as_good_as_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
