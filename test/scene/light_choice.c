/* Choosing lights: probabilities are those of the draws, follow what lights add, and are 0 only where nothing comes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "scene/light.h"
#include "scene/light_choice.h"
#include "support/scene_text.h"

/* A small generator of random numbers: the tests must not depend on the sampler of the floor above. */
static uint64_t state_of_random = 1;
static double uniform(void) {
    state_of_random = state_of_random * 6364136223846793005u + 1442695040888963407u;
    return (double)(state_of_random >> 11) * 0x1p-53;
}

static double between(double from, double to) {
    return from + (to - from) * uniform();
}

static vec3 random_direction(void) {
    return vec3_normalize((vec3){between(-1, 1), between(-1, 1), between(-1, 1)});
}

/* One light of each kind of shape and of each way to shine, in an order that is not that of the tree. */
static const char all_kinds[] = "void light lamp 0 0 3 10 20 5\n"
                                "void light faint 0 0 3 1e-3 0 0\n"
                                "void glow window 0 0 4 3 3 4 0\n"
                                "void glow near_window 0 0 4 3 3 4 2\n"
                                "void glow picture 0 0 4 3 3 4 -1\n"
                                "void spotlight spot 0 0 7 90 90 90 40 0 0 -2\n"
                                "lamp polygon a 0 0 12 0 0 3 0 1 3 1 1 3 1 0 3\n"
                                "faint sphere b 0 0 4 2 2 2 .3\n"
                                "window polygon c 0 0 9 -2 0 1 -2 2 1 -2 1 3\n"
                                "near_window ring d 0 0 8 1 -2 1 0 1 0 .1 .5\n"
                                "picture polygon e 0 0 9 -2 0 4 -2 2 4 -2 1 6\n"
                                "spot ring f 0 0 8 0 2 3 0 0 -1 0 .1\n"
                                "lamp cylinder g 0 0 7 2 0 2 2 1 2 .05\n"
                                "lamp bubble h 0 0 4 0 0 0 50\n"
                                "lamp source sun 0 0 4 1 1 1 .5\n"
                                "window source sky 0 0 4 0 0 1 180\n"
                                "window source all 0 0 4 0 0 1 360\n";

/* `count` lamps of the same kind, 2 cm wide, spread over a ceiling, every third a sphere below it; and two sources. */
static graze_scene *load_many(int count) {
    size_t size = 100 * (size_t)count + 400;
    char *text = malloc(size);
    assert_non_null(text);
    int length = snprintf(
        text, size, "void light lamp 0 0 3 9 8 7\nlamp source sun 0 0 4 1 1 2 2\nlamp source moon 0 0 4 -1 0 1 1\n");
    state_of_random = 5;
    for (int i = 0; i < count; i++) {
        double x = between(-10, 10), y = between(-10, 10);
        length +=
            i % 3 == 0
                ? snprintf(text + length, size - (size_t)length, "lamp sphere s 0 0 4 %.3f %.3f 2.9 .01\n", x, y)
                : snprintf(text + length, size - (size_t)length,
                           "lamp polygon p 0 0 9 %.3f %.3f 3 %.3f %.3f 3 %.3f %.3f 3\n", x, y, x, y + .02, x + .02, y);
    }
    graze_scene *scene = load_scene(text);
    free(text);
    return scene;
}

static const graze_material glossy = {.kind = GRAZE_PLASTIC,
                                      .color = {.5, .4, .3},
                                      .specularity = .3,
                                      .roughness_u = .08,
                                      .roughness_v = .2,
                                      .has_orientation = 1,
                                      .orientation = {.3, .9, .1}};

/* A point with a glossy surface, seen from somewhere above it. */
static light_receiver receiver_at(graze_surface *surface, vec3 point, vec3 normal, vec3 view) {
    if (vec3_dot(view, normal) < 0)
        view = vec3_negate(view);
    graze_surface_prepare(surface, &glossy, normal, view, NULL);
    return (light_receiver){.point = point,
                            .surface = surface,
                            .diffuse = surface->diffuse,
                            .glossy = surface->specular,
                            .ambient_diffuse = surface->diffuse,
                            .ambient_glossy = surface->specular,
                            .draws = 1};
}

static light_receiver random_receiver(graze_surface *surface) {
    vec3 point = {between(-3, 3), between(-3, 3), between(0, 2.8)};
    return receiver_at(surface, point, random_direction(), random_direction());
}

static double sum_of_expectations(const light_choice *choice, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        double expectation = light_expectation(choice, (int)i);
        assert_true(expectation >= 0 && expectation <= 1 + 1e-9);
        sum += expectation;
    }
    return sum;
}

/* Numbers at equal steps draw each light in its proportion, to the steps at its ends. Where a group cannot be told from
 * one that reaches the point, its draws are lost. */
