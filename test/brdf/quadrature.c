/* Adaptive quadrature: integrals known in closed form, smooth, with roots at ends, with steps, and one that is
 * infinite. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "brdf/common.h"
#include "brdf/quadrature.h"

static double integrate(brdf_integrand *function, double power, double low, double high) {
    return brdf_integrate(function, &power, low, high, &brdf_no_points, BRDF_ENDS_ROOTS);
}

static double power_of(const void *context, double x) {
    return pow(x, *(const double *)context);
}

static void powers(void **state) {
    (void)state;
    for (double p = -.5; p < 20; p += .5)
        assert_true(fabs(integrate(power_of, p, 0, 2) * (p + 1) / pow(2, p + 1) - 1) < 1e-9);
    assert_true(integrate(power_of, 1, 1, 1) == 0);
}

/* The rule itself, which is exact up to a degree of 46; with roots at ends, x^n is of degree 3n + 2. */
static void polynomials_are_exact(void **state) {
    (void)state;
    for (double p = 0; p <= 46; ++p) {
        assert_true(fabs(brdf_integrate(power_of, &p, 0, 1, &brdf_no_points, BRDF_ENDS_SMOOTH) * (p + 1) - 1) < 1e-14);
        if (p <= 14)
            assert_true(fabs(integrate(power_of, p, 0, 1) * (p + 1) - 1) < 1e-14);
    }
}

static double narrow_peak(const void *context, double x) {
    double width = *(const double *)context;
    return width / (width * width + (x - .3) * (x - .3));
}

static void narrow_peaks(void **state) {
    (void)state;
    for (double width = 1; width > 1e-6; width /= 10) {
        double exact = atan(.7 / width) + atan(.3 / width);
        assert_true(fabs(integrate(narrow_peak, width, 0, 1) / exact - 1) < 1e-9);
    }
}

static double peak_at_zero(const void *context, double x) {
    double width = *(const double *)context;
    return width / (width * width + x * x);
}

/* It takes as many halvings, always of the half next to the peak, as a width has bits. */
static void peaks_at_either_end(void **state) {
    (void)state;
    for (double width = 0x1p-10; width > 0x1p-36; width /= 4) {
        double after = brdf_integrate(peak_at_zero, &width, 0, 1, &brdf_no_points, BRDF_ENDS_SMOOTH);
        double before = brdf_integrate(peak_at_zero, &width, -1, 0, &brdf_no_points, BRDF_ENDS_SMOOTH);
        assert_true(fabs(after / atan(1 / width) - 1) < 1e-9);
        assert_true(fabs(before / atan(1 / width) - 1) < 1e-9 + 0x1p-53 / width); /* x has rounding errors there */
    }
}

typedef struct scaled_peak {
    double scale, width;
} scaled_peak;

static double scaled(const void *context, double x) {
    const scaled_peak *p = context;
    return p->scale * narrow_peak(&p->width, x);
}

/* Accuracy is relative: a function however small is halved as often. */
static void size_does_not_matter(void **state) {
    (void)state;
    for (int power = -900; power <= 900; power += 300) {
        const scaled_peak small = {ldexp(1, power), 1e-4}, unit = {1, 1e-4};
        double expected = ldexp(brdf_integrate(scaled, &unit, 0, 1, &brdf_no_points, BRDF_ENDS_ROOTS), power);
        assert_true(brdf_integrate(scaled, &small, 0, 1, &brdf_no_points, BRDF_ENDS_ROOTS) == expected);
    }
}

static double step(const void *context, double x) {
    return x < *(const double *)context ? 1 : 3;
}

static void points_cut_the_integral(void **state) {
    (void)state;
    double at = 1. / 3;
    brdf_points points = brdf_no_points;
    brdf_points_add(&points, 5);
    brdf_points_add(&points, -1);
    brdf_points_add(&points, at);
    brdf_points_add(&points, at);
    assert_int_equal(points.count, 4);
    assert_true(points.at[0] == -1 && points.at[1] == at && points.at[2] == at && points.at[3] == 5);
    assert_true(fabs(brdf_integrate(step, &at, 0, 1, &points, BRDF_ENDS_ROOTS) - 7. / 3) < 1e-14);
    assert_true(fabs(integrate(step, at, 0, 1) - 7. / 3) < 1e-9); /* found by halving */
}

/* Halving ends where there is nothing to be gained. */
static void infinite_integrals_end(void **state) {
    (void)state;
    assert_true(integrate(power_of, -1, 0, 1) > 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers),
        cmocka_unit_test(polynomials_are_exact),
        cmocka_unit_test(narrow_peaks),
        cmocka_unit_test(peaks_at_either_end),
        cmocka_unit_test(size_does_not_matter),
        cmocka_unit_test(points_cut_the_integral),
        cmocka_unit_test(infinite_integrals_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
