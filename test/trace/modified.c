/* Patterns, textures, mixtures and functions along paths: answers that follow from those of plain materials, the same
 * ones from all strategies. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "graze/material.h"
#include "one_ray.h"

/* A floor of a modifier named `m`, seen under a large lamp and a glow, beside a wall and a lamp that goes through it.
 */
static const char *const around =
    "void light l 0 0 3 4 3 2 l sphere lamp 0 0 4 1 1 2 .7 l sphere low 0 0 4 1 .5 .1 .3 void glow g 0 0 4 1 2 3 0 g "
    "ring sky 0 0 8 -1 0 2 0 0 -1 0 1 "
    "void plastic w 0 0 5 .5 .6 .7 0 0 w polygon wall 0 0 12 -2 2 0 2 2 0 2 2 2 -2 2 2 "
    "m polygon floor 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 2 0";

static graze_answer answer_of(const char *materials, graze_strategy strategy, int bounces, double x) {
    char text[3000];
    snprintf(text, sizeof text, "%s %s", materials, around);
    graze_trace_settings settings = graze_trace_defaults();
    settings.strategy = strategy;
    settings.ambient_bounces = bounces;
    settings.samples = 20000;
    const vec3 eye = {0.2, -2, 1.5};
    return answer_along(text, &settings,
                        (graze_ray){.origin = eye, .direction = vec3_subtract(vec3_make(x, 0.2, 0), eye)});
}

#define TEXTURE "void texfunc t 4 .3*sin(9*Px) .2 .1 . 0 0 "
static const char *const materials[] = {
    "void colorfunc p 4 .5+.4*sin(9*Px) .7 Py+.4 . 0 0 p plastic m 0 0 5 .8 .8 .8 .1 .2",
    TEXTURE "t plastic m 0 0 5 .8 .7 .6 .1 .2",
    TEXTURE "t metal m 0 0 5 .8 .7 .6 .9 .3",
    TEXTURE "t metal m 0 0 5 .8 .7 .6 .9 0",
    "void plastic a 0 0 5 .8 .2 .2 0 0 void metal b 0 0 5 .2 .3 .7 .8 .3 void mixfunc m 4 a b .4 . 0 0",
    "void plastic a 0 0 5 .8 .2 .2 .1 .1 void metal b 0 0 5 .2 .3 .7 .8 .3 void mixfunc m 4 a b .4 . 0 0",
    TEXTURE "t plastic a 0 0 5 .8 .2 .2 .1 .1 void metal b 0 0 5 .2 .3 .7 .8 0 void mixfunc m 4 a b .4 . 0 0",
    "void plasfunc m 2 max . 0 4 .5 .4 .3 .3",
    TEXTURE "t WGMDfunc m 13 void .4 .3 .2 void 0 0 0 void 1 Px 0 . 0 9 .5 .3 .2 0 0 0 0 0 0",
    /* And of those that transmit: */
    "void transfunc m 2 max . 0 6 .7 .6 .5 .2 .6 .7",
    "void BRTDfunc m 10 0 0 0 0 0 0 max min 0 . 0 9 .3 .2 .1 0 0 0 .2 .3 .4",
    TEXTURE "t BRTDfunc m 10 .3 .2 .1+.1*CrP .5 .4 Px*Px max max 0 . 0 9 .1 .1 .1 0 0 0 .1 .1 .1",
    "void WGMDfunc m 13 void .2 .3 .2 void .4 .3 .2 void 1 Px 0 . 0 9 .1 .2 .1 0 0 0 .2 .1 .1",
    TEXTURE "void WGMDfunc m 13 void .1 0 0 t .4 .3 .2 inherit 1 Px 0 . 0 9 .1 .2 .1 0 0 0 .2 .1 .1",
    "void WGMDfunc m 13 void .2 .3 .2 void .5 0 0 void 1 Px 0 . 0 9 .1 .2 .1 0 0 0 .2 .1 .1",
    TEXTURE "t glass m 0 0 3 .9 .8 .7",
    TEXTURE "t trans m 0 0 7 .9 .8 .7 .05 .3 .6 .7",
    "void plastic a 0 0 5 .8 .2 .2 .1 .1 void mixfunc m 4 a void .4 . 0 0",
    "void trans a 0 0 7 .9 .8 .7 .05 .3 .6 .7 void mixfunc m 4 void a .4 . 0 0",
    ("void transfunc a 2 max . 0 6 .7 .6 .5 .2 .6 .7 void mixfunc b 4 a void .4 . 0 0 void glass c 0 0 3 .9 .8 .7 "
     "void mixfunc m 4 b c .3 . 0 0"),
    "void dielectric a 0 0 5 .9 .8 .7 1.3 0 void plastic b 0 0 5 .8 .2 .2 .1 .1 void mixfunc m 4 a b .4 . 0 0",
    "void interface a 0 0 8 .9 .8 .7 1.3 .9 .9 .9 1.1 void mixfunc m 4 a void .4 . 0 0",
    "void prism2 a 9 .3 Dx Dy -Dz .5 Dx+.3 Dy Dz . 0 0 void metal b 0 0 5 .2 .3 .7 .8 .3 void mixfunc m 4 a b .4 . 0 0",
};

