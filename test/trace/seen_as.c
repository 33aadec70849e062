/* What is seen as something else, or elsewhere: illum, mirrors with an alternate material, prisms. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "one_ray.h"

/* A glossy floor before a wall; and a box's worth of things above it. */
static const char *const around = "void plastic m 0 0 5 .5 .4 .3 .1 .2 m polygon floor 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 "
                                  "2 0 void plastic w 0 0 5 .5 .6 .7 0 0 w polygon wall 0 0 12 -2 2 0 2 2 0 2 2 3 -2 2 "
                                  "3 ";

static graze_answer answer_of(const char *things, graze_strategy strategy, int bounces, vec3 eye, vec3 target) {
    char text[3000];
    snprintf(text, sizeof text, "%s %s", around, things);
    graze_trace_settings settings = graze_trace_defaults();
    settings.strategy = strategy;
    settings.ambient_bounces = bounces;
    settings.samples = 20000;
    return answer_along(text, &settings, (graze_ray){.origin = eye, .direction = vec3_subtract(target, eye)});
}

#define PANE(modifier) modifier " polygon pane 0 0 12 -1 -1 1.5 -1 1 1.5 1 1 1.5 1 -1 1.5 "
#define LAMPS                                                                                                          \
    "void glow g 0 0 4 1 2 3 0 g ring sky 0 0 8 0 0 2 0 0 -1 0 1 void light l 0 0 3 40 30 20 l sphere lamp 0 0 4 1 "   \
    ".5 2 .3 "

static void strategies_agree_about_illums(void **state) {
    (void)state;
    static const char *const things[] = {
        LAMPS "void illum i 0 0 3 2 1 1 " PANE("i"),
        LAMPS "void glass q 0 0 3 .8 .7 .6 void illum i 1 q 0 3 2 1 1 " PANE("i"),
        LAMPS "void trans q 0 0 7 .8 .7 .6 .05 .1 .6 .5 void illum i 1 q 0 3 2 1 1 " PANE("i"),
        LAMPS "void plastic q 0 0 5 .8 .7 .6 0 0 void illum i 1 q 0 3 2 1 1 " PANE("i"),
        LAMPS "void glass q 0 0 3 .8 .7 .6 void illum i 1 void 0 3 2 1 1 q polygon n 0 0 12 -1 -1 1 -1 1 1 1 1 1 1 -1 "
              "1 " PANE("i"),
    };
    for (size_t i = 0; i < sizeof things / sizeof *things; i++)
        for (int bounces = 0; bounces <= 1; bounces++) {
            const vec3 eye = {0.2, -2, 0.8}, target = {0.1, 0.2, 0};
            graze_answer both = answer_of(things[i], GRAZE_STRATEGY_MIS, bounces, eye, target);
            assert_answers_agree(things[i], both, answer_of(things[i], GRAZE_STRATEGY_LIGHT, bounces, eye, target));
            assert_answers_agree(things[i], both, answer_of(things[i], GRAZE_STRATEGY_BRDF, bounces, eye, target));
            assert_true(rgb_brightness(both.value) > 0);
        }
}

