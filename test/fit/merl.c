/* A whole MERL table, made from a model with noise: the parameters are found in it, and their errors cover. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "fit/measured_text.h"
#include "fit/reflectance.h"

enum { HALVES = 90, DIFFERENCES = 90, AZIMUTHS = 180, CELLS = HALVES * DIFFERENCES * AZIMUTHS, HEADER = 12 };
#define NOISE .004

static const double pi = 3.14159265358979323846;
static const double scales[3] = {1500, 1500 / 1.15, 1500 / 1.66};
static const double alpha = .12, rs[3] = {.05, .06, .04}, rd[3] = {.3, .2, .1};

static double normal(uint64_t *state) {
    double sum = -6;
    for (int i = 0; i < 12; i++) {
        *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        sum += (double)(*state >> 11) * 0x1p-53;
    }
    return sum;
}

/* The direction at the angle `theta` from the half vector, which is `half` from the normal in the xz-plane. */
static graze_vec3 direction(double half, double theta, double phi) {
    double x = sin(theta) * cos(phi), y = sin(theta) * sin(phi), z = cos(theta);
    return (graze_vec3){cos(half) * x + sin(half) * z, y, cos(half) * z - sin(half) * x};
}

static void put(unsigned char *to, uint64_t number, int count) {
    for (int i = 0; i < count; i++)
        to[i] = (unsigned char)(number >> (8 * i));
}

static void put_cell(unsigned char *bytes, int half, int difference, int azimuth, uint64_t *state) {
    const graze_brdf brdf = {GRAZE_BRDF_GMD, alpha, alpha};
    double h = pi / 2 * pow((half + .5) / HALVES, 2), t = pi / 2 * (difference + .5) / DIFFERENCES;
    double p = pi * (azimuth + .5) / AZIMUTHS;
    graze_vec3 l = direction(h, t, p), v = direction(h, t, p + pi);
    bool above = l.z > 0 && v.z > 0;
    double f = above ? graze_brdf_value(&brdf, l, v) : 0;
    for (size_t k = 0; k < 3; k++) {
        double value = above ? (rd[k] / pi + rs[k] * f + NOISE * normal(state)) * scales[k] : -1;
        uint64_t bits;
        memcpy(&bits, &value, sizeof bits);
        put(bytes + HEADER + 8 * (k * CELLS + (size_t)((half * DIFFERENCES + difference) * AZIMUTHS + azimuth)), bits,
            8);
    }
}

static unsigned char *made_table(size_t length) {
    unsigned char *bytes = malloc(length);
    uint64_t state = 1;
    assert_non_null(bytes);
    put(bytes, HALVES, 4);
    put(bytes + 4, DIFFERENCES, 4);
    put(bytes + 8, AZIMUTHS, 4);
    for (int h = 0; h < HALVES; h++)
        for (int d = 0; d < DIFFERENCES; d++)
            for (int p = 0; p < AZIMUTHS; p++)
                put_cell(bytes, h, d, p, &state);
    return bytes;
}

static void assert_found(const fit_estimate *e, double truth) {
    assert_int_equal(e->state, FIT_DETERMINED);
    if (!(fabs(e->value - truth) < 4 * e->error && e->error < 1e-4))
        fail_msg("%.9g +- %.2g, expected %.9g", e->value, e->error, truth);
}

static void parameters_are_found(void **state) {
    (void)state;
    size_t length = HEADER + (size_t)8 * 3 * CELLS;
    unsigned char *bytes = made_table(length);
    const fit_read_options plain = {0};
    fit_measurements m = {0};
    assert_int_equal(read_written(&m, bytes, length, &plain), GRAZE_OK);
    free(bytes);
    assert_true(m.sources[0].absent + m.sources[0].below + m.count == CELLS && m.count > 1000000);

    /* The noise is the same for all cells. */
    fit_result r;
    const fit_settings settings = {
        .model = GRAZE_BRDF_GMD, .shared = true, .loss = FIT_LOSS_PLAIN, .max_polar = pi / 2};
    assert_int_equal(fit_reflectance(&r, &m, &settings, &remembering), GRAZE_OK);
    assert_found(&r.channels[0].alpha_x, alpha);
    for (size_t k = 0; k < 3; k++) {
        assert_found(&r.channels[k].rs, rs[k]);
        assert_found(&r.channels[k].rd, rd[k]);
    }
    assert_int_equal(r.pairs, m.count);
    assert_int_equal(r.qualities[0].degrees, 3 * m.count - 7);
    assert_true(fabs(sqrt(r.qualities[0].loss / (double)r.qualities[0].degrees) - NOISE) < .005 * NOISE);
    fit_result_free(&r);
    fit_measurements_free(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parameters_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
