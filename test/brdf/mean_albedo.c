/* Mean albedo of the hemisphere: against the mean of the directional albedo, closed forms in one variable, limits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "brdf/common.h"

static void assert_near(double a, double b, double relative) {
    if (!(fabs(a - b) <= relative * fabs(b)))
        fail_msg("%.17g is not %.17g", a, b);
}

/* By the definition: tanh-sinh over the cosine, the midpoint rule over a quarter of the azimuths. */
static double mean_of_albedos(const graze_brdf *brdf, int azimuths) {
    const double step = 1. / 14;
    double sum = 0;
    for (int i = -42; i <= 42; ++i) {
        double y = pi * sinh(step * i), from_low = 1 / (1 + exp(-y)), from_high = 1 / (1 + exp(y));
        double sine = sqrt(from_high * (1 + from_low)), around = 0;
        for (int k = 0; k < azimuths; ++k) {
            double azimuth = (k + .5) / azimuths * pi / 2;
            around += graze_brdf_albedo(brdf, (graze_vec3){sine * cos(azimuth), sine * sin(azimuth), from_low});
        }
        sum += step * pi * cosh(step * i) * from_low * from_high * 2 * from_low * around / azimuths;
    }
    return sum;
}

static void definition(void **state) {
    (void)state;
    static const double alphas[][2] = {{1e-6, 1e-6}, {.01, .01}, {.1, .1}, {.5, .5}, {2, 2},
                                       {10, 10},     {.2, .3},   {.5, .4}, {.6, 1},  {3, 2}};
    for (int i = 0; i < (is_short_run() ? 7 : 10); ++i)
        for (int model = 0; model < GRAZE_BRDF_MODEL_COUNT; ++model) {
            const graze_brdf brdf = {(graze_brdf_model)model, alphas[i][0], alphas[i][1]};
            assert_near(graze_brdf_mean_albedo(&brdf), mean_of_albedos(&brdf, i < 6 ? 1 : 12), 1e-9);
        }
}

/* 1/(1 + tau^2)^n is an integral of s^(n-1) exp(-s (1 + tau^2)), of which the mean over slopes is known. */
static double mean_of_power(const graze_brdf *brdf, double n) {
    double sum = 0, step = 1. / 64, x2 = brdf->alpha_x * brdf->alpha_x, y2 = brdf->alpha_y * brdf->alpha_y;
    for (int i = -1000; i < 300; ++i) {
        double s = exp(i * step);
        sum += step * pow(s, n) * exp(-s) / sqrt((1 + x2 * s) * (1 + y2 * s));
    }
    return sum / tgamma(n);
}

static void ward_and_ward_duer(void **state) {
    (void)state;
    uint64_t seed = 6;
    for (int i = 0; i < 200; ++i) {
        graze_brdf brdf = {GRAZE_BRDF_WARD_DUER, draw_power(&seed, 1e-6, 10), draw_power(&seed, 1e-6, 10)};
        if (i % 3 == 0)
            brdf.alpha_y = brdf.alpha_x;
        assert_near(graze_brdf_mean_albedo(&brdf), mean_of_power(&brdf, 2), 1e-10);
        brdf.model = GRAZE_BRDF_WARD;
        assert_near(graze_brdf_mean_albedo(&brdf), 2. / 3 * mean_of_power(&brdf, 2.5), 1e-10);
    }
}

/* A grain so fine that slopes go one way only leaves the mean over a line. */
static void fine_grain(void **state) {
    (void)state;
    for (double alpha = 3e-2; alpha <= 10; alpha *= 3) {
        double gmd = 0, neumann = 0, step = 1. / 32;
        for (int i = -1000; i < 53; ++i) { /* over log y */
            double y = exp(i * step), tangent = alpha * y, angle = atan(tangent), part = step * y * exp(-y * y);
            gmd += part * (1 - tangent * sin(angle) * asinh(1 / tangent));
            neumann += part * 2 / 3 * pow(cos(angle), 4) * (1 - 2 * angle / pi);
        }
        graze_brdf brdf = {GRAZE_BRDF_GMD, 1e-6, alpha};
        assert_near(graze_brdf_mean_albedo(&brdf), 2 / sqrt(pi) * gmd, 1e-9);
        brdf.model = GRAZE_BRDF_WARD_NEUMANN;
        assert_near(graze_brdf_mean_albedo(&brdf), 2 / sqrt(pi) * neumann, 1e-9);
    }
}

static void limits(void **state) {
    (void)state;
    const double of_mirror[] = {1, 2. / 3, 1, 2. / 3};
    uint64_t seed = 7;
    for (int model = 0; model < GRAZE_BRDF_MODEL_COUNT; ++model) {
        const graze_brdf mirror = {(graze_brdf_model)model, 1e-6, 1e-6};
        assert_near(graze_brdf_mean_albedo(&mirror), of_mirror[model], 1e-6);
        for (int i = 0; i < 100; ++i) {
            graze_brdf brdf = {(graze_brdf_model)model, draw_power(&seed, 1e-6, 10), draw_power(&seed, 1e-6, 10)};
            const graze_brdf turned = {brdf.model, brdf.alpha_y, brdf.alpha_x};
            double mean = graze_brdf_mean_albedo(&brdf);
            assert_true(mean > 0 && mean <= 1);
            assert_true(graze_brdf_mean_albedo(&turned) == mean);
            brdf.alpha_x *= 1.1; /* a rougher surface reflects less */
            assert_true(graze_brdf_mean_albedo(&brdf) < mean + 1e-12);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(definition),
        cmocka_unit_test(ward_and_ward_duer),
        cmocka_unit_test(fine_grain),
        cmocka_unit_test(limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
