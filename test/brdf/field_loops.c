/* What integrals along outlines are made of: elementary functions against libm, Gauss's rules against the integrals of
 * powers, and that no result depends on the instruction set. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <string.h>

#include "brdf/common.h"
#include "brdf/field_loops.h"
#include "brdf/kernel_tables.h"
#include "brdf/panel_kernels.h"

static void exponential(void **state) {
    (void)state;
    uint64_t seed = 71;
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
        double x = i % 2 ? draw_between(&seed, -60, 0) : -draw_power(&seed, 1e-20, 60);
        worst = fmax(worst, fabs(field_exp(x) / exp(x) - 1));
    }
    if (!(worst <= 1.1e-12 && worst > 9e-13))
        fail_msg("exponentials are %g off", worst);
    assert_true(field_exp(0) == 1);
    static const double beyond[] = {-60.0001, -60.5, -1000, -1e300, -INFINITY};
    for (int i = 0; i < 5; ++i)
        assert_true(fabs(field_exp(beyond[i]) / exp(-60) - 1) < 2e-12);
}

/* erfc is as precise as exp(y^2), to 1e-14, as far as 7.5. */
static void complement(void **state) {
    (void)state;
    double worst = 0;
    for (int i = 0; i <= 100000; ++i) {
        double y = 7.5e-5 * i, s = 1.4 * ((y - 3) / (y + 3)) + .4;
        worst = fmax(worst, fabs(field_erfcx(s) / (exp(y * y) * erfc(y)) - 1));
    }
    if (!(worst <= 2e-12 && worst > 1e-12))
        fail_msg("complements are %g off", worst);
    double last = exp(7.5 * 7.5) * erfc(7.5);
    assert_true(fabs(field_erfcx(1.1) / last - 1) < 3e-12 && fabs(field_erfcx(1.8) / last - 1) < 3e-12);
}

static void gauss_rules(void **state) {
    (void)state;
    int begin = 0;
    for (int n = 4; n <= BRDF_MOST_GAUSS_POINTS; n += 4) {
        assert_int_equal(brdf_gauss_rule(n), begin);
        for (int power = 0; power < 2 * n; ++power) {
            double sum = 0;
            for (int i = begin; i < begin + n; ++i)
                sum += brdf_gauss_weights[i] * pow(brdf_gauss_points[i], power);
            double error = fabs((power + 1) * sum - 1);
            if (!(error < 4e-15))
                fail_msg("%d points give the integral of the power %d with an error of %g", n, power, error);
        }
        begin += n;
    }
    assert_int_equal(begin, BRDF_GAUSS_RULES);
}

static brdf_piece draw_piece(uint64_t *seed) {
    brdf_piece piece = {.points = 4 + 4 * (int)(4 * draw(seed)), .is_edge = draw(seed) < .5};
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 3; ++k)
            piece.polynomials[i][k] = draw_between(seed, -1, 1);
    piece.polynomials[2][0] = 3; /* C, or z */
    return piece;
}

static void instruction_sets(void **state) {
    (void)state;
    const brdf_kernels *tables[KERNEL_TABLES_MOST];
    int available = kernel_tables_available(tables);
    uint64_t seed = 72;
    for (int i = 0; i < 1000; ++i) {
        const brdf_lobe_field field = {.lean = draw(&seed),
                                       .aa = draw(&seed),
                                       .ab = draw_between(&seed, -1, 1),
                                       .bb = draw(&seed),
                                       .a_of_x = draw_between(&seed, -9, 9),
                                       .a_of_y = draw_between(&seed, -9, 9),
                                       .a_of_d = draw(&seed),
                                       .b_of_x = draw_between(&seed, -9, 9),
                                       .b_of_y = draw_between(&seed, -9, 9),
                                       .b_of_d = draw_between(&seed, -1, 1),
                                       .c_of_d = draw(&seed),
                                       .side = i % 2 ? 1 : -1};
        brdf_piece pieces[BRDF_MOST_PIECES];
        int count = (int)(draw(&seed) * (BRDF_MOST_PIECES + 1));
        for (int k = 0; k < count; ++k)
            pieces[k] = draw_piece(&seed);
        double first = field_along_pieces(&field, pieces, count);
        assert_true(isfinite(first) && (first != 0) == (count > 0));
        for (int k = 0; k < available; ++k) {
            double other = tables[k]->field_along_pieces(&field, pieces, count);
            assert_memory_equal(&other, &first, sizeof first);
        }
    }
}

/* The same of panels: small ones, large ones, and some that are not wholly above the surface. */
static void panels(void **state) {
    (void)state;
    const brdf_kernels *tables[KERNEL_TABLES_MOST];
    int available = kernel_tables_available(tables), fit = 0;
    uint64_t seed = 73;
    for (int i = 0; i < 20000; ++i) {
        const double size = draw_power(&seed, 1e-3, 1);
        const graze_vec3 point = {draw(&seed), draw(&seed), draw(&seed)}, normal = {0, .6, .8};
        graze_vec3 corners[4];
        for (int k = 0; k < 4; ++k)
            corners[k] = (graze_vec3){size * (k == 1 || k == 2) + draw(&seed) / 9, size * (k >= 2) + draw(&seed) / 9,
                                      1 + draw(&seed)};
        double first = 0;
        bool done = panel(point, normal, corners, &first);
        fit += done;
        for (int k = 0; k < available; ++k) {
            double other = 0;
            assert_int_equal(tables[k]->panel(point, normal, corners, &other), done);
            assert_memory_equal(&other, &first, sizeof first);
        }
    }
    assert_true(fit > 2000 && fit < 18000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exponential),      cmocka_unit_test(complement), cmocka_unit_test(gauss_rules),
        cmocka_unit_test(instruction_sets), cmocka_unit_test(panels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
