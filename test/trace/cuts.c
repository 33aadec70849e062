/* What antimatter leaves of other surfaces. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/vector.h"
#include "graze/trace.h"
#include "support/scene_text.h"

static const char *const bodies =
    "void plastic p 0 0 5 .5 .5 .5 0 0 void plastic q 0 0 5 .2 .3 .4 0 0 p sphere ball 0 0 4 0 0 0 1 "
    "p polygon wall 0 0 12 -3 3 -3 3 3 -3 3 3 3 -3 3 3 ";

/* What a ray along y meets. */
static void assert_met_in(const char *text, double x, double distance, const char *surface, double normal_y) {
    graze_scene *scene = load_scene(text);
    graze_trace_settings settings = graze_trace_defaults();
    const graze_ray ray = {.origin = {x, -5, 0}, .direction = {0, 1, 0}};
    graze_hit hit;
    graze_cast(scene, &settings, &ray, &hit);
    if (!hit.surface || strcmp(hit.surface, surface) || fabs(hit.distance - distance) > 1e-9 ||
        fabs(hit.shading_normal.y - normal_y) > 1e-9)
        fail_msg("%s: %s at %g, normal %g", text, hit.surface ? hit.surface : "nothing", hit.distance,
                 hit.shading_normal.y);
    graze_scene_destroy(scene);
}

static void assert_met(const char *antimatter, double x, double distance, const char *surface, double normal_y) {
    char text[2000];
    snprintf(text, sizeof text, "%s%s", bodies, antimatter);
    assert_met_in(text, x, distance, surface, normal_y);
}

#define ENDS "a ring e 0 0 8 0 -2 0 0 -1 0 0 .5 a ring f 0 0 8 0 2 0 0 1 0 0 .5"

static void bodies_are_cut(void **state) {
    (void)state;
    assert_met("", 0, 4, "ball", -1);
    assert_met("void antimatter a 1 p 0 0 a sphere s 0 0 4 0 -1 0 .5", 0, 4.5, "s", -1);
    /* Without a face: the ball's far side from inside. */
    assert_met("void antimatter a 2 void p 0 0 a sphere s 0 0 4 0 -1 0 .5", 0, 6, "ball", -1);
    /* All through, and beside. */
    assert_met("void antimatter a 1 p 0 0 a cylinder s 0 0 7 0 -2 0 0 2 0 .5 " ENDS, 0, 8, "wall", -1);
    assert_met("void antimatter a 1 p 0 0 a cylinder s 0 0 7 0 -2 0 0 2 0 .5 " ENDS, 0.6, 4.2, "ball", -0.8);
    /* Another body is not cut, nor is there a face outside of all. */
    assert_met("void antimatter a 1 q 0 0 a sphere s 0 0 4 0 -1 0 .5", 0, 4, "ball", -1);
    assert_met("void antimatter a 1 p 0 0 a sphere s 0 0 4 0 -3 0 .5", 0, 4, "ball", -1);
    /* Two that abut. */
    assert_met("void antimatter a 2 void p 0 0 a ring e 0 0 8 0 -2 0 0 -1 0 0 .5 a ring f 0 0 8 0 0 0 0 1 0 0 .5 "
               "void antimatter b 2 void p 0 0 b ring g 0 0 8 0 0 0 0 -1 0 0 .5 b ring h 0 0 8 0 2 0 0 1 0 0 .5",
               0, 8, "wall", -1);
    /* Where two overlap, the farther one closes the body. */
    assert_met(
        "void antimatter a 1 p 0 0 a sphere s 0 0 4 0 -1 0 .5 void antimatter b 1 p 0 0 b sphere t 0 0 4 0 -.4 0 .3", 0,
        4.9, "t", -1);
}

/* The order of surfaces does not matter, nor does it with several antimatters. */
static void bodies_are_cut_in_any_order(void **state) {
    (void)state;
    const char *const head = "void plastic p 0 0 5 .5 .5 .5 0 0 void antimatter a 1 p 0 0 void antimatter b 1 p 0 0 ";
    static const char *const surfaces[] = {"a sphere s 0 0 4 0 -1 0 .5 ", "b sphere t 0 0 4 0 -.4 0 .3 ",
                                           "p sphere ball 0 0 4 0 0 0 1 "};
    static const int orders[][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (size_t i = 0; i < sizeof orders / sizeof *orders; i++) {
        char text[500];
        snprintf(text, sizeof text, "%s%s%s%s", head, surfaces[orders[i][0]], surfaces[orders[i][1]],
                 surfaces[orders[i][2]]);
        assert_met_in(text, 0, 4.9, "t", -1);
        assert_met_in(text, 0.4, 5 - 1 + 0.3, "s", -0.6);
    }
}

/* A room seen through a hole that antimatter makes is as bright as one with the hole left open. */
static void light_comes_through_holes(void **state) {
    (void)state;
    static const char *const scenes[] = {
        "p polygon lid 0 0 30 -1 -1 1 1 -1 1 1 1 1 -1 1 1 -1 -1 1 -.5 -.5 1 -.5 .5 1 .5 .5 1 .5 -.5 1 -.5 -.5 1 ",
        "p polygon lid 0 0 12 -1 -1 1 1 -1 1 1 1 1 -1 1 1 void antimatter a 2 void p 0 0 "
        "a polygon x0 0 0 12 -.5 -.5 .9 -.5 -.5 1.1 -.5 .5 1.1 -.5 .5 .9 "
        "a polygon x1 0 0 12 .5 -.5 .9 .5 .5 .9 .5 .5 1.1 .5 -.5 1.1 "
        "a polygon y0 0 0 12 -.5 -.5 .9 .5 -.5 .9 .5 -.5 1.1 -.5 -.5 1.1 "
        "a polygon y1 0 0 12 -.5 .5 .9 -.5 .5 1.1 .5 .5 1.1 .5 .5 .9 "
        "a polygon z0 0 0 12 -.5 -.5 .9 -.5 .5 .9 .5 .5 .9 .5 -.5 .9 "
        "a polygon z1 0 0 12 -.5 -.5 1.1 .5 -.5 1.1 .5 .5 1.1 -.5 .5 1.1 "};
    graze_answer answers[2];
    for (int i = 0; i < 2; i++) {
        char text[3000];
        snprintf(text, sizeof text,
                 "void plastic p 0 0 5 .5 .5 .5 0 0 void plastic w 0 0 5 .5 .4 .3 .1 .2 void light l 0 0 3 9 8 7 "
                 "w polygon floor 0 0 12 -1 -1 0 1 -1 0 1 1 0 -1 1 0 l sphere lamp 0 0 4 .3 .4 2 .3 "
                 "void glow g 0 0 4 1 2 3 0 g source sky 0 0 4 0 0 1 180 %s",
                 scenes[i]);
        graze_scene *scene = load_scene(text);
        graze_trace_settings settings = graze_trace_defaults();
        settings.ambient_bounces = 2;
        settings.samples = 20000;
        const graze_ray ray = {.origin = {0, -2, 0.5}, .direction = {0.1, 2, -0.5}};
        graze_trace(scene, &settings, &ray, 7, &answers[i], NULL);
        graze_scene_destroy(scene);
    }
    double error = hypot(answers[0].standard_error.g, answers[1].standard_error.g);
    assert_true(answers[0].value.g > 0.1);
    if (!(fabs(answers[0].value.g - answers[1].value.g) <= 4.5 * error))
        fail_msg("%g and %g, +- %g", answers[0].value.g, answers[1].value.g, error);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_are_cut),
        cmocka_unit_test(bodies_are_cut_in_any_order),
        cmocka_unit_test(light_comes_through_holes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
