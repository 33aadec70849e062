/* Light of the sky in rooms: by closed forms, all strategies alike, and soon. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "one_ray.h"
#include "room.h"

#include "base/angle.h"
#include "graze/brdf_light.h"
#include "support/dice.h"

/* A black room, 4 x 6 x 3, with a window in the wall at y = 0. */
#define BLACK_ROOM "void plastic w 0 0 5 0 0 0 0 0\n" ROOM_WITHOUT_FRONT("w") ROOM_FRONT("w", "2")
#define CLEAR      "void glass clear 0 0 4 1 1 1 1\n"
#define WINDOW     "clear polygon pane 0 0 12 1 0 1 3 0 1 3 0 2 1 0 2\n"
#define SKY        "void glow g 0 0 4 1 1 1 0 g source sky 0 0 4 0 0 1 180 g source ground 0 0 4 0 0 -1 180\n"

static double window_irradiance(vec3 point, vec3 normal) {
    const frame f = frame_around(normal);
    vec3 corners[4] = {{1, 0, 1}, {1, 0, 2}, {3, 0, 2}, {3, 0, 1}};
    for (int i = 0; i < 4; i++)
        corners[i] = frame_to_local(&f, vec3_subtract(corners[i], point));
    return PI * graze_diffuse_polygon(corners, 4);
}

/* A sensor, and what is true of it. */
static graze_ray sensor(dice *d, double *truth) {
    vec3 normal, point;
    do {
        point = vec3_make(0.1 + 3.8 * roll(d), 0.1 + 5.8 * roll(d), 0.1 + 2.8 * roll(d));
        normal = vec3_make(roll(d) - 0.5, roll(d) - 0.7, roll(d) - 0.3);
        normal = vec3_normalize(normal);
        *truth = window_irradiance(vec3_add_scaled(point, 1e-4, normal), normal);
    } while (!(*truth > 1e-3));
    return (graze_ray){.origin = point, .direction = normal};
}

/* Few samples do for the window's form factor, where hundreds of times as many of the whole sky would; and the
 * intervals hold it. */
static void windows_give_what_their_outlines_tell(void **state) {
    (void)state;
    graze_scene *scene = load_scene(BLACK_ROOM CLEAR WINDOW SKY);
    graze_trace_settings s = graze_trace_defaults();
    s.quantity = GRAZE_IRRADIANCE;
    s.ambient_bounces = 1;
    s.error = 0.02;
    enum { SENSORS = 500 };
    dice d = {3};
    int covered = 0;
    double samples = 0;
    for (int i = 0; i < SENSORS; i++) {
        double truth;
        const graze_ray ray = sensor(&d, &truth);
        graze_answer a;
        graze_trace(scene, &s, &ray, (uint64_t)i, &a, NULL);
        assert_true(a.converged);
        covered += fabs(a.value.g - truth) <= 1.96 * a.standard_error.g;
        samples += (double)a.samples / SENSORS;
    }
    printf("# %.1f%% covered, %.0f samples\n", 100.0 * covered / SENSORS, samples);
    assert_true(covered >= 0.93 * SENSORS);
    assert_true(samples < 200);
    graze_scene_destroy(scene);
}

static graze_answer ask(const graze_scene *scene, graze_strategy strategy, int bounces, const graze_ray *ray) {
    graze_trace_settings s = graze_trace_defaults();
    graze_answer a;
    s.strategy = strategy;
    s.ambient_bounces = bounces;
    s.samples = 1u << 14;
    graze_trace(scene, &s, ray, 1 + (uint64_t)strategy, &a, NULL);
    return a;
}

#define GRAY_ROOM                                                                                                      \
    "void plastic w 0 0 5 .6 .5 .4 0 0 void metal2 m 4 1 0 0 . 0 6 .6 .6 .6 .8 .3 .4 m sphere ball 0 0 4 2 2 .5 "      \
    ".5\n" ROOM_WITHOUT_FRONT("w")
#define GLASS "void glass clear 0 0 3 .9 .95 .92\n"

#define PANES(low, high)                                                                                               \
    "clear polygon a 0 0 12 0 0 " low " 1 0 " low " 1 0 " high " 0 0 " high "\n"                                       \
    "clear polygon b 0 0 12 1 0 " low " 2 0 " low " 2 0 " high " 1 0 " high "\n"                                       \
    "clear polygon c 0 0 12 2 0 " low " 3 0 " low " 3 0 " high " 2 0 " high "\n"                                       \
    "clear polygon d 0 0 12 3 0 " low " 4 0 " low " 4 0 " high " 3 0 " high "\n"

