/* Lights that are seen wholly, or not at all, are not sampled. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/angle.h"
#include "base/vector.h"
#include "graze/material.h"
#include "graze/trace.h"
#include "support/dice.h"
#include "support/scene_text.h"

#define LAMP  "void light bright 0 0 3 10 10 10 bright polygon lamp 0 0 12 -1 -1 3 -1 1 3 1 1 3 1 -1 3 "
#define FLOOR "polygon floor 0 0 12 -5 -5 0 5 -5 0 5 5 0 -5 5 0\n"

static graze_answer ask(const graze_scene *scene, graze_strategy strategy, int bounces, uint32_t samples, graze_ray ray,
                        uint64_t stream) {
    graze_trace_settings s = graze_trace_defaults();
    s.strategy = strategy;
    s.ambient_bounces = bounces;
    s.samples = samples;
    graze_answer answer;
    graze_trace(scene, &s, &ray, stream, &answer, NULL);
    return answer;
}

static const graze_ray slanted = {.origin = {-2, 0.5, 1}, .direction = {1, -0.1, -1}};

/* One path, and the error that its closed form may have. */
static void assert_exact(const char *text, int bounces) {
    graze_scene *scene = load_scene(text);
    for (int strategy = 0; strategy < 2; strategy++) {
        graze_answer answer = ask(scene, (graze_strategy)strategy, bounces, 0, slanted, 1);
        assert_int_equal(answer.samples, 1);
        assert_true(answer.converged);
        assert_true(answer.value.g > 0);
        assert_true(fabs(answer.standard_error.g - 1e-8 * answer.value.g) < 1e-12 * answer.value.g);
        graze_answer other = ask(scene, GRAZE_STRATEGY_BRDF, bounces, 1u << 15, slanted, 2);
        assert_true(other.samples == 1u << 15);
        if (fabs(answer.value.g - other.value.g) > 4 * other.standard_error.g)
            fail_msg("%g, but %g +- %g", answer.value.g, other.value.g, other.standard_error.g);
    }
    graze_scene_destroy(scene);
}

static void nothing_but_suns(void **state) {
    (void)state;
    graze_scene *scene =
        load_scene("void light far 0 0 3 9 9 9 far source sun 0 0 4 1 0 1 5 far source other 0 0 4 0 0 1 9\n");
    graze_trace_settings s = graze_trace_defaults();
    graze_answer answer;
    s.quantity = GRAZE_IRRADIANCE;
    graze_trace(scene, &s, &(graze_ray){.direction = {0, 0, 1}}, 1, &answer, NULL);
    double truth = 9 * PI * (pow(sin(angle_radians(2.5)), 2) * sqrt(0.5) + pow(sin(angle_radians(4.5)), 2));
    assert_int_equal(answer.samples, 1);
    assert_true(fabs(answer.value.g - truth) < 1e-9 * truth && answer.standard_error.g < 2e-8 * truth);
    graze_scene_destroy(scene);
}

static void nothing_but_a_lamp(void **state) {
    (void)state;
    assert_exact(LAMP "void plastic m 0 0 5 .5 .5 .5 0 0 m " FLOOR, 0);
    assert_exact(LAMP "void plastic m 0 0 5 .5 .5 .5 .1 .2 m " FLOOR, 0);
    assert_exact(LAMP "void metal m 0 0 5 .5 .5 .5 .8 .1 m " FLOOR, 2);
    assert_exact(LAMP "void light far 0 0 3 9 9 9 far source sun 0 0 4 1 0 1 5 "
                      "void plastic m 0 0 5 .5 .5 .5 .1 .2 m " FLOOR,
                 1);
    /* Suns that overlap, and one before the sky. */
    assert_exact("void light far 0 0 3 9 9 9 far source sun 0 0 4 1 0 1 5 far source again 0 0 4 1 0 1 5 "
                 "void glow g 0 0 4 1 1 1 0 g source sky 0 0 4 0 0 1 180 void plastic m 0 0 5 .5 .5 .5 0 0 m " FLOOR,
                 0);
    /* Other things below the horizon, and diffuse surfaces above it that no reflection may go to. */
    assert_exact(LAMP "void plastic m 0 0 5 .5 .5 .5 .1 .2 m sphere ball 0 0 4 0 0 -2 1 m " FLOOR, 1);
    assert_exact(LAMP "void plastic m 0 0 5 .5 .5 .5 0 0 m sphere ball 0 0 4 -4 -4 1 1 m " FLOOR, 0);
}