static void strategies_agree(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof materials / sizeof *materials; i++)
        for (int bounces = 0; bounces <= 1; bounces++) {
            graze_answer both = answer_of(materials[i], GRAZE_STRATEGY_MIS, bounces, 0.1);
            graze_answer light = answer_of(materials[i], GRAZE_STRATEGY_LIGHT, bounces, 0.1);
            graze_answer reflection = answer_of(materials[i], GRAZE_STRATEGY_BRDF, bounces, 0.1);
            assert_true(rgb_brightness(both.value) > 0);
            assert_answers_agree(materials[i], light, both);
            assert_answers_agree(materials[i], reflection, both);
        }
}

/* A mixture answers with the mean of its materials, whether one of both is drawn or not. */
static void mixtures_are_means(void **state) {
    (void)state;
    static const struct {
        const char *fore, *back; /* types, and what follows the name */
        const char *fore_values, *back_values;
    } pairs[] = {
        {"plastic", "plastic", "0 0 5 .8 .2 .2 0 0", "0 0 5 .1 .5 .2 0 0"},
        {"plastic", "metal", "0 0 5 .8 .2 .2 0 0", "0 0 5 .1 .5 .2 .7 .3"},
        {"plastic", "metal", "0 0 5 .8 .2 .2 .1 .1", "0 0 5 .1 .5 .2 .7 .3"},
        {"plastic", "metal", "0 0 5 .8 .2 .2 .1 0", "0 0 5 .1 .5 .2 .7 .3"},
        {"plastic", "glass", "0 0 5 .8 .2 .2 .1 .1", "0 0 3 .9 .8 .7"},
        {"dielectric", "plastic", "0 0 5 .9 .8 .7 1.3 0", "0 0 5 .8 .2 .2 .1 .1"},
        {"prism1", "dielectric", "5 .8 Dx+.2 Dy Dz . 0 0", "0 0 5 .9 .8 .7 1.3 0"},
        {"transfunc", "plastic", "2 max . 0 6 .7 .6 .5 .2 .6 .7", "0 0 5 .8 .2 .2 0 0"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        for (int bounces = 0; bounces <= 1; bounces++) {
            char fore[200], back[200], both[400];
            snprintf(fore, sizeof fore, "void %s m %s", pairs[i].fore, pairs[i].fore_values);
            snprintf(back, sizeof back, "void %s m %s", pairs[i].back, pairs[i].back_values);
            snprintf(both, sizeof both, "void %s a %s void %s b %s void mixfunc m 4 a b .3 . 0 0", pairs[i].fore,
                     pairs[i].fore_values, pairs[i].back, pairs[i].back_values);
            graze_answer f = answer_of(fore, GRAZE_STRATEGY_MIS, bounces, 0.3);
            graze_answer b = answer_of(back, GRAZE_STRATEGY_MIS, bounces, 0.3);
            const graze_answer mean = {
                .value = rgb_add_scaled(rgb_scale(0.3, f.value), 0.7, b.value),
                .standard_error = rgb_add_scaled(rgb_scale(0.3, f.standard_error), 0.7, b.standard_error),
            };
            assert_answers_agree(both, answer_of(both, GRAZE_STRATEGY_MIS, bounces, 0.3), mean);
        }
}

/* The lamp shines on the floor by way of a mirror with a pattern, on a function, and through mist. */
static void strategies_agree_about_light_by_mirrors(void **state) {
    (void)state;
    static const char *const pairs[] = {
        "void colorfunc p 4 .5+.4*sin(3*Px) .7 Pz . 0 0 p mirror q 0 0 3 .9 .8 .7 void plastic m 0 0 5 .5 .4 .3 .1 .2",
        "void mirror q 0 0 3 .9 .8 .7 void plasfunc m 2 max . 0 4 0 0 0 .3",
        "void plastic q 0 0 5 0 0 0 0 0 void plasfunc m 2 max . 0 4 0 0 0 .3", /* for comparison */
    };
    const vec3 eye = {0.2, -2, 1.5};
    const graze_ray ray = {.origin = eye, .direction = vec3_subtract(vec3_make(0.1, 1.2, 0), eye)};
    for (int mist = 0; mist < 2; mist++) {
        graze_answer answers[3];
        for (int pair = 0; pair < 3; pair++) {
            char text[1000];
            snprintf(
                text, sizeof text,
                "%s q polygon wall 0 0 12 -2 2 0 2 2 0 2 2 3 -2 2 3 m polygon floor 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 2 0 "
                "void light l 0 0 3 40 30 20 l sphere lamp 0 0 4 .5 .6 1.5 .4",
                pairs[pair]);
            graze_trace_settings settings = graze_trace_defaults();
            settings.samples = 20000;
            settings.mist_extinction = rgb_gray(mist ? 0.2 : 0);
            graze_answer both = answer_along(text, &settings, ray);
            settings.strategy = GRAZE_STRATEGY_LIGHT;
            assert_answers_agree(pairs[pair], answer_along(text, &settings, ray), both);
            settings.strategy = GRAZE_STRATEGY_BRDF;
            assert_answers_agree(pairs[pair], answer_along(text, &settings, ray), both);
            answers[pair] = both;
        }
        assert_true(answers[1].value.g > 1.05 * answers[2].value.g);
    }
}

/* Void in a mixture is as clear as glass that does not refract: before a surface that reflects, one that transmits
 * straight on or diffusely, and one whose rough transmission leaves it to chance. */
static void void_is_clear(void **state) {
    (void)state;
    const char *const others[] = {
        "plastic a 0 0 5 .8 .2 .2 .1 .1",
        "metal a 0 0 5 .8 .2 .2 .7 0",
        "glass a 0 0 3 .9 .8 .7",
        "trans a 0 0 7 .9 .8 .7 .05 .3 .6 .7",
        "transfunc a 2 max . 0 6 .7 .6 .5 .2 .6 .7",
        "dielectric a 0 0 5 .9 .8 .7 1.3 0",
        "prism1 a 5 .8 Dx+.2 Dy -Dz . 0 0",
        "BRTDfunc a 10 .1 .2 .3 .5 .4 .3 max max max . 0 9 .1 .1 .1 0 0 0 .1 .1 .1",
    };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        for (int bounces = 0; bounces <= 1; bounces++) {
            char clear[400], nothing[400];
            const char *order = i % 2 ? "m 4 %s a .4" : "m 4 a %s .6";
            char mixed[2][40];
            snprintf(mixed[0], sizeof mixed[0], order, "b");
            snprintf(mixed[1], sizeof mixed[1], order, "void");
            snprintf(clear, sizeof clear, "void %s void glass b 0 0 4 1 1 1 1 void mixfunc %s . 0 0", others[i],
                     mixed[0]);
            snprintf(nothing, sizeof nothing, "void %s void mixfunc %s . 0 0", others[i], mixed[1]);
            graze_answer c = answer_of(clear, GRAZE_STRATEGY_MIS, bounces, 0.3);
            assert_answers_agree(nothing, answer_of(nothing, GRAZE_STRATEGY_MIS, bounces, 0.3), c);
        }
}

/* A pattern alone, in a mixture, is as clear. */
static void a_pattern_without_a_material_is_void(void **state) {
    (void)state;
    const char *const plain = "void plastic a 0 0 5 .8 .2 .2 .1 .1 void mixfunc m 4 a void .4 . 0 0";
    graze_answer nothing = answer_of(plain, GRAZE_STRATEGY_MIS, 1, 0.3);
    graze_answer pattern = answer_of("void brightfunc p 2 .3 . 0 0 void plastic a 0 0 5 .8 .2 .2 .1 .1 "
                                     "void mixfunc m 4 a p .4 . 0 0",
                                     GRAZE_STRATEGY_MIS, 1, 0.3);
    assert_memory_equal(&nothing, &pattern, sizeof nothing);
}

/* What is seen through a textured pane is seen in another direction, and what lights it is not: the floor behind a pane
 * whose texture is the same everywhere is that at another place, lit by the same. */
static void textures_bend_what_is_seen(void **state) {
    (void)state;
    static const struct {
        const char *material;
        double bent; /* by so much of the perturbation */
    } panes[] = {
        {"t glass p 0 0 4 1 1 1 1.25", 0.5},
        {"t trans p 0 0 7 1 1 1 0 0 1 1", 1},
        {"t BRTDfunc p 10 0 0 0 1 1 1 0 0 0 . 0 9 0 0 0 0 0 0 0 0 0", 1},
    };
    for (size_t i = 0; i < sizeof panes / sizeof *panes; i++) {
        char text[600];
        snprintf(
            text, sizeof text,
            "void brightfunc b 2 noneg(Px) . 0 0 b glow g 0 0 4 1 1 1 0 g polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 "
            "9 0 void texfunc t 4 -.2 0 0 . 0 0 %s p polygon pane 0 0 12 -9 -9 4 9 -9 4 9 9 4 -9 9 4",
            panes[i].material);
        graze_trace_settings settings = graze_trace_defaults();
        settings.samples = 4096;
        graze_answer found = answer_along(text, &settings, (graze_ray){.origin = {1, 0, 5}, .direction = {0, 0, -1}});
        /* Glass lets through what it does at the angle that its normal leans to; whether it mirrors instead is chance.
         */
        const graze_material glass = {.kind = GRAZE_GLASS, .color = {1, 1, 1}, .refraction = 1.25};
        double left = i == 0 ? graze_material_straight_through(&glass, 1 / sqrt(1.04)).g : 1;
        double seen = left * (1 + 4 * 0.2 * panes[i].bent);
        assert_true(found.standard_error.g < 0.01);
        if (!(fabs(found.value.g - seen) <= 4.5 * found.standard_error.g + 1e-9))
            fail_msg("%s: sees %.9g, not %.9g", panes[i].material, found.value.g, seen);
    }
}

/* A reflectance function of which no part counts is a diffuse surface. */
static void a_function_without_weight_is_diffuse(void **state) {
    (void)state;
    graze_answer plain = answer_of("void plastic m 0 0 5 .5 .5 .5 0 0", GRAZE_STRATEGY_MIS, 1, 0.3);
    graze_answer function = answer_of("void metfunc m 2 select . 0 4 .5 .5 .5 0", GRAZE_STRATEGY_MIS, 1, 0.3);
    assert_answers_agree("no function", function, plain);
    function =
        answer_of("void brightfunc p 2 2 . 0 0 p metfunc m 2 if . 0 4 .25 .25 .25 0", GRAZE_STRATEGY_MIS, 1, 0.3);
    assert_answers_agree("no function, a pattern", function, plain);
}

static void a_pattern_of_1_changes_nothing(void **state) {
    (void)state;
    graze_answer plain = answer_of("void plastic m 0 0 5 .5 .5 .5 0 0", GRAZE_STRATEGY_MIS, 1, 0.3);
    graze_answer one =
        answer_of("void brightfunc p 2 1 . 0 0 p plastic m 0 0 5 .5 .5 .5 0 0", GRAZE_STRATEGY_MIS, 1, 0.3);
    assert_memory_equal(&plain, &one, sizeof plain);
}

/* Neither its first material nor its second, bright as they are. */
static void mixtures_without_a_share_are_not_there(void **state) {
    (void)state;
    graze_answer through = answer_of("void plastic a 0 0 5 .8 .8 .8 .1 0 void metal b 0 0 5 .8 .8 .8 .8 .3 "
                                     "void mixfunc m 4 a b 1/(Px-Px) . 0 0",
                                     GRAZE_STRATEGY_MIS, 1, 0.9);
    assert_non_null(strstr(messages, "mixfunc m: compute error"));
    assert_true(through.value.r == 4 && through.value.g == 3 && through.value.b == 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strategies_agree),
        cmocka_unit_test(mixtures_are_means),
        cmocka_unit_test(strategies_agree_about_light_by_mirrors),
        cmocka_unit_test(void_is_clear),
        cmocka_unit_test(a_pattern_without_a_material_is_void),
        cmocka_unit_test(textures_bend_what_is_seen),
        cmocka_unit_test(a_function_without_weight_is_diffuse),
        cmocka_unit_test(a_pattern_of_1_changes_nothing),
        cmocka_unit_test(mixtures_without_a_share_are_not_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
