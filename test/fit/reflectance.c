/* Fits of data whose truth is known: recovery, standard errors that cover, and the paper's Table 1 as an experiment. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fit/reflectance.h"

static const double pi = 3.14159265358979323846;
static const graze_brdf_model models[] = {GRAZE_BRDF_GMD, GRAZE_BRDF_WARD, GRAZE_BRDF_WARD_DUER,
                                          GRAZE_BRDF_WARD_NEUMANN};
enum { PAIRS_MAX = 1024, CHANNELS_MAX = 3 };

/* A surface, and measurements of it. */
typedef struct truth {
    graze_brdf_model model;
    double alpha_x, alpha_y, rs[CHANNELS_MAX], rd[CHANNELS_MAX];
} truth;

static fit_pair pairs[PAIRS_MAX];
static double values[PAIRS_MAX * CHANNELS_MAX];
static fit_channel_name names[CHANNELS_MAX];

static fit_measurements measurements(size_t count, size_t channels) {
    return (fit_measurements){
        .count = count, .pairs = pairs, .values = values, .channel_count = channels, .channels = names};
}

static double uniform(uint64_t *seed) {
    uint64_t z = *seed += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return ((double)((z ^ (z >> 31)) >> 11) + .5) * 0x1p-53;
}

static double normal(uint64_t *seed) {
    double radius = sqrt(-2 * log(uniform(seed)));
    return radius * cos(2 * pi * uniform(seed));
}

static graze_vec3 direction(double polar, double azimuth) {
    double t = polar * pi / 180, p = azimuth * pi / 180;
    return (graze_vec3){sin(t) * cos(p), sin(t) * sin(p), cos(t)};
}

/* Incident angles in the plane, `views` of them each from -89 to 89 degrees. */
static size_t plane_pairs(const double *incident, size_t count, size_t views) {
    size_t n = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < views; k++)
            pairs[n++] = (fit_pair){.l = direction(incident[i], 0),
                                    .v = direction(-89 + 178.0 * (double)k / (double)(views - 1), 180),
                                    .weight = 1};
    return n;
}

/* Views around the mirror direction, in and out of planes of incidence at all azimuths. */
static size_t scattered_pairs(size_t count, double spread) {
    uint64_t seed = 5;
    for (size_t i = 0; i < count; i++) {
        double polar = 70 * uniform(&seed), azimuth = 360 * uniform(&seed);
        pairs[i] = (fit_pair){
            .l = direction(polar, azimuth),
            .v = direction(fmin(fabs(polar + spread * normal(&seed)), 80), azimuth + 180 + spread * normal(&seed)),
            .weight = 1};
    }
    return count;
}

/* Noise is of the same size in value x cosine, as Eq. 20 takes it to be. */
static void measure(const truth *t, size_t count, size_t channels, double noise, uint64_t seed) {
    const graze_brdf brdf = {t->model, t->alpha_x, t->alpha_y};
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < channels; k++)
            values[i * channels + k] = t->rd[k] / pi + t->rs[k] * graze_brdf_value(&brdf, pairs[i].l, pairs[i].v) +
                                       noise * normal(&seed) / (sqrt(pairs[i].weight) * pairs[i].l.z);
}

static bool is_close(const fit_estimate *e, double value, double tolerance) {
    return e->state == FIT_DETERMINED && fabs(e->value - value) <= tolerance * value;
}

/* Without noise every model finds itself, with every loss, and the residual is nothing. */
static void recovery_without_noise(void **state) {
    (void)state;
    size_t count = scattered_pairs(400, 8);
    for (int i = 0; i < 4; i++)
        for (int loss = FIT_LOSS_COSINE; loss <= FIT_LOSS_LOG; loss++)
            for (int anisotropic = 0; anisotropic < 2; anisotropic++) {
                const truth t = {models[i], .12, anisotropic ? .05 : .12, {.08}, {.3}};
                const fit_settings s = {.model = models[i],
                                        .anisotropic = anisotropic,
                                        .shared = true,
                                        .loss = (fit_loss)loss,
                                        .max_polar = pi / 2};
                measure(&t, count, 1, 0, 1);
                fit_measurements m = measurements(count, 1);
                fit_result r;
                assert_int_equal(fit_reflectance(&r, &m, &s, NULL), GRAZE_OK);
                assert_true(is_close(&r.channels[0].alpha_x, t.alpha_x, 1e-6));
                assert_true(is_close(&r.channels[0].alpha_y, t.alpha_y, 1e-6));
                assert_true(is_close(&r.channels[0].rs, .08, 1e-6) && is_close(&r.channels[0].rd, .3, 1e-6));
                assert_true(r.residual < 1e-15 && r.pairs == count && r.qualities[0].converged);
                assert_false(r.qualities[0].has_rival);
                assert_true(fabs(fit_result_value(&r, 0, pairs[3].l, pairs[3].v) - values[3]) < 1e-7);
                fit_result_free(&r);
            }
}