/* A thing above the horizon that gives no light changes nothing but the number of paths: reflections that meet the lamp
 * do not count. */
static void something_black(void **state) {
    (void)state;
    static const char lamp[] = LAMP "void plastic m 0 0 5 .5 .5 .5 .3 .2 m " FLOOR;
    static const char thing[] = LAMP "void plastic m 0 0 5 .5 .5 .5 .3 .2 void plastic coal 0 0 5 0 0 0 0 0 coal "
                                     "sphere ball 0 0 4 -4 -4 1 1 m " FLOOR;
    graze_scene *alone = load_scene(lamp), *scene = load_scene(thing);
    for (int strategy = 0; strategy < 2; strategy++)
        for (int bounces = 0; bounces < 2; bounces++) {
            graze_answer truth = ask(alone, (graze_strategy)strategy, bounces, 0, slanted, 1);
            graze_answer answer = ask(scene, (graze_strategy)strategy, bounces, 0, slanted, 1);
            assert_true(answer.samples >= 32);
            assert_true(fabs(answer.value.g - truth.value.g) < 1e-12 * truth.value.g);
        }
    graze_scene_destroy(alone);
    graze_scene_destroy(scene);
}

/* Black, without a doubt. */
static void hidden_lamp(void **state) {
    (void)state;
    graze_scene *scene = load_scene(LAMP "void plastic m 0 0 5 .5 .5 .5 0 0 m " FLOOR
                                         "m polygon lid 0 0 12 -2 -2 1.5 2 -2 1.5 2 2 1.5 -2 2 1.5\n");
    graze_answer answer = ask(scene, GRAZE_STRATEGY_MIS, 0, 0, slanted, 1);
    assert_int_equal(answer.samples, 1);
    assert_true(answer.value.g == 0 && answer.standard_error.g == 0);
    graze_scene_destroy(scene);
}

/* Where there are shadows, or other things to be seen in a reflection, samples are drawn. */
static void not_settled(void **state) {
    (void)state;
    static const char *const texts[] = {
        LAMP "void plastic m 0 0 5 .5 .5 .5 0 0 m sphere ball 0 0 4 -.5 0 2 .3 m " FLOOR,
        LAMP "void plastic m 0 0 5 .5 .5 .5 .1 .2 m sphere ball 0 0 4 -4 -4 1 1 m " FLOOR,
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        graze_scene *scene = load_scene(texts[i]);
        assert_true(ask(scene, GRAZE_STRATEGY_MIS, 0, 0, slanted, 1).samples >= 32);
        graze_scene_destroy(scene);
    }
    graze_scene *scene = load_scene(LAMP "void plastic m 0 0 5 .5 .5 .5 .1 .2 m " FLOOR);
    assert_true(ask(scene, GRAZE_STRATEGY_BRDF, 0, 0, slanted, 1).samples >= 32);
    assert_true(ask(scene, GRAZE_STRATEGY_UNWEIGHTED, 0, 0, slanted, 1).samples >= 32);
    graze_scene_destroy(scene);
}

