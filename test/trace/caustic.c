/* Standard errors are true where a rough metal ball throws sunlight on a floor, which few paths meet; and where nothing
 * is met, it is known that nothing comes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/angle.h"
#include "base/vector.h"
#include "graze/trace.h"
#include "support/scene_text.h"

#define SUN "void light l 0 0 3 5e6 5e6 5e6 l source sun 0 0 4 0 0 1 .53\n"

/* All points of a circle around the ball are lit alike. */
static graze_ray ray_to_circle(double turn) {
    double angle = 2 * PI * turn;
    return (graze_ray){.origin = {1.5 * cos(angle), 1.5 * sin(angle), 0.01}, .direction = {0, 0, -1}};
}

/* What so many samples find, for answers to be compared with. */
static graze_answer truth_of(const graze_scene *scene, graze_trace_settings s, const graze_ray *ray, uint32_t samples,
                             uint64_t seed) {
    graze_answer truth;
    s.samples = samples;
    graze_trace(scene, &s, ray, seed, &truth, NULL);
    return truth;
}

static bool is_covered(const graze_answer *answer, const graze_answer *truth) {
    return fabs(answer->value.g - truth->value.g) <= 1.96 * hypot(answer->standard_error.g, truth->standard_error.g);
}

/* How many of so many answers hold the truth in their 95 % intervals. */
static int count_covering(const graze_scene *scene, const graze_trace_settings *s, const graze_ray *ray,
                          const graze_answer *truth, uint64_t times) {
    int covered = 0;
    for (uint64_t k = 0; k < times; k++) {
        graze_answer answer;
        graze_trace(scene, s, ray, k, &answer, NULL);
        covered += is_covered(&answer, truth);
    }
    return covered;
}

#define BALL_ON_FLOOR                                                                                                  \
    SUN "void plastic g 0 0 5 .3 .3 .3 0 0 g ring floor 0 0 8 0 0 0 0 0 1 0 20\n"                                      \
        "void metal m 0 0 5 .7 .7 .7 .9 .1 m sphere ball 0 0 4 0 0 1 .99\n"

static void assert_covers_a_caustic(const char *text) {
    graze_scene *scene = load_scene(text);
    graze_trace_settings s = graze_trace_defaults();
    s.ambient_bounces = 1;
    graze_ray ray = ray_to_circle(0);
    graze_answer truth = truth_of(scene, s, &ray, 1u << 20, 1000), answer;
    enum { RAYS = 400 };
    static const double errors[] = {0.05, 0.02, 0.01};
    for (int e = 0; e < 3; e++) {
        int covered = 0;
        double sum = 0, squares = 0;
        s.error = errors[e];
        for (int i = 0; i < RAYS; i++) {
            ray = ray_to_circle((i + 0.5) / RAYS);
            graze_trace(scene, &s, &ray, (uint64_t)i, &answer, NULL);
            double off = answer.value.g - truth.value.g;
            covered += fabs(off) <= 1.96 * answer.standard_error.g;
            sum += off;
            squares += off * off;
        }
        double mean = sum / RAYS, scatter = sqrt((squares / RAYS - mean * mean) / RAYS);
        printf("# --error %g: %.1f%% covered, %g too large, +- %g; truth %g +- %g\n", s.error, 100.0 * covered / RAYS,
               mean, scatter, truth.value.g, truth.standard_error.g);
        assert_true(covered >= 0.92 * RAYS);
        assert_true(fabs(mean) < 3 * hypot(scatter, truth.standard_error.g));
    }
    graze_scene_destroy(scene);
}

static void intervals_cover_a_caustic(void **state) {
    (void)state;
    assert_covers_a_caustic(BALL_ON_FLOOR);
}

/* What is expected of the ball is so as well where the sun shines on it through a pane. */
static void intervals_cover_a_caustic_below_glass(void **state) {
    (void)state;
    assert_covers_a_caustic(BALL_ON_FLOOR "void glass c 0 0 3 .9 .9 .9 c polygon pane 0 0 12 -50 -50 3 50 -50 3 50 50 "
                                          "3 -50 50 3\n");
}

/* The sun in a pane whose normals a texture bends, if only by nothing, lights the floor before it, which no path finds:
 * it is in the stated error, and not waited for. */
