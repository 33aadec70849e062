/* Fits around a point: exact where they can be, honest about chance, and aware of edges. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "picture/local_fit.h"
#include "support/dice.h"

enum { SIDE = 7, MOST = SIDE * SIDE };

/* A grid of steps of 1/3 whose middle is off the point, with weights that end at a distance of 1. */
static int lay(double off_x, double off_y, local_fit_value values[MOST]) {
    int count = 0;
    for (int i = 0; i < MOST; i++) {
        double x = (i % SIDE - SIDE / 2) / 3.0 + off_x, y = (i / SIDE - SIDE / 2) / 3.0 + off_y;
        double rest = 1 - x * x - y * y;
        if (rest > 0)
            values[count++] = (local_fit_value){.x = x, .y = y, .weight = rest * rest};
    }
    return count;
}

static double bowl(double x, double y) {
    return 3 + 0.7 * x - 0.4 * y + 0.5 * x * x - 0.3 * x * y + 0.2 * y * y;
}

static void paraboloids_are_found_exactly(void **state) {
    (void)state;
    local_fit_value values[MOST];
    double shares[MOST], sum = 0, value = 0;
    int count = lay(0.1, -0.05, values);
    for (int i = 0; i < count; i++)
        values[i].value = (rgb){bowl(values[i].x, values[i].y), 1, 0};
    local_fit found;
    assert_true(local_fit_find(values, count, &found, shares));
    for (int i = 0; i < count; i++) {
        sum += shares[i];
        value += shares[i] * values[i].value.r;
    }
    assert_true(fabs(found.value.r - 3) < 1e-12 && fabs(found.value.g - 1) < 1e-12 && fabs(found.value.b) < 1e-12);
    assert_true(fabs(found.slope_x.r - 0.7) < 1e-12 && fabs(found.slope_y.r + 0.4) < 1e-12);
    assert_true(fabs(sum - 1) < 1e-12 && fabs(value - 3) < 1e-12);
    /* That the value is more than a plane's is told. */
    assert_true(found.error.r > 0.01 && found.error.g < 1e-12);
}

/* In the midst and at the border of the values. */
static void chance_is_stated(void **state) {
    (void)state;
    enum { TRIALS = 4000 };
    dice d = {7};
    for (int border = 0; border < 2; border++) {
        int within = 0;
        double stated = 0, squares = 0;
        for (int t = 0; t < TRIALS; t++) {
            local_fit_value values[MOST];
            double shares[MOST];
            int count = lay(border * 0.5, 0.1, values);
            for (int i = 0; i < count; i++)
                values[i].value =
                    rgb_gray(1 + 0.2 * values[i].x + 0.1 * (roll_between(&d, -1, 1) + roll_between(&d, -1, 1)));
            local_fit found;
            assert_true(local_fit_find(values, count, &found, shares));
            within += fabs(found.value.g - 1) <= 1.96 * found.error.g;
            squares += (found.value.g - 1) * (found.value.g - 1) / TRIALS;
            stated += found.error.g * found.error.g / TRIALS;
        }
        if (within < 0.945 * TRIALS || stated > 3 * squares)
            fail_msg("%d of %d are within; variance %g, stated %g", within, TRIALS, squares, stated);
    }
}

/* A step of 1, wherever it lies in the inner half, is never taken for something smooth. */
static void edges_are_noticed(void **state) {
    (void)state;
    for (int k = -10; k <= 10; k++) {
        local_fit_value values[MOST];
        double shares[MOST], edge = 0.05 * k + 0.001;
        int count = lay(0, 0, values);
        for (int i = 0; i < count; i++)
            values[i].value = rgb_gray(values[i].x < edge ? 1 : 2);
        local_fit found;
        assert_true(local_fit_find(values, count, &found, shares));
        double truth = 0 < edge ? 1 : 2;
        if (found.error.g < 0.03 || fabs(found.value.g - truth) > 6 * found.error.g)
            fail_msg("edge at %g: %g +- %g", edge, found.value.g, found.error.g);
    }
}

static void too_little_says_nothing(void **state) {
    (void)state;
    local_fit_value values[MOST];
    double shares[MOST];
    local_fit found;
    assert_true(lay(0, 0, values) > 11);
    assert_false(local_fit_find(values, 0, &found, shares));
    assert_false(local_fit_find(values, 11, &found, shares));
    /* All on a line, or on two. */
    for (int lines = 1; lines <= 2; lines++) {
        for (int i = 0; i < 20; i++)
            values[i] = (local_fit_value){
                .x = (i - 10) / 10.0, .y = (i % lines) * 0.3 + 0.5 * (i - 10) / 10.0, .weight = 1, .value = {1, 1, 1}};
        assert_false(local_fit_find(values, 20, &found, shares));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paraboloids_are_found_exactly),
        cmocka_unit_test(chance_is_stated),
        cmocka_unit_test(edges_are_noticed),
        cmocka_unit_test(too_little_says_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
