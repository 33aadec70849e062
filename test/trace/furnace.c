/* Interreflection where the answer is known: closed rooms of one colour, and white things in a white world. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/angle.h"
#include "base/vector.h"
#include "graze/trace.h"
#include "support/scene_text.h"

static graze_scene *load(const char *text) {
    graze_scene *scene = scene_from_text(text);
    if (!scene)
        fail_msg("%s", messages);
    return scene;
}

/* Of errors that 16 replicates tell, one in 10,000 answers is farther off. */
#define ERRORS 5.2

static void assert_radiance(const graze_scene *scene, const graze_trace_settings *s, const graze_ray *ray,
                            uint64_t stream, double truth, double largest_error) {
    graze_answer a;
    graze_trace(scene, s, ray, stream, &a, NULL);
    double error = a.standard_error.g;
    if (!(fabs(a.value.g - truth) <= ERRORS * error + 1e-9 * truth) || !(error <= largest_error * truth))
        fail_msg("strategy %d, -lw %g -lr %d: %.9g +- %.2g, but the truth is %.9g", (int)s->strategy, s->minimum_weight,
                 s->reflection_limit, a.value.g, error, truth);
}

/* A lamp in the middle of a ball fills (r/R)^2 of the sky of every point of the wall, and the wall itself the rest: the
 * light of each bounce is the same everywhere. However paths end, they must not lose light. */
static void lamp_in_a_grey_ball(void **state) {
    (void)state;
    const double albedos[] = {0.5, 0.7, 0.9, 0.95, 0.99}, part = 1.0 / 9;
    const struct {
        int limit;
        double minimum_weight;
    } endings[] = {{0, 1e-4}, {0, 0.5}, {-1000, 0.9}};
    for (int i = 0; i < 5; i++) {
        char text[256];
        snprintf(text, sizeof text,
                 "void plastic g 0 0 5 %.17g %.17g %.17g 0 0 g bubble room 0 0 4 5 1 2 3\n"
                 "void light l 0 0 3 4 4 4 l sphere lamp 0 0 4 5 1 2 1\n",
                 albedos[i], albedos[i], albedos[i]);
        graze_scene *scene = load(text);
        const graze_ray ray = {.origin = {5, 1, 4}, .direction = {0.7, 0.2, -0.1}};
        double back = albedos[i] * (1 - part), truth = 4 * albedos[i] * part / (1 - back);
        for (int strategy = 0; strategy < 3; strategy++)
            for (int ending = 0; ending < 3; ending++) {
                graze_trace_settings s = graze_trace_defaults();
                s.strategy = (graze_strategy)strategy;
                s.ambient_bounces = 2000;
                s.reflection_limit = endings[ending].limit;
                s.minimum_weight = endings[ending].minimum_weight;
                s.samples = 4096;
                assert_radiance(scene, &s, &ray, (uint64_t)(i + 10 * ending), truth, 0.08);
            }
        graze_scene_destroy(scene);
    }
}

/* What is white, dull or a mirror, cannot be told from a white world around it, whatever its shape. */
static void white_things_in_a_white_world(void **state) {
    (void)state;
    const char *text = "void glow w 0 0 4 3 3 3 0 w bubble world 0 0 4 0 0 0 10\n"
                       "void plastic d 0 0 5 1 1 1 0 0\nvoid metal m 0 0 5 1 1 1 1 0\n"
                       "d polygon floor 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 2 0\n"
                       "d polygon wall 0 0 12 -2 2 0 2 2 0 2 2 3 -2 2 3\n"
                       "m polygon mirror 0 0 12 -2 -2 0 -2 2 0 -2 2 3 -2 -2 3\n"
                       "d cup cup 0 0 8 0 0 0 0 0 1 .2 .5\nm tube tube 0 0 7 1 1 .2 1 .5 1.2 .3\n"
                       "d sphere ball 0 0 4 -1 1 .5 .5\nm sphere globe 0 0 4 1 -1 .5 .5\n"
                       "d ring ring 0 0 8 -1 -1 .7 1 2 3 .2 .6\n";
    graze_scene *scene = load(text);
    for (int strategy = 0; strategy < 3; strategy++)
        for (int i = 0; i < 40; i++) {
            double angle = 2 * PI * i / 40;
            vec3 origin = {3 * cos(angle), 3 * sin(angle), 2.5};
            vec3 target = {-1 + 2 * (i % 7) / 6.0, -1 + 2 * (i % 5) / 4.0, 0.1 * (i % 6)};
            graze_ray ray = {.origin = origin, .direction = vec3_subtract(target, origin)};
            graze_trace_settings s = graze_trace_defaults();
            s.strategy = (graze_strategy)strategy;
            s.ambient_bounces = 1000;
            s.samples = 512;
            /* Reflections find nothing but white, and no sample differs. */
            assert_radiance(scene, &s, &ray, (uint64_t)i, 3, strategy == GRAZE_STRATEGY_BRDF ? 1e-12 : 0.1);
        }
    graze_scene_destroy(scene);
}

/* A glossy ball in a white world reflects its albedo, from the middle to the rim. */
static void glossy_ball_in_a_white_world(void **state) {
    (void)state;
    for (int model = 0; model < GRAZE_BRDF_MODEL_COUNT; model++) {
        const graze_model_choice choice = {NULL, (graze_brdf_model)model};
        graze_scene *scene = scene_from_text_with("void glow w 0 0 4 1 1 1 0 w bubble world 0 0 4 0 0 0 10\n"
                                                  "void metal b 0 0 5 .5 .5 .5 .6 .2 b sphere ball 0 0 4 1 2 3 1\n",
                                                  &(graze_scene_settings){.models = &choice, .model_count = 1});
        if (!scene)
            fail_msg("%s", messages);
        for (int i = 0; i < 8; i++) {
            double angle = angle_radians((const double[]){0, 20, 40, 60, 75, 85, 88, 89}[i]);
            graze_ray ray = {.origin = {1 + sin(angle), 2, 6}, .direction = {0, 0, -1}};
            const graze_brdf lobe = {(graze_brdf_model)model, 0.2, 0.2};
            const vec3 view = {sin(angle), 0, cos(angle)};
            double truth = 0.5 * (0.4 + 0.6 * graze_brdf_albedo(&lobe, view));
            for (int strategy = 0; strategy < 3; strategy++) {
                graze_trace_settings s = graze_trace_defaults();
                s.strategy = (graze_strategy)strategy;
                s.ambient_bounces = 1;
                s.samples = 1 << 14;
                assert_radiance(scene, &s, &ray, (uint64_t)i, truth, strategy == GRAZE_STRATEGY_LIGHT ? 0.15 : 0.02);
            }
        }
        graze_scene_destroy(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamp_in_a_grey_ball),
        cmocka_unit_test(white_things_in_a_white_world),
        cmocka_unit_test(glossy_ball_in_a_white_world),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