static void what_bent_panes_reflect_is_in_the_error(void **state) {
    (void)state;
    graze_scene *scene = load_scene("void light l 0 0 3 5e6 5e6 5e6 l source sun 0 0 4 1 0 2 .53\n"
                                    "void plastic g 0 0 5 .3 .3 .3 0 0 g ring floor 0 0 8 0 0 0 0 0 1 0 200\n"
                                    "void texfunc t 4 0 0 0 . 0 0 t glass c 0 0 3 .96 .96 .96\n"
                                    "c polygon pane 0 0 12 0 -5 0 0 5 0 0 5 6 0 -5 6\n");
    graze_trace_settings s = graze_trace_defaults();
    s.ambient_bounces = 1;
    double stated = 0;
    enum { RAYS = 50 };
    for (int i = 0; i < RAYS; i++) {
        graze_ray ray = {.origin = {0.5 + 2.0 * i / RAYS, 0.3, 1}, .direction = {0, 0, -1}};
        graze_answer answer;
        graze_trace(scene, &s, &ray, (uint64_t)i, &answer, NULL);
        assert_true(answer.samples <= 1024);
        stated += answer.standard_error.g / answer.value.g / RAYS;
    }
    /* The pane reflects a tenth of what falls on it. */
    if (stated < 0.01 || stated > 0.1)
        fail_msg("%g of the value", stated);
    graze_scene_destroy(scene);
}

/* A lamp over a floor, and a pane with a wall behind, which the lamp lights by way of the pane as well. */
static void intervals_cover_what_panes_reflect(void **state) {
    (void)state;
    graze_scene *scene =
        load_scene("void plastic g 0 0 5 .6 .6 .6 .02 .1 void glass c 0 0 3 .9 .8 .8\n"
                   "g polygon floor 0 0 12 -4 -4 0 4 -4 0 4 4 0 -4 4 0\n"
                   "g polygon wall 0 0 12 -4 4 0 4 4 0 4 4 4 -4 4 4\n"
                   "void light l 0 0 3 20 20 20 l polygon lamp 0 0 12 -1 -2 5 -1 -.5 5 1 -.5 5 1 -2 5\n"
                   "c polygon pane 0 0 12 -1 0 .2 1 0 .2 1 0 2.2 -1 0 2.2\n");
    graze_trace_settings s = graze_trace_defaults();
    s.ambient_bounces = 1;
    s.error = 0.05;
    enum { RAYS = 40, TIMES = 25 };
    int covered = 0;
    double squares = 0;
    for (int i = 0; i < RAYS; i++) {
        graze_ray ray = {.origin = {-1.5 + 3.0 * i / RAYS, -0.1 - 1.5 * (i * 7 % RAYS) / RAYS, 0.1},
                         .direction = {0, 0, -1}};
        const graze_answer truth = truth_of(scene, s, &ray, 1u << 14, TIMES);
        for (uint64_t k = 0; k < TIMES; k++) {
            graze_answer answer;
            graze_trace(scene, &s, &ray, k, &answer, NULL);
            covered += is_covered(&answer, &truth);
            squares += pow(answer.value.g / truth.value.g - 1, 2);
        }
    }
    double scatter = sqrt(squares / (RAYS * TIMES));
    printf("# %.1f%% covered, %g off\n", 100.0 * covered / (RAYS * TIMES), scatter);
    assert_true(covered >= 0.92 * RAYS * TIMES && covered <= 0.98 * RAYS * TIMES);
    assert_true(scatter < 0.04);
    graze_scene_destroy(scene);
}

/* A lamp over a table of glass, which alone lights the ceiling: a few of the paths that a sensor's diffuse reflections
 * lead there have most of what differs between answers. */
static void intervals_cover_what_panes_reflect_to_a_bounce(void **state) {
    (void)state;
    graze_scene *scene = load_scene("void plastic w 0 0 5 .7 .7 .7 0 0 void plastic d 0 0 5 .25 .25 .25 0 0\n"
                                    "d polygon floor 0 0 12 0 0 0 4 0 0 4 5 0 0 5 0\n"
                                    "w polygon ceiling 0 0 12 0 0 2.7 0 5 2.7 4 5 2.7 4 0 2.7\n"
                                    "w polygon left 0 0 12 0 0 0 0 5 0 0 5 2.7 0 0 2.7\n"
                                    "w polygon right 0 0 12 4 0 0 4 0 2.7 4 5 2.7 4 5 0\n"
                                    "w polygon end 0 0 12 0 5 0 4 5 0 4 5 2.7 0 5 2.7\n"
                                    "void glow g 0 0 4 25 25 25 0 void glass c 0 0 3 .8 .8 .8\n"
                                    "g polygon lamp 0 0 12 1.35 1.25 1.7 1.35 1.55 1.7 1.65 1.55 1.7 1.65 1.25 1.7\n"
                                    "c polygon table 0 0 12 .8 .8 .75 2.2 .8 .75 2.2 2 .75 .8 2 .75\n");
    graze_trace_settings s = graze_trace_defaults();
    const graze_ray ray = {.origin = {0, 1.1, 1.03}, .direction = {1, 0, 0}};
    enum { TIMES = 1000 };
    s.quantity = GRAZE_IRRADIANCE;
    s.ambient_bounces = 2;
    s.error = 0.01;
    const graze_answer truth = truth_of(scene, s, &ray, 1u << 17, TIMES);
    const int covered = count_covering(scene, &s, &ray, &truth, TIMES);
    printf("# %.1f%% covered; truth %g +- %g\n", 100.0 * covered / TIMES, truth.value.g, truth.standard_error.g);
    assert_true(covered >= 0.94 * TIMES && covered <= 0.985 * TIMES);
    graze_scene_destroy(scene);
}

