/* Windows: which panes are, to which side they are turned, and how points choose among them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/angle.h"
#include "graze/brdf_light.h"
#include "scene/windows.h"
#include "support/dice.h"
#include "support/scene_text.h"

#define GLASS  "void glass clear 0 0 3 .96 .96 .96 void plastic w 0 0 5 .5 .5 .5 0 0 void glow g 0 0 4 1 1 1 0\n"
#define SKY    "g source sky 0 0 4 0 0 1 180\n"
#define GROUND "w polygon ground 0 0 12 -50 -50 -.1 50 -50 -.1 50 50 -.1 -50 50 -.1\n"

/* 4 x 4 x 3; open at y = 0, but for what is put there. */
#define ROOM                                                                                                           \
    "w polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0 w polygon ceiling 0 0 12 0 0 3 0 4 3 4 4 3 4 0 3\n"                \
    "w polygon west 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3 w polygon east 0 0 12 4 0 0 4 0 3 4 4 3 4 4 0\n"                    \
    "w polygon north 0 0 12 0 4 0 4 4 0 4 4 3 0 4 3\n"

static window_choice choice_at(const graze_scene *scene, vec3 point, vec3 normal, int draws) {
    window_choice c = {.count = 0};
    assert_non_null(scene->windows);
    window_choice_prepare(&c, scene, point, normal, draws);
    return c;
}

static bool has_windows(const char *text) {
    graze_scene *scene = load_scene(text);
    bool has = scene->windows != NULL;
    graze_scene_destroy(scene);
    return has;
}

/* Seen from inside, whichever way the pane's own normal points; not from outside. */
static void windows_are_seen_from_inside(void **state) {
    (void)state;
    const char *const panes[] = {"clear polygon p 0 0 12 0 0 0 4 0 0 4 0 3 0 0 3\n",
                                 "clear polygon p 0 0 12 0 0 0 0 0 3 4 0 3 4 0 0\n"};
    for (int i = 0; i < 2; i++) {
        char text[2000];
        (void)snprintf(text, sizeof text, GLASS SKY GROUND ROOM "%s", panes[i]);
        graze_scene *scene = load_scene(text);
        const vec3 up = {0, 0, 1}, down = {0, 0, -1}, away = {0, 1, 0};
        assert_int_equal(choice_at(scene, vec3_make(2, 2, 0), up, 4).count, 1);
        assert_int_equal(choice_at(scene, vec3_make(2, 2, 3), down, 4).count, 1);
        assert_int_equal(choice_at(scene, vec3_make(2, -2, 0), up, 4).count, 0);
        assert_int_equal(choice_at(scene, vec3_make(2, 3, 1), away, 4).count, 0);
        graze_scene_destroy(scene);
    }
}

static void what_is_no_window(void **state) {
    (void)state;
#define PANE "clear polygon p 0 0 12 0 0 0 4 0 0 4 0 3 0 0 3\n"
    assert_true(has_windows(GLASS SKY GROUND ROOM PANE));
    assert_false(has_windows(GLASS GROUND ROOM PANE));  /* no sky */
    assert_false(has_windows(GLASS SKY GROUND PANE));   /* a pane in the open */
    assert_false(has_windows(GLASS SKY GROUND ROOM PANE /* a wall before it */
                             "w polygon front 0 0 12 -1 -.01 -1 -1 -.01 4 5 -.01 4 5 -.01 -1\n"));
    assert_false(has_windows(GLASS SKY GROUND ROOM)); /* an opening */
    assert_false(has_windows("void glass clear 0 0 3 .96 .96 .96 void glow g 0 0 4 1 1 1 0 g source sun 0 0 4 0 -1 1 9 "
                             "void plastic w 0 0 5 .5 .5 .5 0 0 " GROUND ROOM PANE));
}

/* The densities of the draws are what they are drawn by: their integral, and that of the cosine, over all directions by
 * draws and by the windows' closed forms. Of more windows than a point looks at, those that it sees most of. */