/* A room with lamps of three kinds, a mirror, glossy things, and a window. */
static const char room[] =
    "void plastic wall 0 0 5 .6 .6 .6 0 0 void plastic2 gloss 4 1 0 0 . 0 6 .3 .4 .5 .1 .15 .3 "
    "void metal2 steel 4 0 0 1 . 0 6 .7 .7 .7 .8 .1 .3 void metal silver 0 0 5 .9 .9 .9 1 0 "
    "void light bright 0 0 3 10 10 10 void glow sky 0 0 4 2 2 2 0 "
    "gloss polygon floor 0 0 12 0 0 0 4 0 0 4 3 0 0 3 0 wall polygon ceiling 0 0 12 0 0 2.5 0 3 2.5 4 3 2.5 4 0 2.5 "
    "wall polygon south 0 0 12 0 0 0 0 0 2.5 4 0 2.5 4 0 0 steel polygon north 0 0 12 0 3 0 4 3 0 4 3 2.5 0 3 2.5 "
    "wall polygon west 0 0 12 0 0 0 0 3 0 0 3 2.5 0 0 2.5 silver polygon east 0 0 12 4 0 0 4 0 2.5 4 3 2.5 4 3 0 "
    "bright polygon panel 0 0 12 1 1 2.5 1 2 2.5 2 2 2.5 2 1 2.5 bright sphere globe 0 0 4 3 1.5 1.8 .2 "
    "bright ring disk 0 0 8 .5 2.5 2.2 .3 -.3 -1 .05 .4 sky polygon window 0 0 12 .5 .001 1 .5 .001 2 1.5 .001 2 1.5 "
    ".001 1 "
    "steel sphere ball 0 0 4 2 1 .5 .5 gloss cylinder column 0 0 7 3 2.5 0 3 2.5 2.5 .15 "
    "wall polygon screen 0 0 12 1 2.2 0 2.5 2.2 0 2.5 2.2 1.6 1 2.2 1.6\n";

/* As the other strategies have it, in sum and ray by ray. */
static void as_without(void **state) {
    (void)state;
    enum { RAYS = 60 };
    graze_scene *scene = load_scene(room);
    for (int bounces = 0; bounces < 2; bounces++) {
        double difference = 0, variance = 0, scatter = 0;
        for (int i = 0; i < RAYS; i++) {
            double turn = 2.4 * i, rise = (i + 0.5) / RAYS * 2 - 1, flat = sqrt(1 - rise * rise);
            graze_ray ray = {.origin = {2.2, 1.7, 1.2}, .direction = {flat * cos(turn), flat * sin(turn), rise}};
            graze_answer a = ask(scene, i % 2 ? GRAZE_STRATEGY_MIS : GRAZE_STRATEGY_LIGHT, bounces, 512, ray, 3);
            graze_answer b = ask(scene, GRAZE_STRATEGY_BRDF, bounces, 1u << 13, ray, 4);
            double d = a.value.g - b.value.g;
            double v = a.standard_error.g * a.standard_error.g + b.standard_error.g * b.standard_error.g;
            difference += d;
            variance += v;
            scatter += v > 0 ? d * d / v : 0;
        }
        if (fabs(difference) > 4 * sqrt(variance) || scatter > 1.8 * RAYS)
            fail_msg("%g +- %g, scatter %g", difference, sqrt(variance), scatter / RAYS);
    }
    graze_scene_destroy(scene);
}

/* What a pane shows and what is behind it are both followed: nothing is left to chance. */
static void panes_are_exact(void **state) {
    (void)state;
    graze_scene *scene =
        scene_from_text("void glass c 0 0 3 .9 .8 .7 c polygon pane 0 0 12 -5 -5 0 5 -5 0 5 5 0 -5 5 0\n"
                        "c polygon second 0 0 12 -5 -5 -1 5 -5 -1 5 5 -1 -5 5 -1\n"
                        "void glow below 0 0 4 1 1 1 0 below source b 0 0 4 0 0 -1 180\n"
                        "void glow above 0 0 4 20 20 20 0 above source a 0 0 4 0 0 1 180\n");
    assert_non_null(scene);
    graze_trace_settings s = graze_trace_defaults();
    graze_ray ray = {.origin = {0, 0, 1}, .direction = {0.3, 0.2, -1}};
    graze_material glass = {.kind = GRAZE_GLASS, .color = {0.9, 0.8, 0.7}, .refraction = 1.52};
    graze_surface pane;
    vec3 view = vec3_negate(vec3_safe_normalize(ray.direction));
    graze_surface_prepare(&pane, &glass, (vec3){0, 0, 1}, view, NULL);
    double r = pane.specular.g, t = pane.transmitted_specular.g, once = r + t * r * t,
           all = r + t * r * t / (1 - r * r);
    double through = t * t / (1 - r * r);
    graze_answer answer;
    graze_trace(scene, &s, &ray, 1, &answer, NULL);
    /* Light that goes to and fro between the panes is left to chance, but for the first time. */
    assert_true(once < all);
    assert_true(fabs(answer.value.g - (20 * all + through)) <= 4 * answer.standard_error.g + 1e-12);
    assert_true(answer.standard_error.g < 0.01 * answer.value.g && answer.samples <= 64);
    graze_scene_destroy(scene);
    scene = scene_from_text("void glass c 0 0 3 .9 .8 .7 c polygon pane 0 0 12 -5 -5 0 5 -5 0 5 5 0 -5 5 0\n"
                            "void glow below 0 0 4 1 1 1 0 below source b 0 0 4 0 0 -1 180\n"
                            "void glow above 0 0 4 20 20 20 0 above source a 0 0 4 0 0 1 180\n");
    assert_non_null(scene);
    graze_trace(scene, &s, &ray, 1, &answer, NULL);
    assert_int_equal(answer.samples, 1);
    assert_true(fabs(answer.value.g - (20 * r + t)) < 1e-12);
    graze_scene_destroy(scene);
}

