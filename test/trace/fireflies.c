/* No sample of the paper's grazing scene is brighter than theory allows. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/angle.h"
#include "graze/brdf.h"
#include "support/scene_text.h"
#include "trace/path.h"

#define RADIANCE 100.0
#define DIFFUSE  0.12
#define SPECULAR 0.48

static const char *const grazing = "void metal gray 0 0 5 .6 .6 .6 .8 .1\n"
                                   "gray polygon surface 0 0 12 -30 -10 0 30 -10 0 30 60 0 -30 60 0\n"
                                   "void light lamp 0 0 3 100 100 100\n"
                                   "lamp polygon luminaire 0 0 12 -.5 10 .05 .5 10 .05 .5 10 .5 -.5 10 .5\n";

/* The brightest of many samples of one ray, and their mean. */
static double brightest(const graze_scene *scene, graze_strategy strategy, vec3 origin, vec3 direction, double *mean) {
    graze_trace_settings settings = graze_trace_defaults();
    settings.strategy = strategy;
    path_memory memory = {.alike = true};
    const path_context context = {.scene = scene, .settings = &settings, .memory = &memory};
    path_hit first = path_cast(&context, origin, vec3_normalize(direction), GEOMETRY_FAR, -1);
    assert_true(first.surface >= 0);
    double most = 0, sum = 0;
    enum { SAMPLES = 4000 };
    for (uint32_t i = 0; i < SAMPLES; i++) {
        sampler points = sampler_start(sampler_key(1, 2, 3), i);
        path_sample sample;
        path_radiance(&context, &first, &points, &sample);
        assert_true(isfinite(sample.radiance.g) && sample.radiance.g >= 0);
        most = fmax(most, sample.radiance.g);
        sum += sample.radiance.g;
    }
    *mean = sum / SAMPLES;
    return most;
}

/* A lobe is chosen in proportion to its reflectance, and weights of pairs are at most 1: a reflection finds no more
 * than reflectance x radiance. With light samples beside it, each weighted by p^2 / (p^2 + q^2), these add half of that
 * at most. Light samples alone find value x cosine x radiance x solid angle: beside the peak of the lobe, that is many
 * times what reflections do, but bounded. */
static void bounded_by_theory(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text(grazing);
    assert_non_null(scene);
    const double all = (DIFFUSE + SPECULAR) * RADIANCE;
    int lit = 0;
    for (int i = 0; i < 60; i++) {
        double elevation = angle_radians((const double[]){0.1, 1, 5}[i % 3]), distance = 0.2 + 0.16 * i;
        vec3 point = {0.02 * i - 0.5, 10 - distance, 0}, direction = {0, cos(elevation), -sin(elevation)};
        vec3 origin = vec3_add_scaled(point, -1, direction);
        double mean[3], most[3];
        for (int strategy = 0; strategy < 3; strategy++)
            most[strategy] = brightest(scene, (graze_strategy)strategy, origin, direction, &mean[strategy]);
        assert_true(most[GRAZE_STRATEGY_BRDF] <= all * (1 + 1e-9));
        assert_true(most[GRAZE_STRATEGY_MIS] <= 1.5 * all * (1 + 1e-9));
        /* The panel at its brightest is in the plane of incidence. */
        const graze_brdf lobe = {GRAZE_BRDF_GMD, 0.1, 0.1};
        double bound = 0;
        for (int k = 0; k <= 4000; k++) {
            vec3 at = vec3_subtract(vec3_make(point.x, 10, 0.05 + 0.45 * k / 4000), point);
            vec3 l = vec3_normalize(at);
            double value = DIFFUSE / PI + SPECULAR * graze_brdf_value(&lobe, l, vec3_negate(direction));
            bound = fmax(bound, value * l.z);
        }
        /* Its solid angle is less than its area over the least distance squared, times the largest cosine, 1. */
        double solid_angle = fmin(0.45 / (distance * distance), 2 * PI);
        assert_true(most[GRAZE_STRATEGY_LIGHT] <= 1.001 * bound * solid_angle * RADIANCE);
        if (mean[0] > 0.01 * all) {
            lit++;
            assert_true(most[0] < 200 * mean[0]);
        }
    }
    assert_true(lit > 20);
    graze_scene_destroy(scene);
}

/* Seen at less and less, reflections of reflections stay within what they reflect: a corridor of such walls. */
static void bounded_in_a_corridor(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text("void metal gray 0 0 5 .9 .9 .9 .8 .1\nvoid light l 0 0 3 1 1 1\n"
                                         "gray polygon low 0 0 12 -1 0 0 1 0 0 1 99 0 -1 99 0\n"
                                         "gray polygon high 0 0 12 -1 0 1 -1 99 1 1 99 1 1 0 1\n"
                                         "gray polygon left 0 0 12 -1 0 0 -1 99 0 -1 99 1 -1 0 1\n"
                                         "gray polygon right 0 0 12 1 0 0 1 0 1 1 99 1 1 99 0\n"
                                         "l polygon end 0 0 12 -1 99 0 1 99 0 1 99 1 -1 99 1\n");
    assert_non_null(scene);
    for (int i = 0; i < 12; i++) {
        double mean, slope = pow(10, -1 - 0.4 * i);
        double most =
            brightest(scene, GRAZE_STRATEGY_BRDF, vec3_make(0, 1, 0.5), vec3_make(0.3 * slope, 1, -slope), &mean);
        assert_true(most <= 1 + 1e-9);
    }
    graze_scene_destroy(scene);
}

/* Who survives roulette deep down carries no more light to the eye than most paths do before: in a grey ball, half of
 * what a lamp shines after one reflection, and a sixth or so after five. */
static void survivors_carry_little(void **state) {
    (void)state;
    graze_scene *scene =
        scene_from_text("void plastic g 0 0 5 .5 .5 .5 0 0 g bubble room 0 0 4 0 0 0 1\n"
                        "void light l 0 0 3 1 1 1 l polygon lamp 0 0 12 -.3 -.3 .9 -.3 .3 .9 .3 .3 .9 .3 -.3 .9\n");
    assert_non_null(scene);
    graze_trace_settings settings = graze_trace_defaults();
    settings.strategy = GRAZE_STRATEGY_BRDF;
    settings.ambient_bounces = 20;
    path_memory memory = {.alike = true};
    const path_context context = {.scene = scene, .settings = &settings, .memory = &memory};
    path_hit first = path_cast(&context, (vec3){0, 0, 0}, (vec3){0, 0, -1}, GEOMETRY_FAR, -1);
    int late = 0;
    for (uint32_t i = 0; i < 20000; i++) {
        sampler points = sampler_start(sampler_key(1, 2, 3), i);
        path_sample sample;
        path_radiance(&context, &first, &points, &sample);
        assert_true(sample.radiance.g <= 0.5 * (1 + 1e-9));
        /* Powers of 1/2 are of paths that no roulette was played with. */
        late += sample.radiance.g > 0.26 && sample.radiance.g < 0.49;
    }
    assert_true(late > 10);
    graze_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(survivors_carry_little),
        cmocka_unit_test(bounded_by_theory),
        cmocka_unit_test(bounded_in_a_corridor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