static void densities_are_of_the_draws(void **state) {
    (void)state;
    char text[9000];
    int length = snprintf(text, sizeof text, GLASS SKY GROUND ROOM);
    enum { ACROSS = 16, PANES = 6 * ACROSS };
    vec3 corners[PANES][4];
    for (int i = 0; i < PANES; i++) {
        double x = i % ACROSS * 0.25, z = i / ACROSS * 0.5;
        const vec3 of[4] = {{x, 0, z}, {x + 0.1875, 0, z}, {x + 0.1875, 0, z + 0.5}, {x, 0, z + 0.5}};
        memcpy(corners[i], of, sizeof of);
        length += snprintf(text + length, sizeof text - (size_t)length,
                           "clear polygon p%d 0 0 12 %g 0 %g %g 0 %g %g 0 %g %g 0 %g\n", i, of[0].x, of[0].z, of[1].x,
                           of[1].z, of[2].x, of[2].z, of[3].x, of[3].z);
    }
    graze_scene *scene = load_scene(text);
    dice d = {5};
    const vec3 point = {1.2, 1, 0}, up = {0, 0, 1};
    for (int draws = 1; draws <= WINDOWS_SEEN_MOST; draws += WINDOWS_SEEN_MOST - 1) {
        const window_choice c = choice_at(scene, point, up, draws);
        assert_int_equal(c.count, WINDOWS_SEEN_MOST);
        double expected = 0, irradiance = 0;
        for (int i = 0; i < c.count; i++)
            expected += c.expectation[i];
        assert_true(fabs(expected - (draws == 1 ? 1 : c.count)) < 1e-12);
        enum { MANY = 100000 };
        for (int i = 0; i < MANY; i++) {
            const double random[2] = {roll(&d), roll(&d)};
            int which = draws == 1 ? window_choose(&c, roll(&d)) : i % c.count;
            vec3 direction;
            assert_true(window_draw(&c, which, random, &direction));
            double density = window_density(&c, direction);
            assert_true(density > 0 && direction.y < 0);
            irradiance += direction.z / density * (draws == 1 ? 1 : c.count) / MANY;
        }
        double truth = 0, all = 0;
        for (int i = 0; i < PANES; i++) {
            bool looked_at = false;
            vec3 seen[4];
            for (int k = 0; k < c.count; k++)
                looked_at = looked_at || c.index[k] == i;
            for (int k = 0; k < 4; k++)
                seen[k] = vec3_subtract(corners[i][k], point);
            if (looked_at)
                truth += PI * graze_diffuse_polygon(seen, 4);
            all += PI * graze_diffuse_polygon(seen, 4);
        }
        if (!(fabs(irradiance - truth) < 0.005 * truth))
            fail_msg("%g, but %g", irradiance, truth);
        assert_true(truth > 1.1 * all * WINDOWS_SEEN_MOST / PANES); /* those that it sees most of */
    }
    graze_scene_destroy(scene);
}

static bool has_sun(const char *text) {
    graze_scene *scene = load_scene(text);
    assert_non_null(scene->windows);
    bool has = scene->sun_comes_in;
    graze_scene_destroy(scene);
    return has;
}

static void suns_that_come_in(void **state) {
    (void)state;
#define LIT GLASS SKY GROUND ROOM PANE "void light l 0 0 3 9 9 9 l source sun 0 0 4 "
    assert_true(has_sun(LIT ".3 -1 1 .533\n"));
    assert_false(has_sun(LIT ".3 1 1 .533\n")); /* behind the house */
    assert_false(has_sun(LIT ".3 -1 1 .533\nw polygon p2 0 0 12 -9 -4 3 9 -4 3 9 -4 9 -9 -4 9\n")); /* hidden */
    assert_false(has_sun(GLASS SKY GROUND ROOM PANE));
}

/* A window with bars is looked at whole: what is left out of one would be found by luck, and not told. */
static void bars_leave_no_pane_out(void **state) {
    (void)state;
    char text[3000];
    int length = snprintf(text, sizeof text, GLASS SKY GROUND ROOM);
    for (int i = 0; i < 12; i++)
        length += snprintf(text + length, sizeof text - (size_t)length,
                           "clear polygon p%d 0 0 12 %g 0 %d %g 0 %d %g 0 %d %g 0 %d\n", i, i % 4 * 1.0, i / 4,
                           i % 4 + 0.875, i / 4, i % 4 + 0.875, i / 4 + 1, i % 4 * 1.0, i / 4 + 1);
    graze_scene *scene = load_scene(text);
    const vec3 point = {1.2, 3, 0};
    const window_choice c = choice_at(scene, point, vec3_make(0, 0, 1), 4);
    for (int i = 0; i < 12; i++) {
        vec3 towards = vec3_subtract(vec3_make(i % 4 + 0.4375, 0, i / 4 + 0.5), point);
        assert_true(window_density(&c, vec3_normalize(towards)) > 0);
    }
    graze_scene_destroy(scene);
}

static bool has_sky_beside_windows(const char *text) {
    graze_scene *scene = load_scene(text);
    assert_non_null(scene->windows);
    bool has = scene->sky_beside_windows;
    graze_scene_destroy(scene);
    return has;
}

/* Also where it is seen from the depth of a room alone. */
static void openings_beside_windows(void **state) {
    (void)state;
#define SCREEN "w polygon screen 0 0 12 0 2 0 4 2 0 4 2 2 0 2 2\n"
    assert_false(has_sky_beside_windows(GLASS SKY GROUND ROOM PANE));
    assert_false(has_sky_beside_windows(GLASS SKY GROUND ROOM PANE SCREEN));
    assert_true(has_sky_beside_windows(GLASS SKY GROUND ROOM "clear polygon p 0 0 12 0 0 0 3.7 0 0 3.7 0 3 0 0 3\n"));
    assert_true(has_sky_beside_windows(GLASS SKY GROUND
                                       "w polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0\n"
                                       "w polygon ceiling 0 0 12 0 0 3 0 4 3 4 4 3 4 0 3\n"
                                       "w polygon west 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3\n"
                                       "w polygon east 0 0 12 4 0 0 4 0 3 4 4 3 4 4 0\n"
                                       "w polygon north 0 0 12 0 4 1 4 4 1 4 4 3 0 4 3\n" PANE SCREEN));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(windows_are_seen_from_inside), cmocka_unit_test(what_is_no_window),
        cmocka_unit_test(densities_are_of_the_draws),   cmocka_unit_test(openings_beside_windows),
        cmocka_unit_test(bars_leave_no_pane_out),       cmocka_unit_test(suns_that_come_in),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