/* What a closed ball's inside shows of what is outside: nothing. Where next to all of a light is below the surface's
 * horizon, a few samples tell nothing of shadows: then the error tells. */
static void closed_ball(void **state) {
    (void)state;
    graze_scene *scene = load_scene("void light far 0 0 3 1000 1000 1000 far source sun 0 0 4 0 .2 1 3\n"
                                    "void light near 0 0 3 100 100 100 near sphere lamp 0 0 4 3 3 3 .5\n"
                                    "void plastic grey 0 0 5 .5 .5 .5 0 0 grey sphere ball 0 0 4 .1 .2 .3 1.37\n");
    dice d = {5};
    int lit = 0, wrong = 0;
    for (uint64_t i = 0; i < 20000; i++) {
        graze_ray ray = {.origin = {.3, .1, .2}, .direction = roll_direction(&d)};
        graze_answer answer = ask(scene, GRAZE_STRATEGY_MIS, 0, 64, ray, i);
        lit += answer.value.g > 0;
        wrong += answer.value.g > 1.96 * answer.standard_error.g;
    }
    printf("# %d of 20000 are lit, %d of these more than their errors tell\n", lit, wrong);
    assert_true(wrong <= 0.05 * lit);
    graze_scene_destroy(scene);
}

/* Lamps that one of them hides, so that few samples choose one that is seen: what is hidden is in the error, whether
 * the answer is black or the ambient value. */
static void one_lamp_hides_many(void **state) {
    (void)state;
    static char text[30000] = "void plastic m 0 0 5 .5 .5 .5 0 0 m " FLOOR "void light bright 0 0 3 10 10 10\n";
    static const char lamp[] = "bright sphere lamp 0 0 4 0 0 2 .1\n";
    graze_scene *scenes[2];
    for (int i = 0; i < 500; i++) {
        strcat(text, lamp);
        if (i == 0)
            scenes[0] = load_scene(text);
    }
    scenes[1] = load_scene(text);
    for (int ambient = 0; ambient < 2; ambient++) {
        graze_trace_settings s = graze_trace_defaults();
        s.ambient_value = rgb_gray(0.01 * ambient);
        graze_answer one, many;
        graze_trace(scenes[0], &s, &slanted, 1, &one, NULL);
        assert_true(one.standard_error.g < 1e-7 * one.value.g);
        for (s.samples = 2; s.samples < 512; s.samples *= 2)
            for (uint64_t stream = 2; stream < 12; stream++) {
                graze_trace(scenes[1], &s, &slanted, stream, &many, NULL);
                double off = fabs(many.value.g - one.value.g);
                if (off > 4 * many.standard_error.g)
                    fail_msg("%u samples: %g, off by %g +- %g", s.samples, many.value.g, off, many.standard_error.g);
            }
    }
    graze_scene_destroy(scenes[0]);
    graze_scene_destroy(scenes[1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(panes_are_exact), cmocka_unit_test(nothing_but_suns), cmocka_unit_test(nothing_but_a_lamp),
        cmocka_unit_test(something_black), cmocka_unit_test(hidden_lamp),      cmocka_unit_test(not_settled),
        cmocka_unit_test(as_without),      cmocka_unit_test(closed_ball),      cmocka_unit_test(one_lamp_hides_many),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