/* What a translucent pane spreads a little of a lamp's light is a peak to the few paths that a diffuse reflection leads
 * into it. */
static void intervals_cover_what_shines_through(void **state) {
    (void)state;
    graze_scene *scene = load_scene("void plastic g 0 0 5 .6 .6 .6 0 0 g ring floor 0 0 8 0 0 0 0 0 1 0 9\n"
                                    "void light l 0 0 3 10 10 10 l ring lamp 0 0 8 0 0 3 0 0 -1 0 .4\n"
                                    "void trans t 0 0 7 .8 .8 .8 0 .1 .9 .9 t ring pane 0 0 8 0 0 1 0 0 1 0 9\n");
    graze_trace_settings s = graze_trace_defaults();
    graze_ray ray = {.origin = {2, 0, 0.5}, .direction = {0, 0, -1}};
    enum { TIMES = 1000 };
    s.ambient_bounces = 1;
    s.error = 0.1;
    const graze_answer truth = truth_of(scene, s, &ray, 1u << 18, TIMES);
    const int covered = count_covering(scene, &s, &ray, &truth, TIMES);
    printf("# %.1f%% covered; truth %g +- %g\n", 100.0 * covered / TIMES, truth.value.g, truth.standard_error.g);
    assert_true(covered >= 0.9 * TIMES);
    graze_scene_destroy(scene);
}

/* In a clear ball's shadow, beside the spot that it gathers a lamp's light in, a little more of that arrives than any
 * of an answer's paths finds: none of them finds anything. */
static void what_clear_bodies_throw_is_in_the_error(void **state) {
    (void)state;
    graze_scene *scene = load_scene("void light l 0 0 3 900 900 900 l sphere lamp 0 0 4 0 0 4 .1\n"
                                    "void plastic g 0 0 5 .5 .5 .5 0 0 g ring floor 0 0 8 0 0 0 0 0 1 0 9\n"
                                    "void dielectric d 0 0 5 1 1 1 1.5 0 d sphere ball 0 0 4 0 0 1 .8\n");
    graze_trace_settings s = graze_trace_defaults();
    int covered = 0;
    enum { RAYS = 10, TIMES = 20 };
    s.error = 0.1;
    for (int i = 0; i < RAYS; i++) {
        graze_ray ray = {.origin = {0.3 + 0.1 * i / RAYS, 0, 0.01}, .direction = {0, 0, -1}};
        const graze_answer truth = truth_of(scene, s, &ray, 1u << 17, TIMES);
        covered += count_covering(scene, &s, &ray, &truth, TIMES);
    }
    printf("# %.1f%% covered\n", 100.0 * covered / (RAYS * TIMES));
    assert_true(covered >= 0.9 * RAYS * TIMES);
    graze_scene_destroy(scene);
}

/* Through a pane the sky is seen, which is exact; in the pane, a wall whose gloss few paths follow, and fewer of them
 * to the sky. What none of them has met is in the error. */
static void what_is_not_met_is_in_the_error(void **state) {
    (void)state;
    graze_scene *scene = load_scene("void glow g 0 0 4 10 10 10 0 g source sky 0 0 4 1 0 0 180\n"
                                    "void glass c 0 0 3 .96 .96 .96 c ring pane 0 0 8 1 0 0 1 0 0 0 .3\n"
                                    "void plastic k 0 0 5 0 0 0 0 0 k ring around 0 0 8 1 0 0 1 0 0 .3 50\n"
                                    "void plastic l 0 0 5 .2 .2 .2 .05 .1 l ring wall 0 0 8 -1 0 0 1 0 0 0 50\n");
    graze_trace_settings s = graze_trace_defaults();
    int covered = 0, certain = 0;
    s.error = 0.05;
    enum { RAYS = 40, TIMES = 25 };
    for (int i = 0; i < RAYS; i++) {
        graze_ray ray = {.direction = {1, 0.08 + 0.04 * i / RAYS, 0.02}};
        graze_answer truth = truth_of(scene, s, &ray, 1u << 15, 12345), answer;
        for (uint64_t k = 0; k < TIMES; k++) {
            graze_trace(scene, &s, &ray, k, &answer, NULL);
            double stated = answer.standard_error.g;
            covered += is_covered(&answer, &truth);
            certain += stated < 1e-7 * answer.value.g;
            assert_true(stated < 0.01 * answer.value.g);
        }
    }
    printf("# %.1f%% covered, %d certain\n", 100.0 * covered / (RAYS * TIMES), certain);
    assert_int_equal(certain, 0);
    assert_true(covered >= 0.9 * RAYS * TIMES);
    graze_scene_destroy(scene);
}