static void assert_drawn_as_said(const light_choice *choice, size_t count) {
    enum { DRAWS = 20000 };
    int lost = 0;
    double sum = sum_of_expectations(choice, count);
    int *drawn = calloc(count, sizeof *drawn);
    assert_non_null(drawn);
    for (int i = 0; i < DRAWS; i++) {
        double expectation;
        int light = light_choose(choice, (i + .5) / DRAWS, &expectation);
        if (light < 0) {
            lost++;
            continue;
        }
        assert_in_range(light, 0, count - 1);
        if (fabs(expectation - light_expectation(choice, light)) > 1e-12 * expectation)
            fail_msg("light %d is drawn with %.17g, and has %.17g", light, expectation,
                     light_expectation(choice, light));
        drawn[light]++;
    }
    if (fabs(lost - DRAWS * (1 - sum)) > 1.001 * (double)count)
        fail_msg("%d draws of %d are lost, with %g", lost, DRAWS, 1 - sum);
    for (size_t i = 0; i < count; i++)
        if (fabs(drawn[i] - DRAWS * light_expectation(choice, (int)i)) > 1.001)
            fail_msg("light %zu is drawn %d times of %d, with %g", i, drawn[i], DRAWS,
                     light_expectation(choice, (int)i));
    free(drawn);
}

static void assert_expectations_are_those_of_draws(const graze_scene *scene, int points) {
    light_choice choice;
    graze_surface surface;
    state_of_random = 9;
    for (int i = 0; i < points; i++) {
        light_receiver receiver = random_receiver(&surface);
        light_choice_prepare(&choice, scene, &receiver);
        if (!light_choice_is_possible(&choice))
            continue;
        double sum = sum_of_expectations(&choice, scene->light_count),
               least = scene->light_tree.group_count > 1 ? .01 : 1;
        if (!(sum > least - 1e-12 && sum < 1 + 1e-12))
            fail_msg("the sum is %.17g", sum);
        assert_drawn_as_said(&choice, scene->light_count);
    }
}

static void few_lights_are_drawn_as_said(void **state) {
    (void)state;
    graze_scene *scene = load_scene(all_kinds);
    assert_int_equal(scene->light_tree.group_count, 1);
    assert_expectations_are_those_of_draws(scene, 100);
    graze_scene_destroy(scene);
}

static void many_lights_are_drawn_as_said(void **state) {
    (void)state;
    graze_scene *scene = load_many(200);
    assert_int_equal(scene->light_tree.group_count, 1);
    assert_expectations_are_those_of_draws(scene, 10);
    graze_scene_destroy(scene);
    scene = load_many(1000);
    assert_true(scene->light_tree.group_count > 16);
    assert_expectations_are_those_of_draws(scene, 4);
    graze_scene_destroy(scene);
}

/* Only a few hundred entries are looked at, of ten thousand lights. */
static void groups_are_small(void **state) {
    (void)state;
    graze_scene *scene = load_many(10000);
    const light_tree *tree = &scene->light_tree;
    for (size_t i = 0; i < tree->group_count; i++)
        assert_in_range(tree->groups[i].blocks * LIGHT_LANES, 1, LIGHT_GROUP_MOST);
    for (size_t i = 0; i < scene->light_count; i++) {
        int looked_at = 0;
        for (int group = tree->group_of[i]; group >= 0; group = tree->groups[group].parent)
            looked_at += tree->groups[group].blocks * LIGHT_LANES;
        assert_in_range(looked_at, 1, 300);
    }
    graze_scene_destroy(scene);
}

/* What an average sample of the light adds, without shadows; and whether any adds anything. */
static double contribution(const graze_scene *scene, const light_receiver *receiver, int light, bool *any) {
    enum { SIDE = 24 };
    double sum = 0;
    *any = false;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double random[2] = {(i / SIDE + uniform()) / SIDE, (i % SIDE + uniform()) / SIDE};
        light_sample sample = light_draw(scene, receiver->point, 0, light, random);
        double cosine = vec3_dot(sample.direction, receiver->surface->n);
        if (sample.light < 0 || cosine <= 0 || rgb_is_black(sample.radiance) ||
            light_role_at(&scene->lights[light], sample.distance) == LIGHT_NONE)
            continue;
        rgb diffuse, gloss;
        graze_surface_value(receiver->surface, sample.direction, &diffuse, &gloss);
        sum += rgb_brightness(rgb_multiply(rgb_add(diffuse, gloss), sample.radiance)) * cosine / sample.density;
        *any = true;
    }
    return sum / (SIDE * SIDE);
}