static void all_strategies_agree(void **state) {
    (void)state;
#define UNEVEN                                                                                                         \
    "void brightfunc b 2 if(Dz,.1+Dz*Dz,.05) . 0 0 b glow g 0 0 4 2 3 4 0 g source sky 0 0 4 0 0 1 180\n"              \
    "g source ground 0 0 4 0 0 -1 180\n"
    static const char *const scenes[] = {
        /* One window, two behind each other, twelve, and one beside an opening. */
        GRAY_ROOM GLASS UNEVEN "clear polygon pane 0 0 12 0 0 0 4 0 0 4 0 3 0 0 3\n",
        GRAY_ROOM GLASS UNEVEN "clear polygon pane 0 0 12 0 0 0 4 0 0 4 0 3 0 0 3\n"
                               "clear polygon second 0 0 12 0 -.1 0 4 -.1 0 4 -.1 3 0 -.1 3\n",
        GRAY_ROOM GLASS UNEVEN PANES("0", "1") PANES("1", "2") PANES("2", "3"),
        GRAY_ROOM GLASS UNEVEN "clear polygon pane 0 0 12 0 0 0 2 0 0 2 0 3 0 0 3\n",
        /* A screen behind it that lets light through, straight on and scattered; a mirror; and a clear body. */
        GRAY_ROOM GLASS UNEVEN
        "clear polygon pane 0 0 12 0 0 0 4 0 0 4 0 3 0 0 3\n"
        "void trans t 0 0 7 .7 .7 .7 0 0 .5 .3 t polygon screen 0 0 12 0 .1 1 4 .1 1 4 .1 3 0 .1 3\n",
        GRAY_ROOM GLASS UNEVEN "clear polygon pane 0 0 12 0 0 0 4 0 0 4 0 3 0 0 3\n"
                               "void mirror r 0 0 3 .9 .9 .9 r polygon u 0 0 12 .1 1 1 .1 3 1 .1 3 2 .1 1 2\n",
        /* The sky as a light, and narrower. */
        GRAY_ROOM GLASS "void light g 0 0 3 2 3 4 g source sky 0 0 4 0 -1 1 90 g source s 0 0 4 0 -1 .5 2\n"
                        "clear polygon pane 0 0 12 0 0 0 4 0 0 4 0 3 0 0 3\n",
    };
    const graze_ray rays[] = {{.origin = {3, 4, 1.5}, .direction = {-0.2, -0.1, -1}},
                              {.origin = {3, 4, 1.5}, .direction = {-0.3, 0.1, 1}},
                              {.origin = {3, 4, 1.5}, .direction = {-0.5, -1, -0.5}}};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        graze_scene *scene = load_scene(scenes[i]);
        for (size_t k = 0; k < sizeof rays / sizeof *rays; k++)
            for (int bounces = 0; bounces <= 2; bounces++) {
                char what[40];
                (void)snprintf(what, sizeof what, "scene %zu, ray %zu, -ab %d", i, k, bounces);
                const graze_answer mis = ask(scene, GRAZE_STRATEGY_MIS, bounces, &rays[k]);
                assert_answers_agree(what, mis, ask(scene, GRAZE_STRATEGY_BRDF, bounces, &rays[k]));
                assert_answers_agree(what, mis, ask(scene, GRAZE_STRATEGY_LIGHT, bounces, &rays[k]));
            }
        graze_scene_destroy(scene);
    }
}

/* How often the intervals of a sensor hold what many samples tell. */
static double coverage(const char *text, const graze_ray *ray) {
    enum { TIMES = 400 };
    graze_scene *scene = load_scene(text);
    graze_trace_settings s = graze_trace_defaults();
    graze_answer truth, a;
    s.quantity = GRAZE_IRRADIANCE;
    s.ambient_bounces = 1;
    s.samples = 1u << 18;
    graze_trace(scene, &s, ray, 1000, &truth, NULL);
    s.samples = 0;
    s.error = 0.1;
    int covered = 0;
    double samples = 0;
    for (int i = 0; i < TIMES; i++) {
        graze_trace(scene, &s, ray, (uint64_t)i, &a, NULL);
        covered += fabs(a.value.g - truth.value.g) <= 1.96 * a.standard_error.g;
        samples += (double)a.samples / TIMES;
    }
    printf("# %.3g +- %.2g: %.1f%% covered, %.0f samples\n", truth.value.g, truth.standard_error.g,
           100.0 * covered / TIMES, samples);
    graze_scene_destroy(scene);
    return (double)covered / TIMES;
}

/* A floor's gloss shows the sky in the window to the ceiling, which the window itself lights evenly: what the few paths
 * find that come to see it is expected, and stated where none has. */
static void gloss_that_shows_windows_is_expected(void **state) {
    (void)state;
    const graze_ray ray = {.origin = {2, 3, 2.99}, .direction = {0, 0, -1}};
    assert_true(coverage(BLACK_ROOM CLEAR WINDOW
                         "void glow h 0 0 4 5 5 5 0 h source sky 0 0 4 0 0 1 180 void glow g 0 0 4 1 1 1 0 "
                         "g source ground 0 0 4 0 0 -1 180 void plastic p 0 0 5 0 0 0 .04 .1 "
                         "p polygon parquet 0 0 12 0 0 .01 4 0 .01 4 6 .01 0 6 .01\n",
                         &ray) >= 0.9);
}

/* Where the sun shines in, few paths find the spot on the floor, and all find the sky. */
static void spots_of_sun_are_searched_for(void **state) {
    (void)state;
#define SUN(x, y, z)                                                                                                   \
    BLACK_ROOM CLEAR WINDOW SKY "void plastic p 0 0 5 .5 .5 .5 0 0 p polygon matt 0 0 12 0 0 .01 4 0 .01 4 6 .01 0 6 " \
                                ".01 void light l 0 0 3 5e4 5e4 5e4 l source sun 0 0 4 " x " " y " " z " .533\n"
    const graze_ray ray = {.origin = {2, 5.99, 1.5}, .direction = {0, -1, 0}};
    assert_true(coverage(SUN(".3", "-1", "1"), &ray) >= 0.92);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(windows_give_what_their_outlines_tell),
        cmocka_unit_test(all_strategies_agree),
        cmocka_unit_test(gloss_that_shows_windows_is_expected),
        cmocka_unit_test(spots_of_sun_are_searched_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