/* A lamp that a mirror's edge, or a pane's, shows a little of: no answer that misses it is certain. And where the lamp
 * is seen wholly, or not at all, the error is what it was. */
static void what_mirrors_may_show_is_in_the_error(void **state) {
    (void)state;
    const char *const materials[] = {"mirror m 0 0 3 .9 .9 .9", "glass m 0 0 3 .9 .9 .9"};
    for (int pane = 0; pane < 2; pane++) {
        char text[800];
        snprintf(text, sizeof text,
                 "void plastic g 0 0 5 .6 .6 .6 0 0 g polygon floor 0 0 12 -4 -4 0 4 -4 0 4 4 0 -4 4 0\n"
                 "void light l 0 0 3 20 20 20 l polygon lamp 0 0 12 -.2 -1.2 2 -.2 -.8 2 .2 -.8 2 .2 -1.2 2\n"
                 "void %s m polygon pane 0 0 12 -1 0 .2 1 0 .2 1 0 1.5 -1 0 1.5\n",
                 materials[pane]);
        graze_scene *scene = load_scene(text);
        graze_trace_settings s = graze_trace_defaults();
        s.error = 0.05;
        s.ambient_bounces = pane;
        enum { RAYS = 600 };
        int covered = 0, exact = 0;
        for (uint64_t i = 0; i < RAYS; i++) {
            /* The lamp's image is above the upper edge from about y = -3 on, and here and there beside the others. */
            const graze_ray ray = {
                .origin = {0.6 + 2.4 * (double)i / RAYS, -0.5 - 3.4 * (double)(i * 37 % RAYS) / RAYS, 1},
                .direction = {0, 0, -1}};
            graze_answer answer;
            const graze_answer truth = truth_of(scene, s, &ray, 4096, i + 1);
            graze_trace(scene, &s, &ray, i, &answer, NULL);
            bool certain = answer.standard_error.g < 1e-6 * answer.value.g;
            covered += is_covered(&answer, &truth);
            exact += certain;
            if (certain && fabs(answer.value.g - truth.value.g) > 1e-6 * truth.value.g)
                fail_msg("%s, ray %d: %g, not %g", materials[pane], (int)i, truth.value.g, answer.value.g);
        }
        printf("# %s: %.1f%% covered, %.1f%% exact\n", materials[pane], 100.0 * covered / RAYS, 100.0 * exact / RAYS);
        assert_true(covered >= 0.95 * RAYS);
        /* With a diffuse bounce, which what panes show is in, no answer is certain. */
        assert_true(pane || exact >= 0.04 * RAYS);
        graze_scene_destroy(scene);
    }
}

/* A flat glossy plate throws sunlight on a part of the floor, which few paths find. It is in the error there, and not
 * where the plate cannot throw any. */
static void intervals_cover_what_a_plate_throws(void **state) {
    (void)state;
    graze_scene *scene = load_scene("void light l 0 0 3 5e6 5e6 5e6 l source sun 0 0 4 1 0 1 .53\n"
                                    "void plastic g 0 0 5 .3 .3 .3 0 0 g ring floor 0 0 8 0 0 0 0 0 1 0 9\n"
                                    "void metal m 0 0 5 .8 .8 .8 .95 .02\n"
                                    "m polygon plate 0 0 12 0 -.5 1 0 .5 1 0 .5 2 0 -.5 2\n");
    graze_trace_settings s = graze_trace_defaults();
    s.ambient_bounces = 1;
    s.error = 0.02;
    enum { RAYS = 32, TIMES = 30 };
    int covered[2] = {0, 0}, asked[2] = {0, 0};
    for (int i = 0; i < RAYS; i++) {
        double x = 0.2 + 3.8 * i / RAYS;
        const graze_ray ray = {.origin = {x, 0.1, 0.01}, .direction = {0, 0, -1}};
        const graze_answer truth = truth_of(scene, s, &ray, 1u << 16, TIMES);
        bool thrown = x > 0.8 && x < 2.3;
        covered[thrown] += count_covering(scene, &s, &ray, &truth, TIMES);
        asked[thrown] += TIMES;
        assert_true(x < 3 || truth.standard_error.g < 1e-3 * truth.value.g);
    }
    printf("# %.1f%% covered where it is thrown, %.1f%% elsewhere\n", 100.0 * covered[1] / asked[1],
           100.0 * covered[0] / asked[0]);
    assert_true(covered[1] >= 0.9 * asked[1] && covered[0] >= 0.93 * asked[0]);
    graze_scene_destroy(scene);
}