static void nothing_that_shines_is_left_out(void **state) {
    (void)state;
    graze_scene *scene = load_scene(all_kinds);
    graze_surface surface;
    light_choice choice;
    state_of_random = 3;
    for (int i = 0; i < 300; i++) {
        light_receiver receiver = random_receiver(&surface);
        for (receiver.draws = 0; receiver.draws < 2; receiver.draws++) {
            light_choice_prepare(&choice, scene, &receiver);
            for (int light = 0; light < (int)scene->light_count; light++) {
                bool any;
                (void)contribution(scene, &receiver, light, &any);
                double expectation = light_expectation(&choice, light);
                if (any && !(expectation > 0))
                    fail_msg("light %d shines on point %d, but is never sampled", light, i);
                if (receiver.draws == 0 && expectation != 0 && expectation != 1)
                    fail_msg("light %d is sampled %g times", light, expectation);
            }
        }
    }
    graze_scene_destroy(scene);
}

/* With small lights, what a light adds is its expectation times the sum over all lights, in the lobe's middle as in its
 * tails: to a few hundredths, of which the even part of the choices is one. */
static void small_lights_are_chosen_by_what_they_add(void **state) {
    (void)state;
    enum { LAMPS = 200, POINTS = 50 };
    graze_scene *scene = load_many(LAMPS);
    graze_surface surface;
    light_choice choice;
    double adds[LAMPS + 2];
    state_of_random = 4;
    for (int i = 0; i < POINTS; i++) {
        vec3 view = random_direction();
        light_receiver receiver = receiver_at(&surface, (vec3){between(-9, 9), between(-9, 9), between(0, 1)},
                                              (vec3){0, 0, 1}, (vec3){view.x, view.y, fabs(view.z) + .1});
        graze_surface_prepare(&surface, &glossy, surface.n, vec3_normalize(surface.view), NULL);
        light_choice_prepare(&choice, scene, &receiver);
        double sum = 0;
        bool any;
        for (int light = 0; light < LAMPS + 2; light++)
            sum += adds[light] = contribution(scene, &receiver, light, &any);
        for (int light = 0; light < LAMPS + 2; light++) {
            double wanted = adds[light] / sum, found = light_expectation(&choice, light);
            if (fabs(found - wanted) > 0.05 * wanted + 1e-4)
                fail_msg("point %d, light %d: %g of what is added, drawn with %g", i, light, wanted, found);
        }
    }
    graze_scene_destroy(scene);
}

/* Large and near lights are drawn no more than ten times too seldom. */
static void no_light_is_drawn_much_too_seldom(void **state) {
    (void)state;
    graze_scene *scene = load_scene(all_kinds);
    graze_surface surface;
    light_choice choice;
    state_of_random = 6;
    for (int i = 0; i < 300; i++) {
        double adds[16], sum = 0;
        bool any;
        light_receiver receiver = random_receiver(&surface);
        light_choice_prepare(&choice, scene, &receiver);
        assert_in_range(scene->light_count, 1, 16);
        for (int light = 0; light < (int)scene->light_count; light++)
            sum += adds[light] = contribution(scene, &receiver, light, &any);
        for (int light = 0; light < (int)scene->light_count; light++)
            if (light_expectation(&choice, light) < 0.1 * adds[light] / sum)
                fail_msg("point %d, light %d: %g of what is added, drawn with %g", i, light, adds[light] / sum,
                         light_expectation(&choice, light));
    }
    graze_scene_destroy(scene);
}

/* Every surface point sees the whole of a glow only by the rules for it. */
static void unwanted_lights_are_not_drawn(void **state) {
    (void)state;
    graze_scene *scene =
        load_scene("void glow window 0 0 4 1 1 1 0\nwindow sphere a 0 0 4 0 0 3 1\n"
                   "void glow picture 0 0 4 1 1 1 -1\npicture sphere b 0 0 4 3 0 3 1\n"
                   "void light lamp 0 0 3 1 1 1\nlamp sphere c 0 0 4 0 3 3 1\nlamp sphere d 0 0 4 0 3 -9 1\n"
                   "lamp ring e 0 0 8 1 1 5 0 0 1 0 1\n"
                   "void spotlight spot 0 0 7 1 1 1 20 0 0 -1\nspot ring f 0 0 8 9 0 5 0 0 -1 0 1\n");
    graze_surface surface;
    light_choice choice;
    light_receiver receiver = receiver_at(&surface, (vec3){0, 0, 0}, (vec3){0, 0, 1}, (vec3){0, .6, .8});
    light_choice_prepare(&choice, scene, &receiver);
    assert_true(light_expectation(&choice, 0) > 0);
    assert_true(light_expectation(&choice, 2) > 0);
    receiver.ambient_diffuse = receiver.ambient_glossy = rgb_gray(0);
    for (receiver.draws = 0; receiver.draws < 2; receiver.draws++) {
        light_choice_prepare(&choice, scene, &receiver);
        const double expected[] = {0, 0, 1, 0, 0, 0};
        for (int light = 0; light < 5 + receiver.draws; light++)
            assert_true(light_expectation(&choice, light) == expected[light]);
    }
    graze_scene_destroy(scene);
}

