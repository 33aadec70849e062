/* Looking for what balls show of lights makes answers better, not other: beside the same scene with so many balls that
 * none is looked at, means agree within their errors, and these are smaller. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "base/vector.h"
#include "graze/trace.h"
#include "scene/balls.h"
#include "support/scene_text.h"
#include "trace/gleams.h"
#include "trace/sampler.h"

#define ROOM                                                                                                           \
    "void plastic w 0 0 5 .5 .5 .5 0 0\nw polygon floor 0 0 12 -3 -3 0 3 -3 0 3 3 0 -3 3 0\n"                          \
    "w polygon wall 0 0 12 -3 3 0 3 3 0 3 3 3 -3 3 3\n"

/* Far away and tiny: too many to look at any. */
#define CROWD                                                                                                          \
    "m sphere t1 0 0 4 100 1 -90 .001 m sphere t2 0 0 4 100 2 -90 .001 m sphere t3 0 0 4 100 3 -90 .001\n"             \
    "m sphere t4 0 0 4 100 4 -90 .001 m sphere t5 0 0 4 100 5 -90 .001 m sphere t6 0 0 4 100 6 -90 .001\n"             \
    "m sphere t7 0 0 4 100 7 -90 .001 m sphere t8 0 0 4 100 8 -90 .001\n"

typedef struct world {
    const char *name, *text;
    double gain; /* in the geometric mean the variance is smaller by this at least */
} world;

#define GLOSSY  "void metal2 m 4 1 1 0 . 0 6 .7 .7 .7 .9 .05 .2\n"
#define NARROW  "void metal m 0 0 5 .7 .7 .7 1 .02\n"
#define MIRROR  "void metal m 0 0 5 .7 .7 .7 1 0\n"
#define LAMP    "l polygon lamp 0 0 12 -1 -1 3 -1 0 3 0 0 3 0 -1 3\n"
#define BULB    "l sphere bulb 0 0 4 2 -1 2 .2\n"
#define BALLS   "m sphere one 0 0 4 .8 .3 .5 .5\nm sphere two 0 0 4 -1.5 1.5 .6 .4\n"
#define SHINING "void light l 0 0 3 10 10 10\n"

static const world worlds[] = {
    {"two glossy balls", SHINING GLOSSY LAMP BALLS, 3},
    {"two narrow lobes", SHINING NARROW LAMP BALLS, 3},
    {"two mirrors", SHINING MIRROR LAMP BALLS, 3},
    {"a glow", "void glow l 0 0 4 10 10 10 0\n" GLOSSY LAMP BALLS, 3},
    {"two lamps, one hidden",
     SHINING GLOSSY LAMP BULB BALLS "w polygon blind 0 0 12 1.6 -1.6 1.5 2.4 -1.6 1.5 2.4 -.4 1.5 1.6 -.4 1.5\n", 2},
    {"a lamp behind glass",
     SHINING GLOSSY LAMP BALLS
     "void glass c 0 0 3 .9 .9 .9 c polygon pane 0 0 12 -3 -3 2.5 -3 3 2.5 3 3 2.5 3 -3 2.5\n",
     3},
    {"a sun", "void light l 0 0 3 1e5 1e5 1e5 l source sun 0 0 4 1 -1 2 .5\n" GLOSSY BALLS, 3},
};

static graze_scene *load(const char *text, const char *more) {
    char whole[4096];
    snprintf(whole, sizeof whole, "%s%s%s", ROOM, text, more);
    graze_scene *scene = load_scene(whole);
    return scene;
}

static const graze_ray sensors[] = {
    {.origin = {0, 0, 0}, .direction = {0, 0, 1}},
    {.origin = {1.3, 1, 0}, .direction = {0, 0, 1}},
    {.origin = {0.6, 3, 0.7}, .direction = {0, -1, 0}},
    {.origin = {-2, 3, 2}, .direction = {0, -1, 0}},
    {.origin = {-0.9, 1, 0}, .direction = {0, 0, 1}},
    {.origin = {0.8, 0.3, 1.01}, .direction = {0, 0, 1}},
    {.origin = {1.45, 0.3, 0.6}, .direction = {-0.8, 0, 0.6}},
};

enum { SENSORS = sizeof sensors / sizeof *sensors };