/* A glossy ball that shows a window, which few diffuse reflections meet: with as few samples as do for the rest, most
 * answers would have met nothing. The same where a disc of glass is before the window. */
static void intervals_cover_a_ball_by_the_window(void **state) {
    (void)state;
#define BALL_BY_WINDOW                                                                                                 \
    "void plastic w 0 0 5 .6 .6 .6 0 0 void glow g 0 0 4 10 10 10 0\n"                                                 \
    "void metal m 0 0 5 .7 .7 .7 .9 .05 m sphere ball 0 0 4 2.2 3 .5 .5\n"                                             \
    "w polygon floor 0 0 12 0 0 0 4 0 0 4 5 0 0 5 0\n"                                                                 \
    "w polygon ceiling 0 0 12 0 0 3 0 5 3 4 5 3 4 0 3\n"                                                               \
    "w polygon wall 0 0 12 0 0 0 0 5 0 0 5 3 0 0 3\n"                                                                  \
    "g polygon window 0 0 12 1.5 4.99 1 2.5 4.99 1 2.5 4.99 2 1.5 4.99 2\n"
    static const char *const scenes[] = {BALL_BY_WINDOW, BALL_BY_WINDOW
                                         "void glass c 0 0 3 .9 .9 .9 c ring disc 0 0 8 2 4.5 1.5 0 -1 0 0 .6\n"};
    enum { RAYS = 20, TIMES = 40 };
    for (int k = 0; k < 2; k++) {
        graze_scene *scene = load_scene(scenes[k]);
        graze_trace_settings s = graze_trace_defaults();
        s.ambient_bounces = 1;
        s.error = 0.1;
        int covered = 0;
        for (int i = 0; i < RAYS; i++) {
            graze_ray ray = {.origin = {2, 0.5, 1.5},
                             .direction = {-1, 0.4 + 0.05 * i, (i * 7 % RAYS - RAYS / 2) * 0.06}};
            const graze_answer truth = truth_of(scene, s, &ray, 1u << 13, 99);
            covered += count_covering(scene, &s, &ray, &truth, TIMES);
        }
        printf("# %.1f%% covered\n", 100.0 * covered / (RAYS * TIMES));
        assert_true(covered >= 0.92 * RAYS * TIMES);
        graze_scene_destroy(scene);
    }
}

static void zeros_are_exact_where_all_is_dark(void **state) {
    (void)state;
    graze_scene *scene = load_scene(SUN "void plastic g 0 0 5 .5 .5 .5 0 0 g sphere ball 0 0 4 0 0 0 1\n");
    graze_trace_settings s = graze_trace_defaults();
    graze_ray ray = {.origin = {0, 0, 0}, .direction = {0.3, 0.1, -1}};
    graze_answer answer;
    graze_trace(scene, &s, &ray, 1, &answer, NULL);
    assert_true(answer.value.g == 0);
    assert_true(answer.standard_error.g == 0);
    graze_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(intervals_cover_a_caustic),
                                       cmocka_unit_test(intervals_cover_a_caustic_below_glass),
                                       cmocka_unit_test(what_bent_panes_reflect_is_in_the_error),
                                       cmocka_unit_test(intervals_cover_what_panes_reflect),
                                       cmocka_unit_test(intervals_cover_what_panes_reflect_to_a_bounce),
                                       cmocka_unit_test(what_is_not_met_is_in_the_error),
                                       cmocka_unit_test(what_mirrors_may_show_is_in_the_error),
                                       cmocka_unit_test(intervals_cover_what_shines_through),
                                       cmocka_unit_test(what_clear_bodies_throw_is_in_the_error),
                                       cmocka_unit_test(intervals_cover_what_a_plate_throws),
                                       cmocka_unit_test(intervals_cover_a_ball_by_the_window),
                                       cmocka_unit_test(zeros_are_exact_where_all_is_dark)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