/* Numbers as different as they may be, in one scene; points in lights, and far away. */
static void extreme_numbers_do_no_harm(void **state) {
    (void)state;
    graze_scene *scene = load_scene("void light bright 0 0 3 1e100 1e100 1e100\nvoid light faint 0 0 3 1e-60 0 0\n"
                                    "bright sphere a 0 0 4 0 0 3 2e-6\nfaint sphere b 0 0 4 1e6 0 3 1e5\n"
                                    "faint polygon c 0 0 9 0 0 1 1e-7 0 1 0 1e-7 1\nbright source d 0 0 4 0 0 1 1e-6\n"
                                    "faint polygon e 0 0 9 0 0 -1e8 1e9 0 -1e8 0 1e9 -1e8\n");
    const vec3 points[] = {{0, 0, 0},    {0, 0, 3},           {1e6, 0, 3},
                           {0, 0, 1},    {1e-8, 1e-8, 1},     {1e100, 1e100, -1e100},
                           {0, 0, -1e8}, {-1e-300, 1e18, 1e9}};
    graze_surface surface;
    light_choice choice;
    state_of_random = 8;
    for (int i = 0; i < 400; i++) {
        vec3 normal = i % 3 ? random_direction() : (vec3){0, 0, 1}, view = random_direction();
        if (i % 5 == 0)
            view = vec3_normalize(vec3_add_scaled(view, -vec3_dot(view, normal) * (1 - 1e-9), normal));
        light_receiver receiver = receiver_at(&surface, points[i % 8], normal, view);
        surface.lobe.alpha_x = i % 7 ? .1 : GRAZE_ROUGHNESS_MIN;
        surface.lobe.alpha_y = i % 11 ? GRAZE_ROUGHNESS_MAX : GRAZE_ROUGHNESS_MIN;
        light_choice_prepare(&choice, scene, &receiver);
        if (!light_choice_is_possible(&choice))
            continue;
        double sum = sum_of_expectations(&choice, scene->light_count), expectation;
        if (!(fabs(sum - 1) < 1e-12))
            fail_msg("point %d: the sum is %.17g", i, sum);
        const double randoms[] = {0, .5, 1 - 0x1p-53};
        for (int k = 0; k < 3; k++) {
            assert_in_range(light_choose(&choice, randoms[k], &expectation), 0, scene->light_count - 1);
            assert_true(expectation > 0);
        }
    }
    graze_scene_destroy(scene);
}

static void assert_same_bits(const graze_scene *scene, light_weigh_function *version) {
    const light_tree *tree = &scene->light_tree;
    graze_surface surface;
    light_choice choice;
    static light_weights expected, found;
    state_of_random = 7;
    for (int i = 0; i < 200; i++) {
        light_receiver receiver = random_receiver(&surface);
        if (i % 4 == 0)
            receiver.glossy = receiver.ambient_glossy = rgb_gray(0);
        light_choice_prepare(&choice, scene, &receiver);
        const light_group *group = &tree->groups[i % (int)tree->group_count];
        size_t count = (size_t)group->blocks * LIGHT_LANES;
        light_weights_baseline(tree, group, &choice.input, &expected);
        version(tree, group, &choice.input, &found);
        assert_memory_equal(expected.of, found.of, count * sizeof *found.of);
        assert_memory_equal(expected.lanes, found.lanes, sizeof found.lanes);
        assert_true(expected.total == found.total && expected.candidates == found.candidates);
    }
}

static void check_all_processors(graze_scene *scene) {
    assert_same_bits(scene, light_weights_best());
#ifdef LIGHT_WEIGHTS_X86_64
    if (__builtin_cpu_supports("avx2"))
        assert_same_bits(scene, light_weights_avx2);
#endif
    graze_scene_destroy(scene);
}

static void all_processors_give_the_same_bits(void **state) {
    (void)state;
    check_all_processors(load_scene(all_kinds));
    check_all_processors(load_many(100));
    check_all_processors(load_many(700));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_lights_are_drawn_as_said),
        cmocka_unit_test(many_lights_are_drawn_as_said),
        cmocka_unit_test(groups_are_small),
        cmocka_unit_test(nothing_that_shines_is_left_out),
        cmocka_unit_test(small_lights_are_chosen_by_what_they_add),
        cmocka_unit_test(no_light_is_drawn_much_too_seldom),
        cmocka_unit_test(unwanted_lights_are_not_drawn),
        cmocka_unit_test(extreme_numbers_do_no_harm),
        cmocka_unit_test(all_processors_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