/* Of 49 differences, one in 750 sets has one that is as many standard errors. */
#define MOST_APART 4.2

static void answers_are_better_not_other(void **state) {
    (void)state;
    for (size_t w = 0; w < sizeof worlds / sizeof *worlds; w++) {
        graze_scene *looking = load(worlds[w].text, ""), *blind = load(worlds[w].text, CROWD);
        assert_non_null(looking->balls);
        assert_null(blind->balls);
        graze_trace_settings s = graze_trace_defaults();
        s.quantity = GRAZE_IRRADIANCE;
        s.ambient_bounces = 2;
        s.samples = 1u << 14;
        double gain = 1;
        for (int i = 0; i < SENSORS; i++) {
            graze_answer a, b;
            graze_trace(looking, &s, &sensors[i], (uint64_t)i, &a, NULL);
            graze_trace(blind, &s, &sensors[i], 100 + (uint64_t)i, &b, NULL);
            double apart = a.value.g - b.value.g, error = hypot(a.standard_error.g, b.standard_error.g);
            if (!(fabs(apart) < MOST_APART * error))
                fail_msg("%s, sensor %d: %g +- %g, but not looking at balls %g +- %g", worlds[w].name, i, a.value.g,
                         a.standard_error.g, b.value.g, b.standard_error.g);
            gain *= pow(b.standard_error.g / a.standard_error.g, 2.0 / SENSORS);
        }
        printf("# %s: the variance is %.1f times less\n", worlds[w].name, gain);
        assert_true(gain >= worlds[w].gain);
        graze_scene_destroy(looking);
        graze_scene_destroy(blind);
    }
}

/* Directions and their weights together are as if drawn by the cosine alone: means over them of 1, of a direction's
 * part along x, and of whether it leads to a ball (above the horizon), are the integrals. */
static void weights_are_right(void **state) {
    (void)state;
    graze_scene *scene = load(SHINING "void metal m 0 0 5 .7 .7 .7 1 .3\n" LAMP BULB BALLS, "");
    const graze_material white = {.kind = GRAZE_PLASTIC, .color = {1, 1, 1}};
    for (int i = 0; i < SENSORS; i++)
        for (int looks = 0; looks < 2; looks++) {
            vec3 point = vec3_add_scaled(sensors[i].origin, 1e-4, sensors[i].direction), n = sensors[i].direction;
            graze_surface surface;
            graze_surface_prepare(&surface, &white, n, n, NULL);
            enum { COUNT = 1 << 17 };
            double ones = 0, along = 0, ball = 0;
            gleams kept, found;
            gleams_look(&kept, scene, point, n, -1);
            const scene_ball *first = &scene->balls->of[0];
            vec3 to_ball = vec3_subtract(first->center, point);
            double square = vec3_dot(to_ball, to_ball), sine2 = first->radius * first->radius / square;
            for (uint32_t k = 0; k < COUNT; k++) {
                sampler points = sampler_start(sampler_key(1, (uint64_t)i, (uint32_t)looks), k);
                double random[3] = {0, 0, 0};
                sampler_2d(&points, random);
                if (!looks)
                    gleams_expect(&found, scene, point, n);
                gleams *g = looks ? &kept : &found;
                if (!gleams_turn(g, &surface, random))
                    continue;
                vec3 d = graze_surface_sample_lobe(&surface, GRAZE_LOBE_DIFFUSE, random[0], random[1], 0).direction;
                double weight = gleams_weight(g, d, n), toward = vec3_dot(d, to_ball);
                ones += weight / COUNT;
                along += weight * vec3_dot(d, surface.x) / COUNT;
                ball += toward > 0 && toward * toward > square * (1 - sine2) ? weight / COUNT : 0;
            }
            double height = vec3_dot(to_ball, n) / sqrt(square);
            if (!(fabs(ones - 1) < 2e-4) || !(fabs(along) < 2e-4))
                fail_msg("sensor %d: the mean weight is %.6f, along x %.6f", i, ones, along);
            if (height * height > sine2 && height > 0 && !(fabs(ball - height * sine2) < 2e-4))
                fail_msg("sensor %d: the form factor is %.6f, but should be %.6f", i, ball, height * sine2);
        }
    graze_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(weights_are_right),
                                       cmocka_unit_test(answers_are_better_not_other)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
