/* Millimetres and kilometres in one scene: what is small and far off is as right as if it were alone, at the origin. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/close.h"
#include "support/scene_text.h"
#include "trace/random_scene.h"

/* A building at the origin. */
#define BUILDING                                                                                                       \
    "void plastic brick 0 0 5 .5 .4 .3 0 0\n"                                                                          \
    "brick polygon front 0 0 12 0 0 0 30 0 0 30 0 12 0 0 12\nbrick polygon side 0 0 12 0 0 0 0 0 12 0 20 12 0 20 0\n"  \
    "brick polygon roof 0 0 12 0 0 12 30 0 12 30 20 12 0 20 12\nbrick polygon back 0 0 12 0 20 0 0 20 12 30 20 12 "    \
    "30 20 0\nbrick polygon end 0 0 12 30 0 0 30 20 0 30 20 12 30 0 12\n"

static graze_scene *load_as(const char *text, graze_brdf_model model) {
    const graze_model_choice choice = {NULL, model};
    graze_scene *scene = scene_from_text_with(text, &(graze_scene_settings){.models = &choice, .model_count = 1});
    if (!scene)
        fail_msg("%s\n%s", messages, text);
    return scene;
}

static graze_scene *load(const char *text) {
    return load_as(text, GRAZE_BRDF_GMD);
}

/* Rooms of centimetres with things of a hundredth of a millimetre in them, a kilometre away from a building. */
static void small_rooms_far_from_a_building(void **state) {
    (void)state;
    static random_scene alone, away;
    static char text[2 * RANDOM_TEXT];
    int compared = 0;
    for (uint64_t number = 0; number < 300; number++) {
        placement where = {.axes = unplaced.axes, .scale = 0.01};
        random_scene_make(&alone, number, where);
        where.at = vec3_make(700, -650, 300);
        random_scene_make(&away, number, where);
        if (alone.open)
            continue;
        snprintf(text, sizeof text, "%s%s", BUILDING, away.text);
        graze_scene *scene_alone = load_as(alone.text, alone.model), *scene_away = load_as(text, away.model);
        for (int ray = 0; ray < RANDOM_RAYS; ray++) {
            graze_trace_settings s = alone.settings;
            graze_hit hit_alone, hit_away;
            for (s.samples = 128;; s.samples <<= 5) {
                graze_answer a, b;
                graze_trace(scene_alone, &s, &alone.rays[ray], 1, &a, &hit_alone);
                graze_trace(scene_away, &s, &away.rays[ray], 2, &b, &hit_away);
                double error = hypot(a.standard_error.g, b.standard_error.g);
                /* Places are rounded to a tenth of a millionth of a millimetre there. */
                if (fabs(a.value.g - b.value.g) <= 4 * error + 1e-6 * a.value.g)
                    break;
                if (s.samples > 1 << 16)
                    fail_msg("scene %d, ray %d: %g +- %g alone, %g +- %g away", (int)number, ray, a.value.g,
                             a.standard_error.g, b.value.g, b.standard_error.g);
            }
            assert_string_equal(hit_alone.surface, hit_away.surface);
            assert_close(hit_alone.distance, hit_away.distance, 1e-9);
            compared++;
        }
        graze_scene_destroy(scene_alone);
        graze_scene_destroy(scene_away);
    }
    assert_true(compared > 250);
}

/* A ball of 1 mm and a lamp of 0.1 mm above it, a kilometre away: irradiance is pi L (r/d)^2, and nothing shadows. */
static void small_ball_under_a_smaller_lamp(void **state) {
    (void)state;
    graze_scene *scene = load(BUILDING "void plastic p 0 0 5 .5 .5 .5 0 0\nvoid light l 0 0 3 1000 1000 1000\n"
                                       "p sphere ball 0 0 4 800 600 5 1e-3\nl sphere lamp 0 0 4 800 600 5.002 1e-4\n");
    const graze_ray ray = {.origin = {800, 599.99, 5.01}, .direction = {0, 0.01, -0.009}};
    for (int strategy = 0; strategy < 3; strategy++) {
        graze_trace_settings s = graze_trace_defaults();
        s.strategy = (graze_strategy)strategy;
        s.quantity = GRAZE_IRRADIANCE_HIT;
        s.samples = 1 << 14;
        graze_answer a;
        graze_hit hit;
        graze_trace(scene, &s, &ray, 3, &a, &hit);
        assert_string_equal(hit.surface, "ball");
        double truth = PI * 1000 * 1e-4 * 1e-4 / (1e-3 * 1e-3);
        assert_close(a.value.g, truth, 5 * a.standard_error.g + 1e-8 * truth);
        if (strategy != GRAZE_STRATEGY_BRDF)
            assert_true(a.standard_error.g < 1e-6 * truth);
    }
    graze_scene_destroy(scene);
}