/* As its alternate material; or as nothing at all, from both sides. */
static void illums_are_seen_as_others(void **state) {
    (void)state;
    static const struct {
        const char *illum, *other;
    } pairs[] = {
        {"void illum i 0 0 3 2 1 1 " PANE("i"), ""},
        {"void illum i 1 void 0 3 2 1 1 " PANE("i"), ""},
        {"void glass q 0 0 3 .8 .7 .6 void illum i 1 q 0 3 2 1 1 " PANE("i"), "void glass q 0 0 3 .8 .7 .6 " PANE("q")},
        {"void colorfunc p 4 Px .5 1 . 0 0 p plastic q 0 0 5 .8 .7 .6 0 0 void illum i 1 q 0 3 2 1 1 " PANE("i"),
         "void colorfunc p 4 Px .5 1 . 0 0 p plastic q 0 0 5 .8 .7 .6 0 0 " PANE("q")},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        for (int above = 0; above < 2; above++) {
            char with[1000], without[1000];
            /* Nothing but what is bright by itself; and a lamp beside it, for what reflects. */
            const char *bright = "void glow g 0 0 4 1 2 3 -1 g ring sky 0 0 8 0 0 2.5 0 0 -1 0 2 g ring ground 0 0 8 0 "
                                 "0 .5 0 0 1 0 2 void light l 0 0 3 40 30 20 l sphere lamp 0 0 4 1.5 0 2.2 .1 l sphere "
                                 "low 0 0 4 1.5 0 .9 .1 ";
            snprintf(with, sizeof with, "%s%s", bright, pairs[i].illum);
            snprintf(without, sizeof without, "%s%s", bright, pairs[i].other);
            const vec3 eye = {0.2, -0.3, above ? 2.4 : 0.6}, target = {0.3, 0.2, 1.5};
            graze_answer a = answer_of(with, GRAZE_STRATEGY_MIS, 0, eye, target);
            graze_answer b = answer_of(without, GRAZE_STRATEGY_MIS, 0, eye, target);
            assert_answers_agree(pairs[i].illum, a, b);
            assert_true(rgb_brightness(a.value) > 0);
        }
}

/* A prism that mirrors is a mirror, and one that lets rays straight through a sheet that does so. */
static void prisms_do_what_their_functions_say(void **state) {
    (void)state;
    static const struct {
        const char *prism, *other;
    } pairs[] = {
        {"void prism1 i 5 if(Rdot,.7,0) Dx Dy -Dz . 0 0 ", "void mirror i 0 0 3 .7 .7 .7 "},
        {"void prism1 i 7 if(Rdot,A1,0) Dx -Dy Dz . -rx 90 0 1 .7 ", "void mirror i 0 0 3 .7 .7 .7 "},
        {"void prism1 i 5 .7 Dx Dy Dz . 0 0 ", "void trans i 0 0 7 .7 .7 .7 0 0 1 1 "},
        {"void prism2 i 9 .3 Dx Dy Dz .4 Dx*2 Dy*2 Dz*2 . 0 0 ", "void trans i 0 0 7 .7 .7 .7 0 0 1 1 "},
        {"void prism1 i 5 if(Py,.7,-1) Dx Dy Dz . 0 0 ",
         "void trans s 0 0 7 .7 .7 .7 0 0 1 1 void plastic b 0 0 5 0 0 0 0 0 void mixfunc i 4 s b if(Py,1,0) . 0 0 "},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        for (int bounces = 0; bounces <= 1; bounces++) {
            char prism[1000], other[1000];
            const char *lights =
                "void light l 0 0 3 4 3 2 l sphere above 0 0 4 1 .5 2.5 .7 l sphere below 0 0 4 -1 -.5 "
                ".7 .5 void glow g 0 0 4 1 2 3 0 g source sky 0 0 4 0 0 1 180 ";
            snprintf(prism, sizeof prism, "%s%s%s", lights, pairs[i].prism, PANE("i"));
            snprintf(other, sizeof other, "%s%s%s", lights, pairs[i].other, PANE("i"));
            const vec3 eye = {0.2, -2, 0.8}, target = {0.1, 0.2, 0};
            graze_answer b = answer_of(other, GRAZE_STRATEGY_BRDF, bounces, eye, target);
            for (int strategy = 0; strategy < 3; strategy++) {
                const graze_strategy all[] = {GRAZE_STRATEGY_MIS, GRAZE_STRATEGY_LIGHT, GRAZE_STRATEGY_BRDF};
                assert_answers_agree(pairs[i].prism, answer_of(prism, all[strategy], bounces, eye, target), b);
            }
            assert_true(rgb_brightness(b.value) > 0);
        }
}

static void strategies_agree_about_mirrors_with_alternates(void **state) {
    (void)state;
    static const char *const mirrors[] = {
        "void mirror i 1 void 0 3 .9 .8 .7 ",
        "void plastic q 0 0 5 .2 .3 .4 .1 .2 void mirror i 1 q 0 3 .9 .8 .7 ",
        "void glass q 0 0 3 .8 .7 .6 void mirror i 1 q 0 3 .9 .8 .7 ",
        "void glass q 0 0 3 .8 .7 .6 void mirror n 1 q 0 3 .9 .8 .7 void mirror i 1 n 0 3 .9 .8 .7 ",
    };
    for (size_t i = 0; i < sizeof mirrors / sizeof *mirrors; i++)
        for (int bounces = 0; bounces <= 1; bounces++) {
            char things[1000];
            snprintf(things, sizeof things,
                     "%s%svoid light l 0 0 3 4 3 2 l sphere high 0 0 4 1 .5 2.5 .3 l sphere low 0 0 4 -1 -.5 .7 .5 "
                     "void glow g 0 0 4 1 2 3 0 g source sky 0 0 4 0 0 1 180 ",
                     mirrors[i], PANE("i"));
            const vec3 eye = {0.2, -2, 0.8}, target = {0.1, 0.2, 0};
            graze_answer both = answer_of(things, GRAZE_STRATEGY_MIS, bounces, eye, target);
            assert_answers_agree(things, both, answer_of(things, GRAZE_STRATEGY_LIGHT, bounces, eye, target));
            assert_answers_agree(things, both, answer_of(things, GRAZE_STRATEGY_BRDF, bounces, eye, target));
            assert_true(rgb_brightness(both.value) > 0);
        }
}

/* Lamps in panes of glass: small ones and large ones, few and many; what is behind other panes, seen by gloss, and from
 * behind; panes in one plane, and in many. */
static void strategies_agree_about_light_by_panes(void **state) {
    (void)state;
#define GLASS "void glass i 0 0 3 .8 .7 .6 "
#define LAMP  "void light l 0 0 3 40 30 20 l sphere lamp 0 0 4 .4 .3 .9 .3 "
    static const char *const things[] = {
        GLASS LAMP PANE("i"),
        "void colorfunc p 4 Px .5 1 . 0 0 p glass i 0 0 4 .8 .7 .6 1.8 " LAMP PANE("i"),
        GLASS LAMP "i polygon pane 0 0 12 -1 -1 1.5 1 -1 1.5 1 1 1.5 -1 1 1.5 ",
        GLASS LAMP "i ring pane 0 0 8 .3 .2 1.5 .1 .1 1 .2 .9 i ring other 0 0 8 .3 .2 1.3 .1 .1 1 0 .9 ",
        GLASS "void glow l 0 0 4 40 30 20 0 l sphere lamp 0 0 4 .4 .3 .9 .3 " PANE("i"),
        GLASS LAMP PANE("i") "void glow g 0 0 4 1 2 3 0 g source sky 0 0 4 0 0 -1 180 ",
        GLASS LAMP PANE("i") "l sphere a 0 0 4 -.4 .3 .9 .1 l sphere b 0 0 4 -.4 -.3 .9 .1 l sphere c 0 0 4 0 0 1 .1 "
                             "l sphere d 0 0 4 -.4 0 .9 .1 l sphere e 0 0 4 0 -.3 .9 .1 l sphere f 0 0 4 0 .3 1 .1 "
                             "l sphere g 0 0 4 -.6 0 .9 .1 l sphere h 0 0 4 0 -.6 .9 .1 ",
        GLASS LAMP PANE("i") "i polygon b 0 0 12 1 -1 1.5 1 1 1.5 3 1 1.5 3 -1 1.5 i polygon c 0 0 12 -1 -1 1.6 -1 1 "
                             "1.6 1 1 1.6 1 -1 1.6 i polygon d 0 0 12 -1 1 0 1 1 0 1 1 2 -1 1 2 i polygon e 0 0 12 1 "
                             "-1 0 1 1 0 1 1 2 1 -1 2 i polygon f 0 0 12 -1 -1 0 -1 1 0 -1 1 2 -1 -1 2 ",
    };
    static const char *const floors[] = {"void plastic m 0 0 5 .5 .4 .3 .1 .2 ", "void metal m 0 0 5 .5 .4 .3 .8 .3 "};
    for (size_t i = 0; i < sizeof things / sizeof *things; i++)
        for (int bounces = 0; bounces <= 1; bounces++) {
            char text[1500];
            snprintf(text, sizeof text, "%s m polygon floor 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 2 0 %s", floors[i % 2],
                     things[i]);
            const vec3 eye = {0.2, -2, 0.8};
            const graze_ray ray = {.origin = eye, .direction = vec3_subtract((vec3){0.1, 0.2, 0}, eye)};
            graze_trace_settings settings = graze_trace_defaults();
            settings.ambient_bounces = bounces;
            settings.samples = 40000;
            settings.back_faces_visible = i != 2;
            const graze_answer both = answer_along(text, &settings, ray);
            settings.strategy = GRAZE_STRATEGY_LIGHT;
            assert_answers_agree(text, both, answer_along(text, &settings, ray));
            settings.strategy = GRAZE_STRATEGY_BRDF;
            assert_answers_agree(text, both, answer_along(text, &settings, ray));
            assert_true(rgb_brightness(both.value) > 0);
        }
}

/* To the eye it is that material, and throws no light back that it had not. */
static void mirrors_are_seen_as_others(void **state) {
    (void)state;
    const char *lights = "void glow g 0 0 4 1 2 3 0 g source sky 0 0 4 0 0 1 180 void light l 0 0 3 40 30 20 l sphere "
                         "lamp 0 0 4 1.5 0 .9 .1 void plastic q 0 0 5 .2 .3 .4 .1 .2 ";
    char with[1000], without[1000];
    for (int kind = 0; kind < 2; kind++)
        for (int above = 0; above < 2; above++) {
            snprintf(with, sizeof with, "%svoid mirror i 1 %s 0 3 .9 .8 .7 %s", lights, kind ? "void" : "q", PANE("i"));
            snprintf(without, sizeof without, "%s%s", lights, kind ? "" : PANE("q"));
            const vec3 eye = {0.2, -0.3, above ? 2.4 : 0.6}, target = {0.3, 0.2, 1.5};
            if (kind && above)
                continue; /* it sees the floor, which the mirror lights */
            assert_answers_agree(with, answer_of(with, GRAZE_STRATEGY_MIS, 0, eye, target),
                                 answer_of(without, GRAZE_STRATEGY_MIS, 0, eye, target));
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strategies_agree_about_illums),
        cmocka_unit_test(illums_are_seen_as_others),
        cmocka_unit_test(strategies_agree_about_mirrors_with_alternates),
        cmocka_unit_test(strategies_agree_about_light_by_panes),
        cmocka_unit_test(mirrors_are_seen_as_others),
        cmocka_unit_test(prisms_do_what_their_functions_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