/* Roughness is one for all channels, or each channel's own. */
static void channels(void **state) {
    (void)state;
    size_t count = scattered_pairs(300, 8);
    const truth t = {GRAZE_BRDF_GMD, .1, .1, {.05, .02, .2}, {.1, .4, 0.05}};
    const double total[] = {.15, .42, .25};
    measure(&t, count, 3, 0, 1);
    fit_measurements m = measurements(count, 3);
    for (int shared = 0; shared < 2; shared++)
        for (int known = 0; known < 2; known++) {
            const fit_settings s = {.shared = shared, .max_polar = pi / 2, .total = known ? total : NULL};
            fit_result r;
            assert_int_equal(fit_reflectance(&r, &m, &s, NULL), GRAZE_OK);
            assert_int_equal(r.fit_count, shared ? 1 : 3);
            for (int k = 0; k < 3; k++) {
                assert_true(is_close(&r.channels[k].alpha_x, .1, 1e-6));
                assert_true(is_close(&r.channels[k].rs, t.rs[k], 1e-6) && is_close(&r.channels[k].rd, t.rd[k], 1e-6));
            }
            size_t parameters = shared ? (known ? 4 : 7) : (known ? 2 : 3);
            assert_int_equal(r.qualities[0].degrees, count * (shared ? 3 : 1) - parameters);
            fit_result_free(&r);
        }
}

/* A count of hits may be off by four of its standard deviations: by chance, one such test in 16,000 fails. */
static void assert_share(int hits, int trials, double share, const char *what) {
    double expected = trials * share, deviation = sqrt(trials * share * (1 - share));
    if (fabs(hits - expected) > 4 * deviation + .5)
        fail_msg("%s: %d of %d, expected %.0f +- %.0f", what, hits, trials, expected, deviation);
}

/* The stated errors of the new model cover the truth as often as those of a normal distribution should: also for
 * anisotropic fits, with the total known, and with weights and an angle that leaves pairs out. */
static void errors_cover(void **state) {
    (void)state;
    enum { REPLICATES = 200 };
    static const double total = .38;
    const fit_settings settings[] = {
        {.shared = true, .max_polar = 1.5707963267948966},
        {.shared = true, .max_polar = 1.5707963267948966, .anisotropic = true},
        {.shared = true, .max_polar = 1.5707963267948966, .total = &total},
        {.shared = true, .max_polar = 1.1},
    };
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        const fit_settings *s = &settings[i];
        const truth t = {GRAZE_BRDF_GMD, .12, s->anisotropic ? .06 : .12, {.08}, {.3}};
        const double truths[] = {t.alpha_x, t.alpha_y, .08, .3};
        int once[4] = {0}, twice[4] = {0};
        size_t count = scattered_pairs(150, 8);
        for (size_t k = 0; k < count; k++)
            pairs[k].weight = i == 3 && k % 2 ? .25 : 1;
        for (int n = 0; n < REPLICATES; n++) {
            measure(&t, count, 1, .02, 1000 * (uint64_t)n);
            fit_measurements m = measurements(count, 1);
            fit_result r;
            assert_int_equal(fit_reflectance(&r, &m, s, NULL), GRAZE_OK);
            const fit_estimate estimates[] = {r.channels[0].alpha_x, r.channels[0].alpha_y, r.channels[0].rs,
                                              r.channels[0].rd};
            for (int k = 0; k < 4; k++) {
                assert_int_equal(estimates[k].state, FIT_DETERMINED);
                double off = fabs(estimates[k].value - truths[k]);
                once[k] += off < estimates[k].error;
                twice[k] += off < 1.96 * estimates[k].error;
            }
            fit_result_free(&r);
        }
        for (int k = 0; k < 4; k++) {
            assert_share(once[k], REPLICATES, .6827, "one standard error");
            assert_share(twice[k], REPLICATES, .95, "1.96 standard errors");
        }
    }
}

/* figures/linoleum.csv, which holds the 222 pairs of Table 1's experiment, is what it says: the new model at the
 * linoleum's parameters, and noise. */
static fit_measurements read_linoleum(void) {
    const char *root = getenv("GRAZE_ROOT");
    char file[4096];
    snprintf(file, sizeof file, "%s/figures/linoleum.csv", root ? root : ".");
    const fit_read_options as_it_is = {.columns = NULL};
    const truth linoleum = {GRAZE_BRDF_GMD, .03172, .03172, {.04982}, {.175 - .04982}};
    fit_measurements m = {0};
    assert_int_equal(fit_read(&m, file, &as_it_is, NULL), GRAZE_OK);
    assert_int_equal(m.count, 222);
    memcpy(pairs, m.pairs, m.count * sizeof *pairs);
    measure(&linoleum, m.count, 1, .0645, 1);
    for (size_t i = 0; i < m.count; i++)
        assert_true(fabs(m.values[i] - values[i]) <= 6e-6 * fabs(values[i]));
    return m;
}