/* No path from there meets the light outside. */
static void assert_dark(const graze_scene *scene, int number, vec3 origin, vec3 direction) {
    graze_trace_settings s = graze_trace_defaults();
    s.strategy = (graze_strategy)(number % 3);
    s.ambient_bounces = 12;
    s.samples = 64;
    const graze_ray ray = {.origin = origin, .direction = direction};
    graze_answer a;
    graze_trace(scene, &s, &ray, (uint64_t)number, &a, NULL);
    if (a.value.g != 0)
        fail_msg("ray %d: %g", number, a.value.g);
}

static void print_triangle(random_scene *s, vec3 a, vec3 b, vec3 c) {
    begin_shape(s, "m", "polygon", 9);
    print_point(s, a);
    print_point(s, b);
    print_point(s, c);
    end_shape(s);
}

/* A globe of tiny triangles, dark inside, in blinding light: nothing gets in, at corners, edges, or anywhere. */
static void no_light_leaks_into_a_small_globe(void **state) {
    (void)state;
    enum { N = 12 };
    static random_scene s;
    s = (random_scene){.placement = unplaced, .dice = {99}};
    vec3 center = {800, 600, 5};
    double radius = 1e-3;
    print_scene(&s, BUILDING "void light l 0 0 3 1e9 1e9 1e9\nl source sky 0 0 4 0 0 1 360\n"
                             "void metal m 0 0 5 .9 .9 .9 .5 .2\n");
    for (int i = 0; i < N; i++)
        for (int j = 0; j < 2 * N; j++) {
            vec3 corner[4];
            for (int k = 0; k < 4; k++) {
                double theta = PI * (i + (k == 1 || k == 2)) / N, phi = PI * ((j + (k >= 2)) % (2 * N)) / N;
                bool pole = (i == 0 && (k == 0 || k == 3)) || (i == N - 1 && (k == 1 || k == 2));
                vec3 d = {pole ? 0 : sin(theta) * cos(phi), pole ? 0 : sin(theta) * sin(phi),
                          i == N - 1 && pole ? -1 : cos(theta)};
                corner[k] = vec3_add_scaled(center, radius, d);
            }
            if (i < N - 1)
                print_triangle(&s, corner[0], corner[1], corner[2]);
            if (i > 0)
                print_triangle(&s, corner[0], corner[2], corner[3]);
        }
    graze_scene *scene = load(s.text);
    for (int i = 0; i < 60; i++) {
        vec3 offset = roll_direction(&s.dice);
        vec3 origin = vec3_add_scaled(center, 0.8 * radius * roll(&s.dice), offset);
        assert_dark(scene, i, origin, roll_direction(&s.dice));
    }
    graze_scene_destroy(scene);
}

/* Nor into rooms of any size and any place, full of things that touch the walls at all angles. */
static void no_light_leaks_into_rooms(void **state) {
    (void)state;
    const double sizes[] = {1e-3, 1, 1e3, 1e6};
    for (int i = 0; i < 4; i++)
        for (int away = 0; away < 2; away++) {
            double h = sizes[i], x = away ? 1234.5 : 0, y = away ? -987.6 : 0;
            placement p = {
                .axes = frame_around(vec3_normalize(vec3_make(0.3, -0.5, 0.8))), .scale = h, .at = {x, y, 0}};
            static random_scene s;
            s = (random_scene){.placement = p, .dice = {5}};
            print_scene(&s, "void light l 0 0 3 1e9 1e9 1e9\nl source sky 0 0 4 0 0 1 360\n"
                            "void metal m0 0 0 5 .9 .9 .9 .7 .1\nvoid metal m1 0 0 5 .9 .9 .9 .2 .3\n"
                            "void metal m2 0 0 5 .9 .9 .9 .7 .01\nvoid plastic m3 0 0 5 .9 .9 .9 0 0\n");
            add_room(&s, vec3_make(-1, -1, 0), vec3_make(1, 1, 1));
            add_ball(&s, "m0", vec3_make(0.5, 0.5, 0.25), 0.25, false);
            add_ring(&s, "m1", vec3_make(-0.5, 0.5, 0), vec3_make(0, 0, 1), 0.3);
            for (int k = 0; k < 8; k++)
                add_shape(&s, "m0", roll_in_box(&s.dice, vec3_make(-1, -1, 0), vec3_make(1, 1, 1)), 0.3);
            graze_scene *scene = load(s.text);
            for (int ray = 0; ray < 120; ray++) {
                vec3 origin = roll_in_box(&s.dice, vec3_make(-0.9, -0.9, 0.1), vec3_make(0.9, 0.9, 0.9));
                assert_dark(scene, ray, place_point(&p, origin), roll_direction(&s.dice));
            }
            graze_scene_destroy(scene);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_rooms_far_from_a_building),
        cmocka_unit_test(small_ball_under_a_smaller_lamp),
        cmocka_unit_test(no_light_leaks_into_a_small_globe),
        cmocka_unit_test(no_light_leaks_into_rooms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