/* Table 1: the linoleum, fitted by all models. As in the paper, Ward's error is the largest and the new model's the
 * least; Ward takes more specular reflectance at less roughness, Ward-Duer less of both. */
static void table_1(void **state) {
    (void)state;
    const double total = .175;
    fit_measurements m = read_linoleum();
    fit_channel found[4];
    double residual[4];
    for (int i = 0; i < 4; i++) {
        const fit_settings s = {.model = models[i], .shared = true, .max_polar = pi / 2, .total = &total};
        fit_result r;
        assert_int_equal(fit_reflectance(&r, &m, &s, NULL), GRAZE_OK);
        found[i] = r.channels[0];
        residual[i] = r.residual;
        print_message("# model %d: rs %.5f +- %.5f, alpha %.5f +- %.5f, error %.4f\n", (int)models[i],
                      found[i].rs.value, found[i].rs.error, found[i].alpha_x.value, found[i].alpha_x.error, r.residual);
        fit_result_free(&r);
    }
    enum { NEW, WARD, WARD_DUER };
    assert_true(fabs(found[NEW].rs.value - .04982) < 4 * found[NEW].rs.error);
    assert_true(fabs(found[NEW].alpha_x.value - .03172) < 4 * found[NEW].alpha_x.error);
    assert_true(residual[NEW] < .5 * residual[WARD_DUER] && residual[WARD_DUER] < .5 * residual[WARD]);
    assert_true(found[WARD].rs.value > 1.5 * .04982 && found[WARD].alpha_x.value < .03172);
    assert_true(found[WARD_DUER].rs.value < .8 * .04982 && found[WARD_DUER].alpha_x.value < .9 * .03172);
    fit_measurements_free(&m);
}

/* What the data do not tell is said, not guessed. */
static void what_is_not_determined(void **state) {
    (void)state;
    const fit_settings s = {.shared = true, .max_polar = pi / 2};
    const double incident[] = {30};
    size_t count = scattered_pairs(200, 8);
    const truth matt = {GRAZE_BRDF_GMD, .1, .1, {0}, {.3}};
    measure(&matt, count, 1, 0, 1);
    fit_measurements m = measurements(count, 1);
    fit_result r;
    assert_int_equal(fit_reflectance(&r, &m, &s, NULL), GRAZE_OK);
    assert_true(r.channels[0].rs.value < 1e-5 && fabs(r.channels[0].rd.value - .3) < 1e-5);
    fit_result_free(&r);
    /* In one plane along x, a lobe's width along y is seen in its height alone. */
    const truth brushed = {GRAZE_BRDF_GMD, .1, .2, {.2}, {.1}};
    fit_settings anisotropic = s;
    anisotropic.anisotropic = true;
    count = plane_pairs(incident, 1, 90);
    measure(&brushed, count, 1, .001, 1);
    m = measurements(count, 1);
    assert_int_equal(fit_reflectance(&r, &m, &anisotropic, NULL), GRAZE_OK);
    assert_true(r.qualities[0].condition == 0 || r.qualities[0].condition > FIT_CONDITION_MAX);
    fit_result_free(&r);
}

static void angles_left_out(void **state) {
    (void)state;
    const double incident[] = {30, 70};
    const truth t = {GRAZE_BRDF_GMD, .1, .1, {.05}, {.2}};
    fit_settings s = {.shared = true, .max_polar = 60.5 * pi / 180};
    size_t count = plane_pairs(incident, 2, 179);
    measure(&t, count, 1, 0, 1);
    fit_measurements m = measurements(count, 1);
    fit_result r;
    assert_int_equal(fit_reflectance(&r, &m, &s, NULL), GRAZE_OK);
    assert_int_equal(r.pairs, 121);
    fit_result_free(&r);
    s.max_polar = 20 * pi / 180;
    assert_int_equal(fit_reflectance(&r, &m, &s, NULL), GRAZE_INPUT_ERROR);
    fit_result_free(&r);
    values[0] = -100;
    s.max_polar = pi / 2;
    s.loss = FIT_LOSS_LOG;
    assert_int_equal(fit_reflectance(&r, &m, &s, NULL), GRAZE_INPUT_ERROR);
    fit_result_free(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(recovery_without_noise), cmocka_unit_test(channels),
        cmocka_unit_test(errors_cover),           cmocka_unit_test(table_1),
        cmocka_unit_test(what_is_not_determined), cmocka_unit_test(angles_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
